// Tests rest. A floor of one triangle has no edge and no vertex near a body. So each vertex of a sheet above it has one
// contact with it, a spring of force k_c (r − d) along the normal, where d is the vertex's height. At rest the contacts
// balance the weight,
//
//     Σ k_c (r − d_v) = M g,
//
// however bodies are stacked, and nothing moves along the normal. Along the floor sticking vertices may creep
// (slopes.cpp). A sheet that is dropped by a fifth of r also comes to rest, because implicit Euler loses at least m (v'
// − v)²/2 in each step.
//
// Each tolerance is a share of the weight, law_measures::force_left. This remaining force changes a vertex's velocity
// by that share of g h in a step, and its energy by the square of the share.
#include <algorithm>
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

/// Returns Σ k_c (r − d) over the vertices of the lowest sheet [N]; no other sheet is within r of the floor.
double borne(const Trajectory& run, const LawState& state) {
  const Body& of = run.scene.bodies[0];
  double sum = 0;
  for (Index v = of.first_vertex; v < of.first_vertex + of.vertex_count; ++v)
    sum += of.material.contact_stiffness *
           std::max(0., run.scene.settings.contact_radius - state.positions[static_cast<std::size_t>(v)].y);
  return sum;
}

/// Returns Σ m v_y²/2. Motion along the floor is left out, since sticking vertices may creep as ε_v allows.
double vertical_energy(const Scene& scene, LawState state) {
  for (Vec3& v : state.velocities) v = {0, v.y, 0};
  return kinetic_energy(scene, state);
}

/// Adds readings of the last quarter of the run, when the sheets are at rest.
void add_rest(std::vector<Reading>& readings, const Trajectory& run, const std::string& how) {
  double mass = 0, kinetic = 0;
  for (const double m : masses(run.scene)) mass += m;
  for (std::size_t n = run.states.size() * 3 / 4; n < run.states.size(); ++n)
    kinetic = std::max(kinetic, vertical_energy(run.scene, run.states[n]));
  const double weight = mass * standard_gravity;
  const double fall = mass * std::pow(standard_gravity * run.scene.settings.time_step, 2) / 2;
  readings.push_back({.what = "vertical kinetic energy over that of one step's fall" + how,
                      .unit = "1",
                      .measured = kinetic / fall,
                      .answer = 0,
                      .tolerance = std::pow(force_left(run), 2),
                      .side = Side::at_most});
  if (run.by.has_contact_energy)
    readings.push_back({.what = "weight that the floor bears" + how,
                        .unit = "N",
                        .measured = borne(run, run.states.back()),
                        .answer = weight,
                        .tolerance = force_left(run) * weight});
}

std::vector<Reading> read_rest(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  for (const Trajectory& run : runs) add_rest(readings, run, &run == runs.data() ? "" : ", dropped");
  return readings;
}

std::vector<Scene> weight_scenes(LawSize) {
  Scene scene = stacked_sheets("weight_on_floor", 1, 100), dropped = scene;
  dropped.settings.steps = 200;
  for (std::size_t v = 0; v < static_cast<std::size_t>(scene.bodies[0].vertex_count); ++v)
    dropped.mesh.positions[v].y += scene.settings.contact_radius / 5;
  round_to_single(dropped);
  return {scene, dropped};
}

/// Runs a hundred sweeps. A vertex of a sheet has ten contacts with the other sheets, but only one with the floor. So
/// the stack sinks and rises as one body, while the vertices' blocks are many times as stiff as the floor's contacts. A
/// sweep removes about 7 % of that motion; for a single sheet it removes nearly all.
std::vector<Scene> stack_scenes(LawSize size) {
  Scene scene = stacked_sheets("stack_at_rest", 3, size == LawSize::least ? 200 : 400);
  scene.settings.iterations = 100;
  return {scene};
}

}  // namespace

std::vector<Law> rests() {
  return {{.name = "weight_on_floor",
           .group = "rest",
           .meaning = "a sheet at rest has the right depth, and is still",
           .answer = "Σ k_c (r − d) = M g",
           .scenes = weight_scenes,
           .read = read_rest},
          {.name = "stack_at_rest",
           .group = "rest",
           .meaning = "the lowest of three sheets bears them all, still",
           .answer = "Σ k_c (r − d) = 3 m g",
           .scenes = stack_scenes,
           .read = read_rest}};
}

}  // namespace ogc::compare
