#include "experiments/bench/stage_benchmarks.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/benchmark.hpp"
#include "compare/judge/engine/judge.hpp"
#include "experiments/scenes/registry.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::BenchmarkCall;
using compare::Contestant;
using compare::Stage;
using compare::TestCase;

constexpr std::uint64_t batch = 1u << 14, seed = 1;

/// Returns `count` cases of the generators without degeneracies, in proportion to the generators' shares.
std::vector<TestCase> generic_cases(Stage stage, std::uint64_t count) {
  double shares = 0;
  for (const compare::Generator& row : generators(stage)) shares += row.generic ? row.share : 0;
  std::vector<TestCase> cases;
  for (const compare::Generator& row : generators(stage)) {
    if (!row.generic) continue;
    const auto wanted = static_cast<std::uint64_t>(static_cast<double>(count) * row.share / shares) + 1;
    for (std::uint64_t i = 0; i < wanted && cases.size() < count; ++i)
      cases.push_back(generate(row, {stage, std::string(row.name), seed, i, "", {}}));
  }
  if (cases.empty()) throw std::logic_error("a stage without generic cases");
  return cases;
}

bool takes_scene(Stage stage) { return compare::traits_of(stage).of_scene != nullptr; }

/// Returns the cases of a benchmark: a scene at its start, one generated mesh, or many single cases.
std::vector<TestCase> cases_of(Stage stage, const Contestant& contestant, const std::string& scale) {
  if (takes_scene(stage)) {
    const compare::Scene scene = make_scene("cloth_on_sphere", parse_scale(scale));
    return {{{stage, "scene", seed, 0, "", {}}, compare::traits_of(stage).of_scene(scene, contestant)}};
  }
  return generic_cases(stage, is_mesh_stage(stage) ? 1 : batch);
}

BenchmarkCall make_call(Stage stage, const Contestant& contestant, const std::string& scale) {
  return compare::traits_of(stage).benchmark(cases_of(stage, contestant, scale), contestant, reference::authority());
}

}  // namespace

void register_stage_benchmarks(const BenchOptions& options) {
  for (const fast::Backend backend : options.backends) {
    for (const Stage stage : compare::all_stages) {
      // Only the CPU's contestant is checked, because both backends have the same stages.
      if (!compare::can_judge(stage, fast::contestant(fast::Backend::cpu), reference::authority())) continue;
      const std::string name = "stage/" + std::string(stage_name(stage)) +
                               (takes_scene(stage) ? "/" + options.scale : "") + "/" + name_of(backend);
      const auto body = [stage, backend, scale = options.scale,
                         call = std::make_shared<std::optional<BenchmarkCall>>()](benchmark::State& state) {
        if (!*call) *call = make_call(stage, fast::contestant(backend), scale);
        (*call)->ask();
        for (auto _ : state) (*call)->ask();
        state.SetItemsProcessed(state.iterations() * (*call)->items);
      };
      benchmark::RegisterBenchmark(name.c_str(), body)->UseRealTime()->MinTime(0.05)->Repetitions(options.repetitions);
    }
  }
}

}  // namespace ogc::experiments
