// Tests changes that must not change a motion.
//
// A second body farther away than any contact exerts no force on the first. But its speed sets the query radius of all
// vertices, and its values enter the means that decide when a solve ends. (The stiffness of IPC's barriers depends on
// the whole scene, unless a setting gives it.) So a resting sheet stays in place, except for rounding (flight_rounding)
// and the remaining force of a step, which moves the sheet by at most law_measures::force_left times h² g.
//
// Lengths are scaled by 2ᵏ, masses and times are not. Lengths, velocities, gravity, radii and ε_v are multiplied by 2ᵏ,
// densities per square metre by 4⁻ᵏ, energies of bending by 4ᵏ; stiffnesses [N/m] stay. So every number of a step is
// multiplied by a power of two, which causes no rounding, and every decision depends on a sign or a ratio. The motion
// is the same to the bit, times 2ᵏ.
#include <algorithm>
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

/// Returns a sheet that falls askew on a floor, with friction and hinges.
Scene falling(const char* name, std::int64_t steps) {
  Scene scene = empty_scene(name, 0.005, steps, 20);
  scene.gravity = {0, -standard_gravity, 0};
  Material material = cloth(0.3);
  material.bending = BendingModel::discrete_hinge;
  material.bending_stiffness = 1e-4;
  Mesh mesh = sheet(5, 5, 0.05, 0.02);
  for (Vec3& x : mesh.positions) x.y += 0.1 * x.x + 0.05 * x.z + 0.02;
  append_body(scene, {.name = "sheet", .material = material}, mesh);
  set_velocity(scene, 0, {0.5, -0.5, 0.2});
  append_body(scene, {.name = "floor", .fixed = true, .material = material}, floor_triangle(0.5, 0));
  return scene;
}

std::vector<Scene> apart_scenes(LawSize) {
  Scene alone = falling("far_apart", 40);
  alone.settings.iterations = 40;
  // Each vertex starts at the depth at which its own contact supports it, so the sheet is at rest from the start.
  const std::vector<double> m = masses(alone);
  for (std::size_t v = 0; v < static_cast<std::size_t>(alone.bodies[0].vertex_count); ++v) {
    const double depth = m[v] * standard_gravity / alone.bodies[0].material.contact_stiffness;
    alone.mesh.positions[v].y = alone.settings.contact_radius - depth;
  }
  set_velocity(alone, 0, {0, 0, 0});
  set_setting(alone.settings, "ipc_stiffness", 1e6);
  Scene beside = alone;
  Mesh mesh = sheet(3, 3, 0.05, 0);
  for (Vec3& x : mesh.positions) x.z += 64;
  append_body(beside, {.name = "far", .material = beside.bodies[0].material}, mesh);
  set_velocity(beside, 2, {0, -3, 0});
  round_to_single(alone);
  round_to_single(beside);
  return {alone, beside};
}

/// Returns the largest distance, at any step, of a vertex of the first body from `scale` times its position in the
/// other run.
double largest_difference(const Trajectory& run, const Trajectory& other, double scale) {
  const auto count = static_cast<std::size_t>(run.scene.bodies[0].vertex_count);
  double most = 0;
  for (std::size_t n = 0; n < run.states.size(); ++n)
    for (std::size_t v = 0; v < count; ++v)
      most = std::max(most, length(plus(run.states[n].positions[v], other.states[n].positions[v], -scale)));
  return most;
}

std::vector<Reading> read_apart(std::span<const Trajectory> runs) {
  const double h = runs[0].scene.settings.time_step;
  const double rounding = flight_rounding(1, 0.1) * static_cast<double>(runs[0].rows.size());
  // The remaining force is a share of the mean weight, and may act on the lightest vertex.
  const std::vector<double> m = masses(runs[0].scene);
  const auto sheet = std::span(m).first(static_cast<std::size_t>(runs[0].scene.bodies[0].vertex_count));
  const double mean = mass_of(runs[0].scene, 0) / static_cast<double>(sheet.size());
  const double left = force_left(runs[0]) * standard_gravity * h * h * mean / std::ranges::min(sheet);
  return {{.what = "distance from the motion alone",
           .unit = "m",
           .measured = largest_difference(runs[0], runs[1], 1),
           .answer = 0,
           .tolerance = rounding + left,
           .side = Side::at_most}};
}

Scene scaled(Scene scene, int k) {
  const double s = std::ldexp(1., k);
  for (auto* list : {&scene.mesh.positions, &scene.rest_positions, &scene.velocities})
    for (Vec3& x : *list) x = {s * x.x, s * x.y, s * x.z};
  for (Body& body : scene.bodies) {
    body.material.density /= s * s;
    body.material.bending_stiffness *= s * s;
  }
  scene.gravity = {s * scene.gravity.x, s * scene.gravity.y, s * scene.gravity.z};
  scene.settings.contact_radius *= s;
  scene.settings.friction_velocity *= s;
  return scene;
}

std::vector<Scene> scaled_scenes(LawSize size) {
  Scene scene = falling("lengths_by_powers", size == LawSize::least ? 40 : 200);
  round_to_single(scene);
  return {scene, scaled(scene, 7), scaled(scene, -7)};
}

std::vector<Reading> read_scaled(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  for (const std::size_t k : {1u, 2u}) {
    const double scale = k == 1 ? 0x1p7 : 0x1p-7;
    readings.push_back({.what = k == 1 ? "distance from the motion times 128" : "distance from the motion over 128",
                        .unit = "m",
                        .measured = largest_difference(runs[k], runs[0], scale),
                        .answer = 0,
                        .tolerance = 0,
                        .side = Side::at_most});
  }
  return readings;
}

}  // namespace

std::vector<Law> invariances() {
  return {{.name = "far_apart",
           .group = "invariances",
           .meaning = "a body far away changes nothing",
           .answer = "the same motion",
           .scenes = apart_scenes,
           .read = read_apart},
          {.name = "lengths_by_powers",
           .group = "invariances",
           .meaning = "the unit of length changes nothing",
           .answer = "positions times 2^±7, to the bit",
           .scenes = scaled_scenes,
           .read = read_scaled}};
}

}  // namespace ogc::compare
