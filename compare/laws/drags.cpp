// Tests bodies that friction holds or drags. Gravity pulls a sheet of mass M and n vertices along the gap between two
// plates. Each plate presses on each vertex with k_c δ, where δ is the depth, so that friction can balance the weight.
// The sheet only creeps, with the velocity v at which the smoothed friction f₁ balances the weight (slopes.cpp):
//
//     f₁(v/ε_v) = M g/(2 n μ k_c δ).
//
// A floor that moves with velocity u drags a body of velocity v. Let w = v − u. A step changes w to w' with
//
//     w' = w − h μ g f₁(|w'|/ε_v) sign w'.
//
// Tolerances are derived in slopes.cpp. The depth δ has the rounding error of r.
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr double contact_radius = 0.01, spacing = 0.05, reach = 0.5, sheet_vertices = 25;

constexpr double pinch_depth = 5e-5;

Scene pinched(std::int64_t steps) {
  Scene scene = empty_scene("pinch_sticks", 0.005, steps, 40);
  scene.gravity = {standard_gravity, 0, 0};
  const Material material = cloth(0.5);
  append_body(scene, {.name = "sheet", .material = material}, sheet(5, 5, spacing, 0));
  for (const double side : {-1., 1.})
    append_body(scene, {.name = side < 0 ? "below" : "above", .fixed = true, .material = material},
                floor_triangle(reach, side * (contact_radius - pinch_depth)));
  round_to_single(scene);
  return scene;
}

std::vector<Reading> read_pinch(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const std::size_t last = run.states.size() - 1, half = last / 2;
  const Material& material = run.scene.bodies[0].material;
  const double share = mass_of(run.scene, 0) * standard_gravity /
                       (2 * sheet_vertices * material.friction * material.contact_stiffness * pinch_depth);
  const double creep = run.scene.settings.friction_velocity * (1 - std::sqrt(1 - share));
  const double way = centre(run.scene, 0, run.states[last]).x - centre(run.scene, 0, run.states[half]).x;
  const double error = force_left(run) * share / (2 * std::sqrt(1 - share)) * run.scene.settings.friction_velocity;
  const double rounding = unit_roundoff * (contact_radius / pinch_depth * creep +
                                           largest_coordinate(run) / run.scene.settings.time_step);
  return {{.what = "creep",
           .unit = "m/s",
           .measured = way / (static_cast<double>(last - half) * run.scene.settings.time_step),
           .answer = creep,
           .tolerance = error + rounding}};
}

constexpr double belt = 0.3;  // [m/s]

std::vector<Scene> conveyor_scenes(LawSize) {
  Scene scene = stacked_sheets("conveyor", 1, 80);
  scene.bodies[1].fixed = false;
  scene.motions.push_back({.name = "belt", .vertices = {25, 26, 27}, .velocity = {belt, 0, 0}, .keyframes = {}});
  return {scene};
}

std::vector<Reading> read_conveyor(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double h = run.scene.settings.time_step, mu = run.scene.bodies[0].material.friction;
  double relative = -belt, way = 0;
  for (std::size_t n = 0; n < run.rows.size(); ++n) {
    relative = slid(relative, 0, mu * standard_gravity, run.scene.settings.friction_velocity, h);
    way += h * (relative + belt);
  }
  // Both terms of `share` are derived in slopes.cpp: the lag of friction's normal force λ, and the error of λ after
  // sweeps. The share applies to the distance `ahead` by which the belt leads the body.
  const double ahead = belt * h * static_cast<double>(run.rows.size()) - way;
  const double dragged = belt / (mu * standard_gravity), share = 2 * lagged_steps(run) * h / dragged + force_left(run);
  return {{.what = "way",
           .unit = "m",
           .measured = centre(run.scene, 0, run.states.back()).x - centre(run.scene, 0, run.states.front()).x,
           .answer = way,
           .tolerance = share * ahead},
          {.what = "velocity",
           .unit = "m/s",
           .measured = centre_velocity(run.scene, 0, run.states.back()).x,
           .answer = relative + belt,
           .tolerance = 0.01 * run.scene.settings.friction_velocity}};
}

std::vector<Scene> pinch_scenes(LawSize size) { return {pinched(size == LawSize::least ? 100 : 12000)}; }

}  // namespace

std::vector<Law> drags() {
  return {{.name = "pinch_sticks",
           .group = "friction",
           .meaning = "a pinched sheet creeps as ε_v allows, no faster",
           .answer = "f₁(v/ε_v) = M g/(2 n μ k_c δ)",
           .needs_springs = true,
           .scenes = pinch_scenes,
           .read = read_pinch},
          {.name = "conveyor",
           .group = "friction",
           .meaning = "a moving floor carries what lies on it",
           .answer = "v' = v + h μ g f₁((u − v')/ε_v)",
           .scenes = conveyor_scenes,
           .read = read_conveyor}};
}

}  // namespace ogc::compare
