// Compares the residual of Eq. 29 that a run computes with the reference's value for the same states and contact sets.
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

// Both residuals use the same positions and contact sets; they differ in f* and rounding. The difference is at most
// `left_rounding`, the residual that storing positions in single precision may cause. Scenes are stiff and have few
// sweeps, so that residuals exceed ten times this limit. An error of a tenth would thus be detected. Contacts of yarn
// have nearly no stiffness, because the reference detects other contacts in its guess loop. Bounds are off, so no
// vertex is held.
TEST_CASE("what a step leaves of forces is what the reference finds, but for rounding", "[figure]") {
  struct Case {
    std::string name;
    std::int64_t iterations, steps, every;
    double stiffer;
  };
  for (const auto& [name, iterations, steps, every, stiffer] :
       {Case{"cloth_on_sphere", 20, 60, 15, 1e3}, Case{"mat_twist", 5, 120, 60, 1e2},
        Case{"yarn_stretch", 10, 90, 30, 1}}) {
    compare::Scene scene = make_scene(name, Scale::smoke);
    scene.settings.iterations = iterations, scene.settings.steps = steps;
    scene.settings.bounds = compare::Bounds::off;
    for (compare::Body& body : scene.bodies) {
      body.material.lame_mu *= stiffer, body.material.lame_lambda *= stiffer;
      body.material.solid_mu *= stiffer, body.material.solid_lambda *= stiffer;
      if (body.material.rod) body.material.contact_stiffness = 1e-12;
    }
    round_to_single(scene);
    for (const compare::StepMetrics& row :
         rows_of(measured(fast::contestant(fast::Backend::cpu), {.iterations = true}), scene)) {
      CAPTURE(name, row.step, row.left_residual, row.left_rounding);
      CHECK(std::isnan(row.left_residual) == (row.step % every != 0));  // `every` is ⌈300/iterations⌉
      if (row.step % every != 0) continue;
      CHECK(std::abs(row.left_residual - row.iteration_rows.back().residual) <= row.left_rounding);
      CHECK(row.left_residual > 10 * row.left_rounding);
      CHECK(row.left_held == 0);
    }
  }
}

TEST_CASE("vertices that a bound holds are counted apart from those that sweeps leave with a force", "[figure]") {
  compare::Scene scene = make_scene("cloth_on_sphere", Scale::smoke);
  scene.settings.iterations = 300;
  round_to_single(scene);
  const auto free = static_cast<double>(scene.bodies.front().vertex_count);  // vertices of the cloth
  std::size_t apart = 0;
  for (const compare::StepMetrics& row :
       rows_of(measured(fast::contestant(fast::Backend::cpu), {.iterations = true}), scene)) {
    if (!(row.left_held > 0) || row.left_rounding > 0.01) continue;
    CAPTURE(row.step, row.left_residual, row.left_held);
    const double all = row.iteration_rows.back().residual;
    CHECK(row.left_residual * (free - row.left_held) <= (all + row.left_rounding) * free);
    apart += row.left_residual < 0.5 * all;
  }
  CHECK(apart >= 3);
}

// Nothing touches. So a run with s − 1 iterations ends in the state before the last sweep of a run with s iterations.
// The initial velocities bend the cloth, so that sweeps have an effect.
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
    // The fast path stores masses in single precision, so its ratio may differ from this one by 2 · 2⁻²⁴.
    CHECK(rows.front().last_motion == Approx(std::sqrt(swept / moved)).epsilon(2 * 0x1p-24));
    CHECK(rows.front().last_motion > 0);
  }
}
