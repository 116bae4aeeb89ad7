// The stages that the judge can compare; their names are the stems of compare/stages.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ogc::compare {

/// In the order of a step.
enum class Stage : std::uint8_t {
  rest_state,
  closest_face,
  closest_points,
  block,
  detect_vertex_facet,
  detect_edge_edge,
  bound,
  initial_guess,
  activation,
  contact_force,
  friction_force,
  membrane,
  bending,
  spring,
  sweep,
  truncate,
  step
};

inline constexpr std::array<Stage, 17> all_stages{
    Stage::rest_state,       Stage::closest_face, Stage::closest_points, Stage::block,      Stage::detect_vertex_facet,
    Stage::detect_edge_edge, Stage::bound,        Stage::initial_guess,  Stage::activation, Stage::contact_force,
    Stage::friction_force,   Stage::membrane,     Stage::bending,        Stage::spring,     Stage::sweep,
    Stage::truncate,         Stage::step};

/// "closest_face" …
std::string_view stage_name(Stage stage);

/// The stage of that name; empty where there is none.
std::optional<Stage> find_stage(std::string_view name);

/// Whether a case of the stage is a whole mesh, whose vertices (or edges, or questions) are counted one by one, of a
/// step at each event.
bool is_mesh_stage(Stage stage);

/// Whether the answer is the force and block of a vertex.
bool is_force_stage(Stage stage);

}  // namespace ogc::compare
