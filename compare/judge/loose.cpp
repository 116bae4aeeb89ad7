#include "compare/judge/loose.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace ogc::compare {

namespace {

constexpr std::array<LooseTolerance, 1> table{
    {{Stage::bound, "bound",
      "ours is the exact product, rounded down: its error is 0. Other errors are whole units in the last place, 1 or 2 "
      "u b each, of which 4 u b accepts the first ones only"}}};

struct Seen {
  const MetricInfo* info = nullptr;
  double largest = 0;
  bool any = false;
};

std::map<std::pair<Stage, std::string_view>, Seen> seen_in(std::span<const StageReport> reports) {
  std::map<std::pair<Stage, std::string_view>, Seen> all;
  for (const StageReport& report : reports) {
    const std::span<const MetricInfo> infos = metrics(report.tally.stage);
    for (std::size_t i = 0; i < infos.size(); ++i) {
      Seen& seen = all[{report.tally.stage, infos[i].name}];
      seen.info = &infos[i];
      seen.any = seen.any || report.tally.metrics[i].errors.count() > 0;
      seen.largest = std::max(seen.largest, report.tally.metrics[i].errors.maximum());
    }
  }
  return all;
}

std::string numbers(const Seen& seen) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "largest error %.3g, accepted %g", seen.largest, seen.info->tolerance);
  return buffer;
}

}  // namespace

std::span<const LooseTolerance> loose_tolerances() { return table; }

std::optional<std::string_view> reason_of_loose(Stage stage, std::string_view metric) {
  for (const LooseTolerance& listed : table)
    if (listed.stage == stage && listed.metric == metric) return listed.reason;
  return std::nullopt;
}

std::vector<std::string> loose_problems(std::span<const StageReport> reports) {
  std::vector<std::string> problems;
  for (const auto& [name, seen] : seen_in(reports)) {
    if (!seen.any) continue;
    const bool loose = seen.largest * loose_factor < seen.info->tolerance,
               listed = reason_of_loose(name.first, name.second).has_value();
    const std::string which = std::string(stage_name(name.first)) + " " + std::string(name.second) + ": ";
    if (loose && !listed)
      problems.push_back(which + "loose, and not listed with a reason in compare/judge/loose.cpp; " + numbers(seen));
    if (listed && !loose)
      problems.push_back(which + "listed in compare/judge/loose.cpp, and not loose; " + numbers(seen));
  }
  return problems;
}

}  // namespace ogc::compare
