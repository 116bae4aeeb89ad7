// Eq. 29 where the run is, against the reference's own measure of the same states with the same sets.
#include <cmath>

#include "compare/laws/measures.hpp"
#include "experiments/program/runs/measured_simulation.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::experiments;

namespace {

std::vector<compare::StepMetrics> rows_of(const compare::Contestant& contestant, const compare::Scene& scene) {
  return contestant.start(scene, {})->advance(scene.settings.steps);
}

}  // namespace

// Reference: forces in double, its own guess loop for f*, the contacts of the contestant's last detection. The two
// differ by what rounded positions make of a force, which the row bounds for its own mean; f* is rounded once more.
TEST_CASE("what a step leaves of forces is what the reference finds, but for rounding", "[figure]") {
  struct Case {
    std::string name;
    std::int64_t iterations, steps;
    compare::Bounds bounds;
  };
  for (const auto& [name, iterations, steps, bounds] :
       {Case{"cloth_on_sphere", 100, 30, compare::Bounds::ball},
        Case{"cloth_on_sphere", 100, 30, compare::Bounds::planes}, Case{"mat_twist", 150, 12, compare::Bounds::ball}}) {
    compare::Scene scene = make_scene(name, Scale::smoke);
    scene.settings.iterations = iterations, scene.settings.steps = steps, scene.settings.bounds = bounds;
    round_to_single(scene);
    const std::vector<compare::StepMetrics> rows = rows_of(
        measured(fast::contestant(fast::Backend::cpu), {.iterations = true}), scene);
    std::size_t compared = 0;
    for (const compare::StepMetrics& row : rows) {
      const std::int64_t every = (300 + scene.settings.iterations - 1) / scene.settings.iterations;
      CHECK(std::isnan(row.left_residual) == (row.step % every != 0));
      if (std::isnan(row.left_residual) || row.left_held > 0 || row.left_rounding > 0.01) continue;
      CAPTURE(name, row.step, row.left_residual, row.left_rounding);
      CHECK(std::abs(row.left_residual - row.iteration_rows.back().residual) <= 2 * row.left_rounding);
      CHECK(row.left_rounding > 0);
      ++compared;
    }
    CHECK(compared >= 3);
  }
}

// As nothing touches, x after s and after s − 1 sweeps are ends of runs with so many iterations. The cloth is bent by
// its velocities, so that sweeps have something to do.
TEST_CASE("the last sweep's motion is that of a run with one sweep more", "[unit]") {
  compare::Scene scene = make_scene("cloth_on_sphere", Scale::smoke);
  scene.settings.steps = 1;
  for (std::size_t v = 0; v < scene.velocities.size(); ++v) scene.velocities[v].y = 5 * scene.mesh.positions[v].x;
  round_to_single(scene);
  const compare::Contestant fast = fast::contestant(fast::Backend::cpu);
  for (const std::int64_t iterations : {2, 3}) {
    const auto end_of = [&](std::int64_t of_step, std::vector<compare::StepMetrics>& rows) {
      scene.settings.iterations = of_step;
      const auto simulation = fast.start(scene, {});
      rows = simulation->advance(1);
      return simulation->snapshot().positions;
    };
    std::vector<compare::StepMetrics> rows, others;
    const std::vector<compare::Vec3f> last = end_of(iterations, rows), before = end_of(iterations - 1, others);
    const std::vector<compare::Vec3f> start = compare::to_single(scene.mesh.positions);
    const compare::Body& cloth = scene.bodies.front();
    REQUIRE(cloth.name == "cloth");
    double swept = 0, moved = 0;
    const std::vector<double> mass = compare::law_measures::masses(scene);
    for (compare::Index v = cloth.first_vertex; v < cloth.first_vertex + cloth.vertex_count; ++v) {
      const auto i = static_cast<std::size_t>(v);
      const auto squared = [&](const compare::Vec3f& a, const compare::Vec3f& b) {
        const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
        return mass[i] * (x * x + y * y + z * z);
      };
      swept += squared(last[i], before[i]), moved += squared(last[i], start[i]);
    }
    // fast's masses are single: their shares differ by 2u
    CHECK(rows.front().last_motion == Approx(std::sqrt(swept / moved)).epsilon(2 * 0x1p-24));
    CHECK(rows.front().last_motion > 0);
  }
}
