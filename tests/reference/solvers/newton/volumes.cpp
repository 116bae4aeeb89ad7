// Tests Newton's method with driven volumes (§3.9): derivatives of their contacts, and the minimiser of converged
// sweeps.
#include <cmath>

#include "compare/oracle/volume_audit.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"
#include "reference/energies/volume_term.hpp"
#include "reference/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::Triple;

namespace {

using compare::Index;
using compare::Vec3;

constexpr double contact_radius = 5e-3;
constexpr std::size_t cloth = 36;  ///< the cloth's vertices come first

/// Returns a contact with a triangle in the plane y = 0.
reference::VolumeTerm term() {
  reference::VolumeTerm term;
  term.vertex = {0, 1, 2, 3};
  term.weight = {1, -0.5, -0.25, -0.25};
  term.normal = {0, 1, 0};
  term.contact_radius = contact_radius;
  term.stiffness = 100;
  return term;
}

/// Returns the positions of a contact whose point is at `height` above the triangle.
std::array<Triple<double>, 4> at_height(double height) {
  return {{{0.1, height, 0.2}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}}};
}

/// Returns a sheet at `height` above a driven block with this velocity [m/s].
compare::Scene sheet_on_block(double height, const Vec3& velocity) {
  compare::Scene scene;
  scene.name = "sheet_on_block";
  compare::Material material;
  material.friction = 0.3;
  material.membrane_damping = material.bending_damping = 1e-4;
  add_sheet(scene, 6, 0.1, height, false, material);
  compare::Mesh block;
  for (int v = 0; v < 8; ++v)
    block.positions.push_back({v / 4 == 0 ? -0.2 : 0.2, v / 2 % 2 == 0 ? -0.1 : 0.0, v % 2 == 0 ? -0.2 : 0.2});
  for (const auto& [a, b, c, d] :
       {compare::Tetrahedron{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    block.triangles.push_back({a, b, c}), block.triangles.push_back({a, c, d});
  append_body(scene, {.name = "block", .material = material, .contact = compare::BodyContact::volume}, block);
  compare::PrescribedMotion motion;
  motion.name = "driven";
  for (Index v = 0; v < 8; ++v) motion.vertices.push_back(static_cast<Index>(cloth) + v);
  motion.velocity = velocity;
  scene.motions.push_back(motion);
  scene.settings.time_step = 5e-3;
  scene.settings.contact_radius = contact_radius;
  compare::round_to_single(scene);
  return scene;
}

double distance(const compare::Vec3f& a, const compare::Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

}  // namespace

TEST_CASE("a contact with a volume: k r from both sides of the surface, no sum of forces, an exact Hessian", "[unit]") {
  const auto derivatives = [](double height) {
    return reference::stencil_derivatives<4>(at_height(height), reference::HessianProjection::none,
                                             [](const auto& corners) { return term().energy(corners); });
  };
  for (const double height : {-4e-3, -1e-9, 1e-9, 4e-3}) {
    const reference::StencilDerivatives at = derivatives(height);
    const double overlap = contact_radius - height;
    CHECK(at.energy == Approx(50 * overlap * overlap));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += at.gradient[3 * k + axis];
      CHECK(sum == Approx(0).margin(1e-15));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(at.gradient[3 * k + 1] == Approx(-100 * overlap * term().weight[k]));
      for (std::size_t l = 0; l < 4; ++l)
        CHECK(at.hessian[12 * (3 * k + 1) + 3 * l + 1] == Approx(100 * term().weight[k] * term().weight[l]));
    }
  }
  CHECK(derivatives(-1e-9).gradient[1] == Approx(derivatives(1e-9).gradient[1]).epsilon(1e-6));
  const reference::StencilDerivatives beyond = derivatives(contact_radius);
  CHECK(beyond.energy == 0);
  for (const double g : beyond.gradient) CHECK(g == 0);
  for (const double h : beyond.hessian) CHECK(h == 0);
}

TEST_CASE("volumes: Newton's method and converged sweeps end at the same minimiser, friction included", "[property]") {
  compare::Scene scene = sheet_on_block(4.9e-3, {0.05, 0.02, 0.01});
  scene.settings.iterations = 3000;
  set_setting(scene.settings, "newton_tolerance", 1e-9);
  set_setting(scene.settings, "newton_iterations", 1000);
  set_setting(scene.settings, "newton_friction_solves", 100);
  const auto newton = reference::start_newton(scene, {}), vbd = reference::start_vbd(scene, {});
  for (int step = 1; step <= 4; ++step) {
    const compare::StepMetrics row = newton->advance(1).back(), swept = vbd->advance(1).back();
    CHECK(row.status == compare::step_clean);
    CHECK(row.largest_lag == 0);
    CHECK(row.volume_contacts >= static_cast<std::int64_t>(cloth));
    CHECK(row.volume_contacts == swept.volume_contacts);
    const compare::Snapshot a = newton->snapshot(), b = vbd->snapshot();
    // Each step rounds both results to single precision, each coordinate by at most 2⁻²⁵ · 0.1 m. The rounded positions
    // also change the velocities and thus the next targets, so a step adds less than twice the previous difference.
    for (std::size_t v = 0; v < cloth; ++v)
      CHECK(distance(a.positions[v], b.positions[v]) < std::pow(3, step) * std::sqrt(3) * 0x1p-25 * 0.1);
  }
}

TEST_CASE("Newton: who begins inside a volume comes out on the nearest side, and stays out", "[property]") {
  compare::Scene scene = sheet_on_block(-4e-3, {});
  set_setting(scene.settings, "newton_tolerance", 1e-6);
  const compare::VolumeAuditor auditor(scene);
  CHECK(auditor.audit(scene.mesh.positions).vertices_inside == cloth);
  const auto newton = reference::start_newton(scene, {});
  for (const compare::StepMetrics& row : newton->advance(60)) {
    CHECK(row.status == compare::step_clean);
    // measured at the step's last detection; a converged step has pushed all vertices out
    CHECK(row.vertices_inside == 0);
  }
  const compare::Snapshot end = newton->snapshot();
  CHECK(auditor.audit(compare::to_double(end.positions)).vertices_inside == 0);
  for (std::size_t v = 0; v < cloth; ++v) CHECK(end.positions[v].y > 0);
}
