// Tests IPC with the frames of rods as unknowns: it reaches the minimiser of the sweeps, and its cords come into
// contact.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/ipc/intersections.hpp"
#include "reference/ipc/simulation.hpp"
#include "reference/ipc/solver.hpp"
#include "reference/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::State;

namespace {

using compare::Index;
using compare::Vec3;

void add_cord(compare::Scene& scene, const char* name, const std::vector<Vec3>& points, bool fixed,
              const compare::RodMaterial& rod) {
  compare::Mesh mesh;
  mesh.positions = points;
  for (Index v = 1; v < static_cast<Index>(points.size()); ++v) mesh.loose_edges.push_back({v - 1, v});
  compare::Body body;
  body.name = name;
  body.fixed = fixed;
  body.material.rod = rod;
  append_body(scene, body, mesh);
}

/// Returns a tilted cord that falls across a fixed one.
compare::Scene crossing_cords() {
  compare::Scene scene;
  scene.name = "crossing";
  const compare::RodMaterial rod{.density = 5e-3, .stretch = 100, .bend = 1e-5, .damping = 1e-4};
  std::vector<Vec3> falls, lies;
  for (int k = -5; k <= 5; ++k) {
    falls.push_back({0.01 * k, 0.004 + 2e-4 * k, 1e-3 * std::sin(1.0 * k)});
    lies.push_back({3e-4 * k, 0, 0.01 * k});
  }
  add_cord(scene, "falls", falls, false, rod);
  add_cord(scene, "lies", lies, true, rod);
  for (std::size_t v = 0; v < falls.size(); ++v) scene.velocities[v] = {0, -0.4, 0.05};
  set_setting(scene.settings, "ipc_distance", 1e-3);
  round_to_single(scene);
  return scene;
}

/// Returns the smallest height of the falling cord above the fixed cord, over pairs of edges that cross when seen from
/// above; infinity if none cross.
double lowest_above(const compare::Topology& topology, const State& x) {
  double least = std::numeric_limits<double>::infinity();
  const auto side = [&](Index a, Index b, Index c) {
    const auto &p = x[static_cast<std::size_t>(a)], &q = x[static_cast<std::size_t>(b)],
               &r = x[static_cast<std::size_t>(c)];
    return (q[2] - p[2]) * (r[0] - p[0]) - (q[0] - p[0]) * (r[2] - p[2]);
  };
  const auto height = [&](const compare::Edge& e, double share) {
    return x[static_cast<std::size_t>(e[0])][1] * (1 - share) + x[static_cast<std::size_t>(e[1])][1] * share;
  };
  for (const compare::Edge& e : topology.edges)
    for (const compare::Edge& f : topology.edges) {
      if (!(e[0] < 11 && f[0] >= 11)) continue;
      const double a = side(f[0], f[1], e[0]), b = side(f[0], f[1], e[1]), c = side(e[0], e[1], f[0]),
                   d = side(e[0], e[1], f[1]);
      if (a * b < 0 && c * d < 0) least = std::min(least, height(e, a / (a - b)) - height(f, c / (c - d)));
    }
  return least;
}

}  // namespace

// Sweeps round positions of at most 1 cm to single precision in each of five steps, by 2⁻²⁴ of 1 cm. IPC ends a step if
// nothing moves faster than 1e-7 lengths of the rod per second, 1e-12 m per step. A frame follows the ends of its
// segment of 1 mm, so errors of 5e-9 m at each end rotate the frame by at most 1e-5.
TEST_CASE("rods: IPC and converged sweeps end at the same minimiser", "[property]") {
  std::vector<Vec3> points;
  for (int k = 0; k <= 10; ++k) points.push_back({1e-3 * k, 3e-4 * std::sin(0.8 * k), 2e-4 * std::cos(0.5 * k)});
  compare::Scene scene;
  scene.name = "spun";
  add_cord(scene, "rod", points, false, {});
  scene.motions = {{.name = "clamp", .vertices = {0, 1}, .keyframes = {}}};
  scene.motions[0].axis = {1, 0, 0};
  scene.motions[0].angular_velocity = 20;
  scene.settings.contact_radius = 1e-4;
  scene.settings.time_step = 1e-3;
  scene.settings.iterations = 2000;
  set_setting(scene.settings, "ipc_tolerance", 1e-7);
  round_to_single(scene);
  const auto ipc = reference::start_ipc(scene, {}), vbd = reference::start_vbd(scene, {});
  for (int step = 0; step < 5; ++step) {
    CHECK(ipc->advance(1).back().status == compare::step_clean);
    vbd->advance(1);
  }
  const compare::Snapshot a = ipc->snapshot(), b = vbd->snapshot();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const compare::Vec3f &p = a.positions[v], &q = b.positions[v];
    CHECK(std::hypot(double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z) < 5e-9);
  }
  REQUIRE(a.orientations.size() == 10);
  for (std::size_t e = 0; e < a.orientations.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(double{a.orientations[e][k]} == Approx(double{b.orientations[e][k]}).margin(1e-5));
}

TEST_CASE("rods: IPC's accepted steps lower the energy, and a cord that falls on another stays above it",
          "[property]") {
  const compare::Scene scene = crossing_cords();
  const compare::Topology topology = build_topology(scene);
  reference::IpcSolver solver(scene, topology, {});
  solver.on_accepted = [&](double change, double noise) { CHECK((change < 0 || change <= noise)); };
  State x = reference::widened(compare::to_single(scene.mesh.positions)),
        v = reference::widened(compare::to_single(scene.velocities));
  std::int64_t contacts = 0;
  for (int number = 1; number <= 30; ++number) {
    solver.set_orientations(solver.orientations());
    const reference::IpcStep next = solver.step(x, v, number);
    REQUIRE(next.metrics.status == compare::step_clean);
    CHECK(next.metrics.smallest_distance > 0);
    contacts += next.metrics.edge_edge_contacts;
    x = next.position, v = next.velocity;
    CHECK(lowest_above(topology, x) > 0);
  }
  CHECK(contacts > 20);
}

TEST_CASE("rods: IPC goes on from any snapshot to the same bits", "[property]") {
  check_goes_on_from_any_snapshot(reference::start_ipc, crossing_cords());
}
