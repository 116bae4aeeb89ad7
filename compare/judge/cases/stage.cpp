#include "compare/judge/cases/stage.hpp"

#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

std::string_view stage_name(Stage stage) { return stage_info(stage).name; }

std::optional<Stage> find_stage(std::string_view name) {
  for (const Stage stage : all_stages)
    if (stage_name(stage) == name) return stage;
  return std::nullopt;
}

bool is_mesh_stage(Stage stage) { return stage_info(stage).kind != CaseKind::single; }

const StageTraits& traits_of(Stage stage) { return *find_traits(stage); }

const StageInfo& stage_info(Stage stage) { return traits_of(stage).info; }

std::span<const MetricInfo> metrics(Stage stage) { return traits_of(stage).metrics; }

std::string_view determinism_name(Determinism level) {
  switch (level) {
    case Determinism::not_guaranteed: return "not_guaranteed";
    case Determinism::run_to_run: return "run_to_run";
    case Determinism::gpu_to_gpu: return "gpu_to_gpu";
    case Determinism::cpu_to_gpu: return "cpu_to_gpu";
  }
  return {};
}

}  // namespace ogc::compare
