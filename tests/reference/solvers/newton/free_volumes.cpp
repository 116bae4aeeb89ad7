// Tests free volumes (§3.9) in the reference: forces on the corners of triangles, and the common minimiser of Newton's
// method and converged sweeps.
#include <cmath>

#include "compare/oracle/volume_audit.hpp"
#include "reference/simulation.hpp"
#include "reference/solvers/potential.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

using compare::Vec3;

constexpr std::size_t in_block = 27;     ///< number of vertices of a block of 3³
constexpr double contact_radius = 5e-3;  ///< [m]

/// Returns two free blocks; one begins 4 mm inside the other.
compare::Scene two_blocks() {
  compare::Scene scene;
  scene.name = "two_blocks";
  compare::Material material;
  material.solid_damping = 1e-3;
  material.friction = 0.3;
  const auto add = [&](const char* name, const Vec3& corner) {
    append_body(scene, {.name = name, .material = material, .contact = compare::BodyContact::volume},
                block_mesh(3, 0.03, corner));
  };
  add("low", {});
  add("high", {0.013, 0.056, 0.012});
  scene.gravity = {};
  scene.settings.time_step = 5e-3;
  scene.settings.contact_radius = contact_radius;
  set_setting(scene.settings, "newton_tolerance", 1e-9);
  set_setting(scene.settings, "newton_iterations", 1000);
  set_setting(scene.settings, "newton_friction_solves", 100);
  compare::round_to_single(scene);
  return scene;
}

/// Returns Σ m v of a block, divided by its mass.
Vec3 mean_velocity(const compare::Snapshot& state, const std::vector<double>& mass, std::size_t block) {
  Vec3 sum;
  double all = 0;
  for (std::size_t v = block * in_block; v < (block + 1) * in_block; ++v) {
    const compare::Vec3f& u = state.velocities[v];
    sum = {sum.x + mass[v] * u.x, sum.y + mass[v] * u.y, sum.z + mass[v] * u.z};
    all += mass[v];
  }
  return {sum.x / all, sum.y / all, sum.z / all};
}

double distance(const compare::Vec3f& a, const compare::Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

}  // namespace

TEST_CASE("Newton: a free block comes out of another and both fly apart with equal momenta, friction included",
          "[property]") {
  const compare::Scene scene = two_blocks();
  const compare::Topology topology = build_topology(scene);
  const std::vector<double> mass = reference::Potential(scene, topology).mass();
  const compare::VolumeAuditor auditor(scene);
  const std::size_t inside = auditor.audit(scene.mesh.positions).vertices_inside;
  CHECK(inside > 4);
  const auto newton = reference::start_newton(scene, {});
  const std::vector<compare::StepMetrics> rows = newton->advance(10);
  for (const compare::StepMetrics& row : rows) {
    CHECK(row.status == compare::step_clean);
    CHECK(row.depth_unresolved == 0);
  }
  CHECK(auditor.audit(compare::to_double(newton->snapshot().positions)).vertices_inside == 0);
  const Vec3 low = mean_velocity(newton->snapshot(), mass, 0), high = mean_velocity(newton->snapshot(), mass, 1);
  CHECK(high.y > 0.1);
  // Positions near 0.1 m are rounded by up to 2⁻²⁸ m per coordinate. In each of ten steps h, this changes a velocity by
  // 2⁻²⁸/h.
  const double rounded = 10 * 0x1p-28 / scene.settings.time_step;
  CHECK(low.x == Approx(-high.x).margin(rounded));
  CHECK(low.y == Approx(-high.y).margin(rounded));
  CHECK(low.z == Approx(-high.z).margin(rounded));
}

TEST_CASE("free volumes: Newton's method and converged sweeps end at the same minimiser, friction included",
          "[property]") {
  compare::Scene scene = two_blocks();
  scene.settings.iterations = 3000;
  scene.settings.detection_every = 300;  // Newton's method also detects at its end
  const auto newton = reference::start_newton(scene, {}), vbd = reference::start_vbd(scene, {});
  for (int step = 1; step <= 3; ++step) {
    const compare::StepMetrics row = newton->advance(1).back(), swept = vbd->advance(1).back();
    CHECK(row.status == compare::step_clean);
    CHECK(swept.status == compare::step_clean);
    CHECK(swept.volume_contacts > 0);
    const compare::Snapshot a = newton->snapshot(), b = vbd->snapshot();
    // volumes.cpp in this folder derives this limit.
    for (std::size_t v = 0; v < a.positions.size(); ++v)
      CHECK(distance(a.positions[v], b.positions[v]) < std::pow(3, step) * std::sqrt(3) * 0x1p-25 * 0.12);
    // Both solvers start the next step from the same state. Otherwise a contact in only one of the runs would enlarge
    // the difference.
    vbd->restore(a);
  }
}
