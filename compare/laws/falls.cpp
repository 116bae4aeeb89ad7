// Tests free flight. Implicit Euler has v_n = v_0 + n h g and x_n = x_{n−1} + h v_n, so
//
//     x_n = x_0 + n h v_0 + h² g n (n + 1)/2,
//
// which differs from Galileo's parabola by g h t/2, an error of first order that halves with h. Vertices do not move
// relative to each other, so no elastic forces act, and only rounding remains (flight_rounding). Newton's method ends
// where it begins, since no force acts at the target y.
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr Vec3 gravity{0, -standard_gravity, 0};

Scene thrown_sheet(std::int64_t steps, double seconds) {
  Scene scene = empty_scene("free_fall", seconds / static_cast<double>(steps), steps, 20);
  scene.gravity = gravity;
  append_body(scene, {.name = "sheet", .material = cloth(0)}, sheet(5, 5, 0.05, 0));
  set_velocity(scene, 0, {0.5, 1, 0.25});
  round_to_single(scene);
  return scene;
}

Vec3 discrete_flight(const Scene& scene, const Vec3& start, const Vec3& velocity, std::int64_t n) {
  const double h = scene.settings.time_step, t = static_cast<double>(n) * h;
  return plus(plus(start, velocity, t), scene.gravity, (t * t + t * h) / 2);
}

/// Returns the largest distance of a vertex from the discrete law at any step, divided by the rounding error that
/// positions may have at that step.
double largest_miss(const Trajectory& run) {
  const double largest = largest_coordinate(run);
  double most = 0;
  for (std::size_t n = 1; n < run.states.size(); ++n) {
    const auto steps = static_cast<std::int64_t>(n);
    for (std::size_t v = 0; v < run.scene.mesh.positions.size(); ++v) {
      const Vec3 law = discrete_flight(run.scene, run.scene.mesh.positions[v], run.scene.velocities[v], steps);
      most = std::max(most, length(plus(run.states[n].positions[v], law, -1)) / flight_rounding(steps, largest));
    }
  }
  return most;
}

std::vector<Scene> fall_scenes(LawSize size) {
  const std::int64_t steps = size == LawSize::least ? 20 : 100;
  return {thrown_sheet(steps, size == LawSize::least ? 0.2 : 1)};
}

std::vector<Reading> read_fall(std::span<const Trajectory> runs) {
  // √3: each of three coordinates may be off by one rounding error.
  return {{.what = "distance from the discrete law",
           .unit = "roundings",
           .measured = largest_miss(runs[0]),
           .answer = 0,
           .tolerance = std::sqrt(3.),
           .side = Side::at_most}};
}

std::vector<Scene> order_scenes(LawSize) {
  return {thrown_sheet(10, 0.2), thrown_sheet(20, 0.2), thrown_sheet(40, 0.2)};
}

/// Returns how far below Galileo's parabola the sheet's centre ends [m].
double error_of_fall(const Trajectory& run) {
  const double t = run.scene.settings.time_step * static_cast<double>(run.scene.settings.steps);
  const double start = centre(run.scene, 0, run.states.front()).y, v = run.scene.velocities[0].y;
  return start + v * t + run.scene.gravity.y * t * t / 2 - centre(run.scene, 0, run.states.back()).y;
}

std::vector<Reading> read_order(std::span<const Trajectory> runs) {
  // The error is g h t/2 with h, and half of that with h/2. If rounding changes one of these errors by a share, it
  // changes their ratio by the same share.
  std::vector<Reading> readings;
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const double coarse = error_of_fall(runs[k - 1]), fine = error_of_fall(runs[k]);
    const double noise = flight_rounding(runs[k].scene.settings.steps, largest_coordinate(runs[k]));
    readings.push_back({.what = "error with h over that with h/2",
                        .unit = "1",
                        .measured = coarse / fine,
                        .answer = 2,
                        .tolerance = 3 * noise / std::abs(fine)});
  }
  return readings;
}

}  // namespace

std::vector<Law> falls() {
  return {{.name = "free_fall",
           .group = "falls",
           .meaning = "a thrown sheet moves as implicit Euler moves a point",
           .answer = "x_n = x_0 + n h v_0 + h² g n (n + 1)/2",
           .scenes = fall_scenes,
           .read = read_fall},
          {.name = "free_fall_order",
           .group = "falls",
           .meaning = "the error of a fall is of first order in h",
           .answer = "x(t) − x_n = −g h t/2: half of it with half the step",
           .scenes = order_scenes,
           .read = read_order}};
}

}  // namespace ogc::compare
