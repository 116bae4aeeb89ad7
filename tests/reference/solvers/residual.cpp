// Tests Eq. 29 where every force has a closed form: a triangle moves rigidly, so only inertia acts.
#include "reference/solvers/residual.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "reference/solvers/step.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns one triangle, 1 cm wide, without neighbours.
compare::Scene lone_triangle() {
  compare::Scene scene;
  scene.name = "lone_triangle";
  compare::Material soft;  // soft, because rounded rest data cause a strain, whose force must be negligible
  soft.lame_lambda = soft.lame_mu = 1e-3;
  append_body(scene, {.name = "triangle", .material = soft},
              {{{0, 0, 0}, {0, 0, 0.01}, {0.01, 0, 0}}, {{0, 1, 2}}, {}});
  scene.gravity = {};
  scene.settings.guess_rounds = 1;
  return scene;
}

}  // namespace

TEST_CASE("the residual is the mean force by that after the guess loop, to the rounding of positions", "[property]") {
  compare::Scene scene = lone_triangle();
  const compare::Settings& settings = scene.settings;
  const double speed = 2, h = settings.time_step, way = speed * h;
  const double mass = scene.bodies[0].material.density * 0.5e-4 / 3;  // a third of the triangle's mass, at each vertex
  // Nothing is near, so by Eq. 21 each vertex stays within γ_p r_q of its start; r_q has an upper limit (method.md
  // §5.3).
  const double query_radius = std::min(settings.contact_radius + way,
                                       settings.detection_radius_cap * settings.contact_radius);
  const double guessed = settings.bounds_relaxation * query_radius;
  REQUIRE(guessed < 0.9 * way);
  const std::vector<compare::Vec3f> start = compare::to_single(scene.mesh.positions);
  const std::vector<compare::Vec3f> velocity(3, {0, -static_cast<float>(speed), 0});
  reference::ResidualMeter meter(scene);
  meter.begin_step(start, velocity, 1);
  CHECK(meter.reference_force() == Approx(mass * (way - guessed) / (h * h)).epsilon(1e-5));
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    std::vector<std::array<double, 3>> x;
    for (const compare::Vec3f& p : start) x.push_back({p.x, p.y - way + share * (way - guessed), p.z});
    const reference::Residual residual = meter.at(x);
    CHECK(residual.force ==
          Approx(share * mass * (way - guessed) / (h * h)).epsilon(1e-5).margin(1e-5 * meter.reference_force()));
    CHECK(residual.share == Approx(share).epsilon(1e-5).margin(1e-5));
    CHECK(residual.contacts == 0);
  }
}
