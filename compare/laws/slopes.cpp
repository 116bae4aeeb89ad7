// Tests slopes: gravity is tilted by α over a level floor, so that x points down the slope. A body at rest in contact
// has the normal force m g cos α. A body that moves along the floor has the same normal force in the mean over time,
// since its momentum along the normal is bounded. So along the slope its centre obeys Coulomb's law, smoothed as in
// method.md §4.4. Implicit Euler makes this one equation for each step (law_measures::slid):
//
//     v' = v + h (g sin α − μ g cos α f₁(v'/ε_v)),   x' = x + h v',   f₁(y) = 2 y − y² for y < 1, else 1.
//
// At velocities beyond ε_v, x is ½ (g sin α − μ g cos α) t² plus h t/2 times the same acceleration. For tan α < μ
// friction balances gravity at one velocity, f₁(v/ε_v) = tan α/μ, the creep
//
//     v = ε_v (1 − √(1 − tan α/μ)).
//
// Tolerances. The normal force λ of friction lags by up to one solve or sweep. Barriers have no force at the start of a
// motion, so their λ lags by another step (law_measures::lagged_steps). If λ lags by n steps of a slide of duration T,
// friction's impulse misses up to n h μ m g cos α. That is a share n h/T of the velocity that friction changes, and a
// share 2 n h/T of the distance that it changes. Sweeps end with an error of λ; they are required to reach force_left
// of the weight. A relative error e of λ changes the acceleration by the share e μ cos α/(sin α − μ cos α). Without
// friction only truncation acts along the floor: the guess loop may end with up to γ_e = 1 % of the vertices cut.
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

/// One slope: its angle, friction, and the initial velocity down it.
struct Slope {
  double angle = 0, friction = 0, velocity = 0;  ///< [rad], [1], [m/s]
};
constexpr double radius = 0.01, sheet_side = 0.2, block_side = 0.1;

Vec3 tilted(double angle) { return {standard_gravity * std::sin(angle), -standard_gravity * std::cos(angle), 0}; }

/// Adds a floor of 49 vertices at distances of 1 m, so that bodies cross its edges and vertices.
void add_floor(Scene& scene, const Material& material) {
  append_body(scene, {.name = "floor", .fixed = true, .material = material}, sheet(7, 7, 1, 0));
}

/// Returns a sheet at the depth at which the springs of its 25 vertices support its weight.
Scene sheet_on(const char* name, const Slope& slope, std::int64_t steps) {
  Scene scene = empty_scene(name, 0.005, steps, 40);
  scene.gravity = tilted(slope.angle);
  Material material = cloth(slope.friction);
  material.bending = BendingModel::discrete_hinge;
  material.bending_stiffness = 1e-3;
  const double weight = material.density * sheet_side * sheet_side * standard_gravity * std::cos(slope.angle);
  append_body(scene, {.name = "sheet", .material = material},
              sheet(5, 5, sheet_side / 4, radius - weight / (25 * material.contact_stiffness)));
  set_velocity(scene, 0, {slope.velocity, 0, 0});
  add_floor(scene, material);
  round_to_single(scene);
  return scene;
}

/// Returns a block of soft rubber with 27 vertices; nine vertices are on the floor.
Scene block_on(const char* name, const Slope& slope, std::int64_t steps) {
  Scene scene = empty_scene(name, 0.005, steps, 40);
  scene.gravity = tilted(slope.angle);
  Material material = cloth(slope.friction);
  material.solid_density = 500;
  material.solid_mu = 1e5 / (2 * 1.3);
  material.solid_lambda = 1e5 * 0.3 / (1.3 * 0.4);
  material.contact_stiffness = 5000;
  const double weight = material.solid_density * std::pow(block_side, 3) * standard_gravity * std::cos(slope.angle);
  append_body(scene, {.name = "block", .material = material},
              box({2, 2, 2}, block_side / 2,
                  {-block_side / 2, radius - weight / (9 * material.contact_stiffness), -block_side / 2}));
  set_velocity(scene, 0, {slope.velocity, 0, 0});
  add_floor(scene, material);
  round_to_single(scene);
  return scene;
}

