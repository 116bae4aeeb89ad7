#include "compare/judge/stage.hpp"

namespace ogc::compare {

namespace {

constexpr std::array<std::string_view, all_stages.size()> names{"closest_face", "closest_points", "detect_vertex_facet", "detect_edge_edge", "bound",
                                                                "activation",   "truncate",       "membrane",            "bending"};

}  // namespace

std::string_view stage_name(Stage stage) { return names[static_cast<std::size_t>(stage)]; }

std::optional<Stage> find_stage(std::string_view name) {
  for (const Stage stage : all_stages)
    if (stage_name(stage) == name) return stage;
  return std::nullopt;
}

bool is_mesh_stage(Stage stage) { return stage == Stage::detect_vertex_facet || stage == Stage::detect_edge_edge || stage == Stage::bound; }

bool is_force_stage(Stage stage) { return stage == Stage::membrane || stage == Stage::bending; }

}  // namespace ogc::compare
