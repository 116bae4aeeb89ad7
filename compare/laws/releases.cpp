// Tests bodies that leave a contact. At d = r the contact's force is 0 and must stay 0: the body then moves freely
// (falls.cpp), or as it would without the floor. This also holds if `contact_margin` lists the contact at distances at
// which it has no force.
//
// A triangle of three equal vertices that falls flat on a floor of one triangle stays flat. Each vertex is a mass on
// its own spring, and implicit Euler's step minimises ‖x − y‖²/(2h²) + (k_c/m)/2 max(0, r − x)² with y = x + h v + h²
// a,
//
//     x' = y where y ≥ r, otherwise (y + κ r)/(1 + κ), κ = h² k_c/m                 (law_measures::bounced).   (1)
//
// With a convex potential U implicit Euler loses at least m (v' − v)²/2 in each step, so m v²/2 + m g x + U never
// rises. That requires that a contact is listed in the step in which its distance falls below r. But a detection lists
// only contacts whose distance is below r when the step starts. So in the step of the impact the triangle moves up to h
// v below r, and the contact does not yet do the work k_c (h v)²/2. The bounce gains up to that energy. After a fall of
// height H, v² is 2 g H, so the gain is at most κ times the energy of the fall. This limit is derived, and
// `contact_margin` changes it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr double spacing = 0.05, reach = 0.5;
constexpr Index sheet_vertices = 25;

/// Returns a scene with a sheet at d = r and the given gravity.
Scene leaving(const char* name, const Vec3& gravity, double floor_speed) {
  Scene scene = empty_scene(name, 0.005, 20, 40);
  scene.gravity = gravity;
  const Material material = cloth(1);
  append_body(scene, {.name = "sheet", .material = material}, sheet(5, 5, spacing, scene.settings.contact_radius));
  append_body(scene, {.name = "floor", .fixed = floor_speed == 0, .material = material}, floor_triangle(reach, 0));
  if (floor_speed != 0)
    scene.motions.push_back(
        {.name = "floor", .vertices = {25, 26, 27}, .velocity = {floor_speed, -floor_speed, 0}, .keyframes = {}});
  round_to_single(scene);
  return scene;
}

/// Returns the largest distance of the sheet's vertices from free flight at any step, in units of the rounding error
/// (flight_rounding).
Reading distance_from_flight(const Trajectory& run) {
  const double h = run.scene.settings.time_step, largest = largest_coordinate(run);
  double most = 0;
  for (std::size_t n = 1; n < run.states.size(); ++n) {
    const double t = static_cast<double>(n) * h;
    for (std::size_t v = 0; v < static_cast<std::size_t>(run.scene.bodies[0].vertex_count); ++v) {
      const Vec3 law = plus(run.scene.mesh.positions[v], run.scene.gravity, (t * t + t * h) / 2);
      most = std::max(most, length(plus(run.states[n].positions[v], law, -1)) /
                                flight_rounding(static_cast<std::int64_t>(n), largest));
    }
  }
  const std::string listed = run.scene.settings.contact_margin > 0 ? ", listed before they act" : "";
  return {.what = "distance from free flight" + listed,
          .unit = "roundings",
          .measured = most,
          .answer = 0,
          .tolerance = std::sqrt(3.),
          .side = Side::at_most};
}

std::vector<Reading> read_leaving(std::span<const Trajectory> runs) {
  return {distance_from_flight(runs[0]), distance_from_flight(runs[1])};
}

/// Returns the scene, and the same scene with contacts listed at distances up to 2 r.
std::vector<Scene> with_early_lists(const Scene& scene) {
  Scene early = scene;
  early.settings.contact_margin = 1;
  return {scene, early};
}

