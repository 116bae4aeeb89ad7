// Compares solids in the reference's solvers with closed forms (free fall, a stretched bar), and the two solvers of one
// potential with each other.
#include <algorithm>
#include <cmath>

#include "reference/ipc/simulation.hpp"
#include "reference/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

std::unique_ptr<compare::Simulation> start_sweeps(const compare::Scene& scene,
                                                  const compare::SimulationOptions& options) {
  return reference::start_vbd(scene, options, {});
}

constexpr double stretch = 1.3, mu = 1e4, lambda = 3e4;

/// Returns the bar's width over its width at rest, without a lateral force: J − 1 = μ (a − 1)/((λ + μ) a) for the
/// stretch a (tests/fast/cpu/solids.cpp).
double width() { return std::sqrt((1 + mu * (stretch - 1) / ((lambda + mu) * stretch)) / stretch); }

/// Returns a bar whose ends are held at this stretch and at their final width. Its inside starts at the width of the
/// rest shape.
compare::Scene stretched_bar() {
  compare::Scene scene;
  scene.name = "bar";
  compare::Material material;
  material.solid_mu = mu, material.solid_lambda = lambda;
  append_body(scene, {.name = "bar", .material = material}, block_mesh(4, 0.1));
  compare::PrescribedMotion ends;
  ends.name = "ends";
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    const bool held = x.x < 0.05 || x.x > 0.25;
    if (held) ends.vertices.push_back(static_cast<compare::Index>(v));
    x = {stretch * x.x, (held ? width() : 1) * x.y, (held ? width() : 1) * x.z};
  }
  scene.motions = {ends};
  scene.gravity = {};
  scene.settings.contact_radius = 0.02;
  scene.settings.time_step = 1;
  return scene;
}

}  // namespace

TEST_CASE("solids: a block falls as -g h^2 n(n+1)/2 with every solver, and none of it is inverted", "[property]") {
  compare::Scene scene = solid_scene();
  const double g = 9.81f, h = static_cast<double>(static_cast<float>(scene.settings.time_step));
  for (const StartSolver start :
       {StartSolver(reference::start_newton), StartSolver(start_sweeps), StartSolver(reference::start_ipc)}) {
    const Run run = run_of(start, scene, 5);
    REQUIRE(clean(run));
    CHECK(run.rows.back().inverted_tetrahedra == 0);
    for (std::size_t v = 0; v < run.end.positions.size(); ++v) {
      const compare::Vec3& rest = scene.mesh.positions[v];
      // Positions are below 1 m in single precision, and solvers stop at residuals of at most 10⁻⁴ of gravity's force.
      CHECK(double{run.end.positions[v].y} == Approx(rest.y - g * h * h * 15).margin(2e-6));
      CHECK(double{run.end.positions[v].x} == Approx(rest.x).margin(2e-6));
    }
  }
}

TEST_CASE("solids: Newton's stretched bar has the closed-form width and energy, and sweeps come to the same",
          "[property]") {
  compare::Scene scene = stretched_bar();
  const double j = stretch * width() * width();
  const double density = mu / 2 * (stretch * stretch + 2 * width() * width() - 3) - mu * (j - 1) +
                         (lambda + mu) / 2 * (j - 1) * (j - 1);
  for (const StartSolver start : {StartSolver(reference::start_newton), StartSolver(start_sweeps)}) {
    const Run run = run_of(start, scene, 12);
    REQUIRE(clean(run));
    CHECK(run.rows.back().elastic_energy == Approx(density * 0.027).epsilon(1e-4));
    for (std::size_t v = 0; v < run.end.positions.size(); ++v) {
      const compare::Vec3& rest = scene.rest_positions[v];
      CHECK(double{run.end.positions[v].x} == Approx(stretch * rest.x).margin(2e-5));
      CHECK(double{run.end.positions[v].y} == Approx(width() * rest.y).margin(2e-5));
    }
  }
}

TEST_CASE("solids: Newton brings an inverted block back", "[property]") {
  compare::Scene scene = solid_scene();
  scene.gravity = {};
  scene.bodies[0].material.solid_damping = 0.02;
  scene.mesh.positions[13] = {0.1, 0.35, 0.1};
  const Run run = run_of(reference::start_newton, scene, 40);
  REQUIRE(clean(run));
  CHECK(run.rows.front().inverted_tetrahedra > 0);
  CHECK(run.rows.back().inverted_tetrahedra == 0);
}