/// Distance [m] and velocity [m/s] of a slide by the discrete law, with the numbers of the run's scene.
struct Slid {
  double way = 0, velocity = 0;
};
Slid slid_down(const Trajectory& run, std::size_t steps) {
  const Vec3 g = run.scene.gravity;
  Slid now{0, run.scene.velocities[0].x};
  for (std::size_t n = 0; n < steps; ++n) {
    now.velocity = slid(now.velocity, g.x, -g.y * run.scene.bodies[0].material.friction,
                        run.scene.settings.friction_velocity, run.scene.settings.time_step);
    now.way += run.scene.settings.time_step * now.velocity;
  }
  return now;
}

/// Relative errors that come from the lag of friction's normal force and from unfinished sweeps: of a distance, and of
/// a velocity, that only friction changes. The lag counts twice for a distance.
struct Share {
  double way = 0, velocity = 0;
};
Share friction_share(const Trajectory& run, double seconds) {
  const double mu = run.scene.bodies[0].material.friction, along = run.scene.gravity.x, normal = -run.scene.gravity.y;
  const double lag = lagged_steps(run) * run.scene.settings.time_step / seconds, left = force_left(run);
  const double per_force = mu * normal / std::abs(along - mu * normal);
  return {(2 * lag + left) * per_force, (lag + left) * per_force};
}

double way_of(const Trajectory& run) {
  return centre(run.scene, 0, run.states.back()).x - centre(run.scene, 0, run.states.front()).x;
}

void add_slide(std::vector<Reading>& readings, const Trajectory& run) {
  const Slid law = slid_down(run, run.rows.size());
  const Share share = friction_share(run, run.scene.settings.time_step * static_cast<double>(run.rows.size()));
  const std::string with = " (" + std::to_string(run.scene.settings.iterations) +
                           " sweeps, h = " + std::to_string(std::lround(1e6 * run.scene.settings.time_step)) + " µs)";
  readings.push_back({.what = "way" + with,
                      .unit = "m",
                      .measured = way_of(run),
                      .answer = law.way,
                      .tolerance = share.way * law.way});
  readings.push_back({.what = "velocity" + with,
                      .unit = "m/s",
                      .measured = centre_velocity(run.scene, 0, run.states.back()).x,
                      .answer = law.velocity,
                      .tolerance = share.velocity * law.velocity});
}

std::vector<Reading> read_slide(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  for (const Trajectory& run : runs) add_slide(readings, run);
  return readings;
}

/// Reads the second half of the run, when the disturbance of the start has decayed.
std::vector<Reading> read_stick(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const std::size_t last = run.states.size() - 1, half = last / 2;
  const double seconds = static_cast<double>(last - half) * run.scene.settings.time_step;
  const double way = centre(run.scene, 0, run.states[last]).x - centre(run.scene, 0, run.states[half]).x;
  const double share = run.scene.gravity.x / (-run.scene.gravity.y * run.scene.bodies[0].material.friction);
  const double creep = run.scene.settings.friction_velocity * (1 - std::sqrt(1 - share));
  // Let y be the creep divided by ε_v. A relative error e of the normal force λ changes f₁(y) by e f₁, so it changes y
  // by e f₁/(2 (1 − y)). Rounding changes x by at most one rounding error per step.
  const double error = (lagged_steps(run) / static_cast<double>(run.rows.size()) + force_left(run)) * share /
                       (2 * std::sqrt(1 - share)) * run.scene.settings.friction_velocity;
  return {{.what = "creep",
           .unit = "m/s",
           .measured = way / seconds,
           .answer = creep,
           .tolerance = error + unit_roundoff * largest_coordinate(run) / run.scene.settings.time_step}};
}

std::vector<Reading> read_frictionless(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const Slid law = slid_down(run, run.rows.size());
  const double velocity = centre_velocity(run.scene, 0, run.states.back()).x, share = 0.01;
  return {{.what = "velocity",
           .unit = "m/s",
           .measured = velocity,
           .answer = law.velocity,
           .tolerance = share * law.velocity}};
}