/// Returns two scenes, with a floor and without. A sheet at d = r is thrown up with unequal velocities, so that it
/// stretches.
std::vector<Scene> beyond_scenes(LawSize) {
  Scene with = leaving("beyond_contact", {0, 0, 0}, 0);
  with.settings.contact_margin = 1;
  for (std::size_t v = 0; v < static_cast<std::size_t>(sheet_vertices); ++v) {
    const Vec3& x = with.mesh.positions[v];
    with.velocities[v] = {0, 0.5 + 4 * x.x + 40 * x.z * x.z, 0};
  }
  Scene without = with;
  for (Vec3& x : without.mesh.positions)
    if (x.y == 0) x.y = -1;
  without.rest_positions = without.mesh.positions;
  round_to_single(with);
  round_to_single(without);
  return {with, without};
}

/// Reads the largest difference between the two runs. Unfinished steps may change the sheet's deviation from free
/// flight by the share force_left.
std::vector<Reading> read_beyond(std::span<const Trajectory> runs) {
  const Trajectory &with = runs[0], &without = runs[1];
  double most = 0, elastic = 0;
  for (std::size_t n = 0; n < with.states.size(); ++n)
    for (std::size_t v = 0; v < static_cast<std::size_t>(sheet_vertices); ++v) {
      const double t = static_cast<double>(n) * with.scene.settings.time_step;
      const Vec3 free = plus(with.scene.mesh.positions[v], with.scene.velocities[v], t);
      most = std::max(most, length(plus(with.states[n].positions[v], without.states[n].positions[v], -1)));
      elastic = std::max(elastic, length(plus(without.states[n].positions[v], free, -1)));
    }
  return {{.what = "distance from the motion without a floor",
           .unit = "m",
           .measured = most,
           .answer = 0,
           .tolerance = force_left(with) * elastic + flight_rounding(20, 0.2),
           .side = Side::at_most}};
}

/// Returns one triangle with equal masses above a floor of one triangle.
Scene small_triangle(const char* name, double height, double time_step, std::int64_t steps, const Vec3& gravity) {
  Scene scene = empty_scene(name, time_step, steps, 40);
  scene.gravity = gravity;
  scene.settings.contact_radius = 0.02;
  Material material = cloth(0);
  material.contact_stiffness = 20;
  append_body(scene, {.name = "triangle", .material = material}, floor_triangle(spacing / 3, height));
  append_body(scene, {.name = "floor", .fixed = true, .material = material}, floor_triangle(reach, 0));
  round_to_single(scene);
  return scene;
}

std::vector<Height> heights_by_law(const Trajectory& run) {
  const Scene& scene = run.scene;
  const double mass = mass_of(scene, 0) / 3;
  std::vector<Height> heights{{run.states[0].positions[0].y, 0}};
  while (heights.size() < run.states.size())
    heights.push_back(bounced(heights.back(), scene.gravity.y, scene.bodies[0].material.contact_stiffness / mass,
                              scene.settings.contact_radius, scene.settings.time_step));
  return heights;
}

/// Returns the largest distance of the centre's height from (1). Each step in contact leaves up to 10⁻⁴ of its force.
/// Forty sweeps leave no more, because each vertex has one spring. Fewer than ten steps are in contact, so the
/// tolerance is 10⁻³ of the distance that the height travels.
Reading distance_of_height(const Trajectory& run) {
  const std::vector<Height> law = heights_by_law(run);
  double most = 0, way = 0;
  for (std::size_t n = 1; n < law.size(); ++n) {
    most = std::max(most, std::abs(centre(run.scene, 0, run.states[n]).y - law[n].x));
    way += std::abs(law[n].x - law[n - 1].x);
  }
  const double rounding = flight_rounding(static_cast<std::int64_t>(run.rows.size()), run.scene.mesh.positions[0].y);
  return {.what = "distance of the height from the law",
          .unit = "m",
          .measured = most,
          .answer = 0,
          .tolerance = 1e-3 * way + rounding,
          .side = Side::at_most};
}

std::vector<Reading> read_heights(std::span<const Trajectory> runs) { return {distance_of_height(runs[0])}; }

