#include "compare/judge/stage.hpp"

namespace ogc::compare {

namespace {

constexpr std::array<std::string_view, all_stages.size()> names{
    "rest_state",       "closest_face", "closest_points", "block",      "detect_vertex_facet",
    "detect_edge_edge", "bound",        "initial_guess",  "activation", "contact_force",
    "friction_force",   "membrane",     "bending",        "spring",     "sweep",
    "truncate",         "step"};

}  // namespace

std::string_view stage_name(Stage stage) { return names[static_cast<std::size_t>(stage)]; }

std::optional<Stage> find_stage(std::string_view name) {
  for (const Stage stage : all_stages)
    if (stage_name(stage) == name) return stage;
  return std::nullopt;
}

bool is_mesh_stage(Stage stage) {
  switch (stage) {
    case Stage::rest_state:
    case Stage::block:
    case Stage::detect_vertex_facet:
    case Stage::detect_edge_edge:
    case Stage::bound:
    case Stage::sweep:
    case Stage::step: return true;
    default: return false;
  }
}

bool is_force_stage(Stage stage) {
  switch (stage) {
    case Stage::contact_force:
    case Stage::friction_force:
    case Stage::membrane:
    case Stage::bending:
    case Stage::spring: return true;
    default: return false;
  }
}

}  // namespace ogc::compare
