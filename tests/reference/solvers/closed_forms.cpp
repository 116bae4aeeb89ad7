// Compares Newton's steps with states in closed form. Free fall, pressed contact, sliding block and momentum are in
// newton/solver.cpp.
#include <algorithm>
#include <cmath>

#include "reference/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns a motion that fixes these vertices.
compare::PrescribedMotion held(std::string name, std::vector<compare::Index> vertices) {
  compare::PrescribedMotion motion;
  motion.name = std::move(name);
  motion.vertices = std::move(vertices);
  return motion;
}

/// Returns `count` cells of length a along x, with two cells of width a/2 side by side.
compare::Mesh strip(compare::Index count, double a) {
  compare::Mesh mesh;
  for (compare::Index i = 0; i <= count; ++i)
    for (compare::Index j = 0; j <= 2; ++j) mesh.positions.push_back({a * i, 0, a * j / 2});
  for (compare::Index i = 0; i < count; ++i)
    for (compare::Index j = 0; j < 2; ++j) {
      const compare::Index p = 3 * i + j, q = p + 1, r = p + 3, s = p + 4;
      if ((i + j) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{p, q, s}, {p, s, r}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{p, q, r}, {q, s, r}});
    }
  return mesh;
}

}  // namespace

TEST_CASE("Newton: a cantilever strip sags as the hinges' moments say", "[property]") {
  // In a bend about z, a cell's four corners lie on two parallel lines, so diagonals stay flat and only the transverse
  // edges resist. Their energy is k_b/2 · 3 w²/(w a) θ² over the width w, hence the moment is (3 k_b w/a) θ. The moment
  // at row i is the weight beyond row i times the arm of this weight.
  const compare::Index count = 10;
  const double a = 0.01, weight = 0.2 * 9.81 * 0.01 * a, stiffness = 2e-4;
  compare::Material material;
  material.bending_stiffness = stiffness;
  material.lame_mu = material.lame_lambda = 1e4;
  compare::Scene scene;
  scene.name = "cantilever";
  append_body(scene, {.name = "strip", .material = material}, strip(count, a));
  scene.motions = {held("clamp", {0, 1, 2, 3, 4, 5})};
  scene.settings.time_step = 1;
  scene.settings.contact_radius = 1e-3;
  set_setting(scene.settings, "newton_tolerance", 1e-9);
  set_setting(scene.settings, "newton_iterations", 500);
  const auto simulation = reference::start_newton(scene, {});
  const auto rows = simulation->advance(6);
  REQUIRE(rows.back().status == compare::step_clean);
  double sag = 0;
  for (compare::Index i = 1; i < count; ++i) {
    double moment = 0;
    for (compare::Index j = i + 1; j <= count; ++j) moment += (j == count ? 0.5 : 1) * weight * a * (j - i);
    sag += moment / (3 * stiffness * 0.01 / a) * a * (count - i);
  }
  const compare::Snapshot end = simulation->snapshot();
  REQUIRE(sag > 1e-4);
  // The sag is linear in the slope s of the tip. The neglected terms of order s² are at most (sag/arm)² times a number
  // of order one.
  const double slope = sag / (a * (count - 1));
  for (std::size_t v = 3 * static_cast<std::size_t>(count); v < end.positions.size(); ++v)
    CHECK(-double{end.positions[v].y} == Approx(sag).epsilon(4 * slope * slope + 1e-5));
}

TEST_CASE(
    "Newton: a sheet whose rim is stretched homogeneously takes the same stretch inside, with the energy density of "
    "its strain",
    "[property]") {
  compare::Scene scene;
  scene.name = "stretch";
  compare::Material material;
  material.membrane = compare::MembraneModel::st_venant_kirchhoff;  // the energy density of this model is written below
  add_sheet(scene, 7, 0.06, 0, false, material);
  scene.gravity = {};
  const double along = 1.2, across = 1.1;
  std::vector<compare::Index> rim;
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    if (std::max(std::abs(x.x), std::abs(x.z)) > 0.0299) rim.push_back(static_cast<compare::Index>(v));
    x = {along * x.x, 0, across * x.z};
  }
  const std::vector<compare::Vec3> homogeneous = scene.mesh.positions;
  for (std::size_t v = 0; v < homogeneous.size(); ++v) {
    if (std::find(rim.begin(), rim.end(), static_cast<compare::Index>(v)) != rim.end()) continue;
    scene.mesh.positions[v].x += 1e-3 * std::sin(3.0 * static_cast<double>(v));
    scene.mesh.positions[v].y += 1e-3 * std::cos(2.0 * static_cast<double>(v));
  }
  scene.motions = {held("rim", rim)};
  scene.settings.time_step = 1;
  scene.settings.contact_radius = 1e-3;
  set_setting(scene.settings, "newton_tolerance", 1e-10);
  set_setting(scene.settings, "newton_iterations", 200);
  const auto simulation = reference::start_newton(scene, {});
  const auto rows = simulation->advance(4);
  REQUIRE(rows.back().status == compare::step_clean);
  const compare::Snapshot end = simulation->snapshot();
  for (std::size_t v = 0; v < homogeneous.size(); ++v) {
    CHECK(std::abs(end.positions[v].x - homogeneous[v].x) < 1e-7);
    CHECK(std::abs(end.positions[v].y) < 1e-7);
    CHECK(std::abs(end.positions[v].z - homogeneous[v].z) < 1e-7);
  }
  const double g = (along * along - 1) / 2, f = (across * across - 1) / 2;
  const double energy = 0.06 * 0.06 *
                        (material.lame_lambda / 2 * (g + f) * (g + f) + material.lame_mu * (g * g + f * f));
  CHECK(rows.back().elastic_energy == Approx(energy).epsilon(1e-5));
}
