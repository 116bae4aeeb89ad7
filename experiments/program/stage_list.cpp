#include "experiments/program/stage_list.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "compare/judge/cases/parameters.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/judge.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::Stage;
using compare::StageInfo;

std::string link(const std::string& text, const std::string& file) { return "[" + text + "](" + file + ")"; }

std::string generators_of(Stage stage) {
  std::size_t ladders = 0;
  const auto rows = compare::generators(stage);
  for (const compare::Generator& row : rows) ladders += row.name.starts_with("ladder.");
  return std::to_string(rows.size()) + (ladders > 0 ? ", " + counted(ladders, "ladder") : "");
}

template <class Rows>
std::string names_of(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names.empty() ? "none" : names;
}

/// Launch shapes that imitate other devices:
/// - small blocks;
/// - one or seven multiprocessors, so that each block computes several teams one after the other;
/// - a thousand multiprocessors, so that launches use SpreadTeams (fast/cuda/team.cuh).
constexpr std::array<fast::LaunchShape, 4> other_shapes{{{32, 0}, {96, 7}, {128, 1}, {64, 1000}}};

std::string text_of(const fast::LaunchShape& shape) {
  const std::string blocks = "blocks of " + std::to_string(shape.block_threads);
  return shape.multiprocessors > 0
             ? blocks + ", as on " + counted(static_cast<std::size_t>(shape.multiprocessors), "multiprocessor")
             : blocks;
}

/// Returns a line of the report for each launch shape and result that has other bits.
std::vector<std::string> changed_by_shape(const compare::DeterminismReport& report, std::uint64_t cases,
                                          std::uint64_t seed, const compare::Authority& authority) {
  std::vector<std::string> changed;
  for (const fast::LaunchShape& shape : other_shapes) {
    const auto other = compare::check_determinism(report.stage, cases, seed,
                                                  fast::contestant(fast::Backend::cuda, shape), authority, {});
    for (const std::string& line : other.changed) changed.push_back(text_of(shape) + ", " + line);
    if (other.digest != report.digest) changed.push_back(text_of(shape) + ": other bits");
  }
  return changed;
}

}  // namespace

std::string stage_list_markdown() {
  const compare::Contestant fast = fast::contestant(fast::Backend::cpu);
  const compare::Authority authority = reference::authority();
  std::string text =
      "| stage | asked | a case | reference | CPU | CUDA | generators | agreement tests | same bits "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Stage stage : compare::all_stages) {
    const StageInfo& info = compare::stage_info(stage);
    const std::string name(info.name);
    // Both backends instantiate the same probes (fast/probes/probes.hpp), so CUDA has the stages that the CPU has.
    const bool is_there = compare::can_judge(stage, fast, authority);
    text += "| " + link(name, "stages/" + name + ".hpp") + " | " + std::string(info.question) + " | " +
            std::string(info.unit) + " | " + link("exact", "../" + std::string(info.reference)) +
            (is_there ? " | yes | yes | " : " | no | no | ") + generators_of(stage) + " | " +
            (is_there ? link("CPU", "../tests/experiments/compare.cpp") + ", " +
                            link("CUDA", "../tests/fast/cuda/agreement.cu")
                      : link("plug-in", "../tests/experiments/plugins/build_plugins.sh")) +
            " | " + std::string(determinism_name(info.determinism)) + " |\n";
  }
  return text;
}

std::string stage_list_text() {
  std::string text;
  for (const Stage stage : compare::all_stages) {
    const StageInfo& info = compare::stage_info(stage);
    text += std::string(info.name) + ": " + std::string(info.question) + "\n  a case: " + std::string(info.unit) +
            "; same bits: " + std::string(determinism_name(info.determinism)) + "\n";
    text += "  generators: " + names_of(compare::generators(stage)) + "; of a run: states, mutated\n";
    text += "  parameters: " + names_of(compare::parameters(stage)) + "\n";
  }
  return text;
}

Json stage_list_json() {
  Json json = Json::array();
  for (const Stage stage : compare::all_stages) {
    const StageInfo& info = compare::stage_info(stage);
    Json generators = Json::array(), parameters = Json::array();
    for (const compare::Generator& row : compare::generators(stage)) generators.push_back(row.name);
    for (const compare::ParameterInfo& row : compare::parameters(stage)) parameters.push_back(row.name);
    json.push_back({{"name", info.name},
                    {"question", info.question},
                    {"case", info.unit},
                    {"determinism", determinism_name(info.determinism)},
                    {"generators", generators},
                    {"parameters", parameters}});
  }
  return json;
}

std::vector<compare::DeterminismReport> determinism_of(fast::Backend backend, std::span<const Stage> stages,
                                                       std::uint64_t cases, std::uint64_t seed) {
  const compare::Contestant contestant = fast::contestant(backend);
  const compare::Authority authority = reference::authority();
  std::vector<compare::Surrounding> surroundings;
  if (backend == fast::Backend::cpu)
    for (const int threads : {1, 2})
      surroundings.push_back(
          {counted(static_cast<std::size_t>(threads), "thread"), [threads](const std::function<void()>& ask) {
             tbb::task_arena arena(threads);
             arena.execute(ask);
           }});
  std::vector<compare::DeterminismReport> reports;
  for (const Stage stage : stages) {
    const std::uint64_t wanted = is_mesh_stage(stage) ? std::max<std::uint64_t>(cases / 50, 1) : cases;
    reports.push_back(compare::check_determinism(stage, wanted, seed, contestant, authority, surroundings));
    if (backend == fast::Backend::cpu) continue;
    const auto changed = changed_by_shape(reports.back(), wanted, seed, authority);
    reports.back().changed.insert(reports.back().changed.end(), changed.begin(), changed.end());
  }
  return reports;
}

Json determinism_json(std::span<const compare::DeterminismReport> reports) {
  Json json = Json::array();
  for (const compare::DeterminismReport& report : reports)
    json.push_back({{"stage", stage_name(report.stage)},
                    {"stated", determinism_name(compare::stage_info(report.stage).determinism)},
                    {"cases", report.cases},
                    {"digest", report.digest},
                    {"skipped", report.skipped},
                    {"changed", report.changed}});
  return json;
}

}  // namespace ogc::experiments