/// Reads the distance that the body slides until it rests at the time v/(μ g), and checks that it rests then.
std::vector<Reading> read_stop(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const Slid law = slid_down(run, run.rows.size());
  const double braking = standard_gravity * run.scene.bodies[0].material.friction;
  const double share = friction_share(run, run.scene.velocities[0].x / braking).way;
  return {
      {.what = "way to rest", .unit = "m", .measured = way_of(run), .answer = law.way, .tolerance = share * law.way},
      {.what = "speed at rest",
       .unit = "m/s",
       .measured = std::abs(centre_velocity(run.scene, 0, run.states.back()).x),
       .answer = law.velocity,
       .tolerance = 0.01 * run.scene.settings.friction_velocity,
       .side = Side::at_most}};
}

constexpr Slope steep{degrees(20), 0.2, 0}, gentle{degrees(2), 1, 0}, smooth{degrees(20), 0, 0}, level{0, 0.2, 0.5};

/// Returns the scene alone or, at the whole size, three scenes: the scene, the scene with five times the sweeps, and
/// the scene with half of h. Each run is compared with the law for its own h.
std::vector<Scene> at_sizes(Scene scene, LawSize size) {
  if (size == LawSize::least) return {scene};
  Scene swept = scene, fine = scene;
  swept.settings.iterations *= 5;
  fine.settings.time_step /= 2;
  fine.settings.steps *= 2;
  return {scene, swept, fine};
}

std::vector<Scene> sheet_slides(LawSize size) { return at_sizes(sheet_on("slope_slides", steep, 200), size); }
std::vector<Scene> block_slides(LawSize size) { return at_sizes(block_on("block_slides", steep, 200), size); }
std::vector<Scene> sheet_sticks(LawSize) { return {sheet_on("slope_sticks", gentle, 200)}; }
std::vector<Scene> block_sticks(LawSize) { return {block_on("block_sticks", gentle, 200)}; }
std::vector<Scene> sheet_smooth(LawSize) { return {sheet_on("slope_frictionless", smooth, 200)}; }
std::vector<Scene> sheet_stops(LawSize) { return {sheet_on("sliding_stops", level, 80)}; }

}  // namespace

std::vector<Law> slopes() {
  constexpr std::string_view slides = "x'' = g (sin α − μ cos α), summed as implicit Euler does",
                             sticks = "creep at ε_v (1 − √(1 − tan α/μ))";
  return {{.name = "slope_slides",
           .group = "slopes",
           .meaning = "a sheet slides down 20° with μ = 0.2",
           .answer = slides,
           .scenes = sheet_slides,
           .read = read_slide},
          {.name = "slope_sticks",
           .group = "slopes",
           .meaning = "a sheet on 2° with μ = 1 creeps and does not slide",
           .answer = sticks,
           .scenes = sheet_sticks,
           .read = read_stick},
          {.name = "slope_frictionless",
           .group = "slopes",
           .meaning = "a sheet on 20° without friction gets as fast as a point, across many contact radii",
           .answer = "v = g sin α t",
           .scenes = sheet_smooth,
           .read = read_frictionless},
          {.name = "sliding_stops",
           .group = "slopes",
           .meaning = "a sheet thrown along a floor comes to rest",
           .answer = "way v²/(2 μ g), summed as implicit Euler does",
           .scenes = sheet_stops,
           .read = read_stop},
          {.name = "block_slides",
           .group = "slopes",
           .meaning = "a block of tetrahedra slides down 20° with μ = 0.2",
           .answer = slides,
           .scenes = block_slides,
           .read = read_slide},
          {.name = "block_sticks",
           .group = "slopes",
           .meaning = "a block of tetrahedra on 2° with μ = 1 creeps",
           .answer = sticks,
           .scenes = block_sticks,
           .read = read_stick}};
}

}  // namespace ogc::compare
