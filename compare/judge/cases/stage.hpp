// Lists the stages that the judge can compare, named by the stems of the files in compare/stages. A stage is an
// enumerator here, a line in the list below, and a file in compare/judge/stages that defines its traits.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ogc::compare {

/// All stages, in the order in which a step uses them.
enum class Stage : std::uint8_t {
  rest_state,
  closest_face,
  closest_points,
  block,
  detect_vertex_facet,
  detect_edge_edge,
  bound,
  plane,
  volume_depth,
  initial_guess,
  activation,
  barrier,
  contact_force,
  friction_force,
  volume_force,
  membrane,
  bending,
  spring,
  tetrahedron,
  rod,
  orientation,
  sweep,
  ccd,
  truncate,
  step
};

struct StageTraits;

/// What the judge knows of each stage (compare/judge/cases/stage_traits.hpp).
namespace stages {
/// The traits of each stage, defined in compare/judge/stages by the file of the same name.
extern const StageTraits rest_state, closest_face, closest_points, block, detect_vertex_facet, detect_edge_edge, bound,
    plane, volume_depth, initial_guess, activation, barrier, contact_force, friction_force, volume_force, membrane,
    bending, spring, tetrahedron, rod, orientation, sweep, ccd, truncate, step;
}  // namespace stages

/// Returns the traits of a stage; null for a number that is no enumerator. The judge has no other list of all stages:
/// an enumerator that is missing here does not compile (-Wswitch; tests/choices.py).
constexpr const StageTraits* find_traits(Stage stage) {
  switch (stage) {
    case Stage::rest_state: return &stages::rest_state;
    case Stage::closest_face: return &stages::closest_face;
    case Stage::closest_points: return &stages::closest_points;
    case Stage::block: return &stages::block;
    case Stage::detect_vertex_facet: return &stages::detect_vertex_facet;
    case Stage::detect_edge_edge: return &stages::detect_edge_edge;
    case Stage::bound: return &stages::bound;
    case Stage::plane: return &stages::plane;
    case Stage::volume_depth: return &stages::volume_depth;
    case Stage::initial_guess: return &stages::initial_guess;
    case Stage::activation: return &stages::activation;
    case Stage::barrier: return &stages::barrier;
    case Stage::contact_force: return &stages::contact_force;
    case Stage::friction_force: return &stages::friction_force;
    case Stage::volume_force: return &stages::volume_force;
    case Stage::membrane: return &stages::membrane;
    case Stage::bending: return &stages::bending;
    case Stage::spring: return &stages::spring;
    case Stage::tetrahedron: return &stages::tetrahedron;
    case Stage::rod: return &stages::rod;
    case Stage::orientation: return &stages::orientation;
    case Stage::sweep: return &stages::sweep;
    case Stage::ccd: return &stages::ccd;
    case Stage::truncate: return &stages::truncate;
    case Stage::step: return &stages::step;
  }
  return nullptr;
}

/// The number of stages; enumerators count from 0 without gaps.
inline constexpr std::size_t stage_count = [] {
  std::size_t count = 0;
  while (find_traits(static_cast<Stage>(count)) != nullptr) ++count;
  return count;
}();

/// All stages, in the order of a step.
inline constexpr std::array<Stage, stage_count> all_stages = [] {
  std::array<Stage, stage_count> all{};
  for (std::size_t i = 0; i < stage_count; ++i) all[i] = static_cast<Stage>(i);
  return all;
}();

/// Returns the stage's name, as "closest_face".
std::string_view stage_name(Stage stage);

/// Returns the stage of this name; empty if there is none.
std::optional<Stage> find_stage(std::string_view name);

/// Checks whether a case of the stage is a whole mesh. Each of its vertices, edges or questions counts as a case; in a
/// step, each vertex at each event.
bool is_mesh_stage(Stage stage);

}  // namespace ogc::compare
