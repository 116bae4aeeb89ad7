#include "compare/record/iterations_csv.hpp"

#include <array>
#include <string_view>
#include <variant>

#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

struct IterationColumn {
  std::string_view title;
  std::variant<double IterationMetrics::*, std::int64_t IterationMetrics::*> field;
};

constexpr std::array<IterationColumn, 15> iteration_columns{{
    {"step [1]", &IterationMetrics::step},
    {"iteration [1]", &IterationMetrics::iteration},
    {"wall [ms]", &IterationMetrics::wall_ms},
    {"residual [1]", &IterationMetrics::residual},
    {"energy [J]", &IterationMetrics::energy},
    {"largest_change [m]", &IterationMetrics::largest_change},
    {"share [1]", &IterationMetrics::share},
    {"vertices_cut [1]", &IterationMetrics::vertices_cut},
    {"broad_phases [1]", &IterationMetrics::broad_phases},
    {"discrete_detections [1]", &IterationMetrics::discrete_detections},
    {"continuous_detections [1]", &IterationMetrics::continuous_detections},
    {"detected [1]", &IterationMetrics::detected},
    {"condition_number [1]", &IterationMetrics::condition_number},
    {"condition_without_friction [1]", &IterationMetrics::condition_without_friction},
    {"condition_without_contact [1]", &IterationMetrics::condition_without_contact},
}};

std::string text_of(double value) { return value != value ? "nan" : shortest(value); }
std::string text_of(std::int64_t value) { return std::to_string(value); }

}  // namespace

std::string iteration_header() {
  std::string text;
  for (const IterationColumn& column : iteration_columns) text.append(text.empty() ? "" : ",").append(column.title);
  return text + '\n';
}

std::string iteration_lines(std::span<const StepMetrics> steps) {
  std::string text;
  for (const StepMetrics& step : steps)
    for (const IterationMetrics& row : step.iteration_rows) {
      for (const IterationColumn& column : iteration_columns) {
        if (&column != &iteration_columns.front()) text += ',';
        text += std::visit([&](auto field) { return text_of(row.*field); }, column.field);
      }
      text += '\n';
    }
  return text;
}

}  // namespace ogc::compare