/// Returns the sum of the triangle's kinetic energy, gravity's energy and the springs' energy [J].
double energy_of_bounce(const Trajectory& run, const LawState& state) {
  const double r = run.scene.settings.contact_radius;
  double energy = kinetic_energy(run.scene, state) -
                  mass_of(run.scene, 0) * run.scene.gravity.y * centre(run.scene, 0, state).y;
  for (std::size_t v = 0; v < 3; ++v)
    energy += run.scene.bodies[0].material.contact_stiffness * std::pow(std::max(0., r - state.positions[v].y), 2) / 2;
  return energy;
}

/// Returns the largest rise of energy, divided by the energy of the fall.
double energy_gained(const Trajectory& run) {
  double least = std::numeric_limits<double>::infinity(), rise = 0;
  for (const LawState& state : run.states) {
    const double energy = energy_of_bounce(run, state);
    rise = std::max(rise, energy - least);
    least = std::min(least, energy);
  }
  return rise / (mass_of(run.scene, 0) * standard_gravity *
                 (run.scene.mesh.positions[0].y - run.scene.settings.contact_radius));
}

std::vector<Reading> read_bounce(std::span<const Trajectory> runs) {
  const Trajectory& late = runs[1];
  const double h = late.scene.settings.time_step;
  const double kappa = 3 * h * h * late.scene.bodies[0].material.contact_stiffness / mass_of(late.scene, 0);
  const Reading gained{.what = "energy gained over that of the fall",
                       .unit = "1",
                       .measured = energy_gained(runs[0]),
                       .answer = 0,
                       .tolerance = 1e-3,
                       .side = Side::at_most};
  Reading listed_late = gained;
  listed_late.what = "the same where contacts are listed within r alone";
  listed_late.measured = energy_gained(late);
  listed_late.limit = kappa;
  listed_late.why =
      "contacts that are listed where a step begins miss the step of the impact: up to h² k_c/m of the "
      "fall's energy; contact_margin moves it";
  return {distance_of_height(runs[0]), gained, listed_late};
}

std::vector<Scene> lift_scenes(LawSize) { return with_early_lists(leaving("lifts_off", {0, standard_gravity, 0}, 0)); }
std::vector<Scene> partner_scenes(LawSize) { return with_early_lists(leaving("partner_leaves", down, 1)); }
std::vector<Scene> release_scenes(LawSize) { return {small_triangle("lets_go", 0.016, 0.005, 40, {0, 0, 0})}; }
std::vector<Scene> bounce_scenes(LawSize) {
  Scene late = small_triangle("bounces", 0.04, 0.002, 150, down), early = late;
  early.settings.contact_margin = 1;
  return {early, late};
}

}  // namespace

std::vector<Law> releases() {
  constexpr std::string_view free = "x_n = x_0 + h² g n (n + 1)/2";
  constexpr std::string_view spring = "x' = y, below r (y + κ r)/(1 + κ), κ = h² k_c/m";
  return {{.name = "lifts_off",
           .group = "release",
           .meaning = "what gravity pulls off a floor is not held back",
           .answer = free,
           .scenes = lift_scenes,
           .read = read_leaving},
          {.name = "partner_leaves",
           .group = "release",
           .meaning = "a floor that moves away is not followed",
           .answer = free,
           .scenes = partner_scenes,
           .read = read_leaving},
          {.name = "beyond_contact",
           .group = "release",
           .meaning = "a floor beyond r does not change how a sheet bends away from it",
           .answer = "the motion without the floor",
           .scenes = beyond_scenes,
           .read = read_beyond},
          {.name = "lets_go",
           .group = "release",
           .meaning = "a contact pushes as its spring says, and lets go",
           .answer = spring,
           .needs_springs = true,
           .scenes = release_scenes,
           .read = read_heights},
          {.name = "bounces",
           .group = "release",
           .meaning = "a bounce is the spring's, and gains no energy",
           .answer = spring,
           .needs_springs = true,
           .scenes = bounce_scenes,
           .read = read_bounce}};
}

}  // namespace ogc::compare
