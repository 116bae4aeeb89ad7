#include "reference/ipc/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/global_control.h>

#include "compare/problem/error.hpp"
#include "reference/ipc/intersections.hpp"
#include "reference/ipc/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::State;

namespace {

Run run(const compare::Scene& scene, std::int64_t steps) { return run_of(reference::start_ipc, scene, steps); }

/// Advances a scene by steps and keeps every state in double.
struct Stepper {
  compare::Scene scene;
  compare::Topology topology;
  reference::IpcSolver solver;
  State x, v;
  std::int64_t number = 0;
  explicit Stepper(compare::Scene of)
      : scene(rounded(std::move(of))), topology(build_topology(scene)), solver(scene, topology, {}) {
    x = reference::widened(compare::to_single(scene.mesh.positions));
    v = reference::widened(compare::to_single(scene.velocities));
  }
  static compare::Scene rounded(compare::Scene scene) {
    round_to_single(scene);
    return scene;
  }
  compare::StepMetrics step() {
    reference::IpcStep next = solver.step(x, v, ++number);
    x = next.position, v = next.velocity;
    return next.metrics;
  }
  bool intersects() const {
    const compare::Exclusions groups = exclusions(scene);
    const std::vector<float> rest(topology.edges.size(), 1);
    return !reference::intersections({topology, groups, rest}, x).empty();
  }
};

compare::Material heavy() {
  compare::Material material;
  material.density = 200;
  material.lame_mu = material.lame_lambda = 1e4;
  return material;
}

}  // namespace

TEST_CASE("IPC: a cloth far from everything falls as -g h^2 n(n+1)/2", "[property]") {
  compare::Scene scene;
  scene.name = "fall";
  add_sheet(scene, 6, 0.05, 0, false);
  const Run result = run(scene, 10);
  REQUIRE(clean(result));
  const double h = 0.01, fallen = 9.81 * h * h * 10 * 11 / 2;
  for (const compare::Vec3f& x : result.end.positions) CHECK(double{x.y} == Approx(-fallen).epsilon(1e-6));
  for (const compare::StepMetrics& row : result.rows) {
    // The first iteration takes the step, the second finds nothing left to do.
    CHECK(row.iterations == 2);
    CHECK(row.continuous_detections >= 1);
    // Detections take place at the start and at the first iteration's trial state. The second iteration has a trial
    // state only if its direction is more than rounding error.
    CHECK(row.discrete_detections >= 2);
    CHECK(row.discrete_detections <= 3);
  }
}

/// With the rule `velocity`, a solve continues after the first iteration, because the rule averages over three
/// iterations. Rounding of positions hides what these iterations change.
TEST_CASE("IPC: a cloth that is not strained falls by either rule of stopping and either membrane", "[property]") {
  for (const auto model : {compare::MembraneModel::st_venant_kirchhoff, compare::MembraneModel::stable_neo_hookean})
    for (const auto rule : {reference::IpcStopping::displacement, reference::IpcStopping::velocity}) {
      compare::Scene scene;
      scene.name = "fall";
      compare::Material material;
      material.membrane = model;
      material.membrane_damping = 2e-6;
      add_sheet(scene, 20, 0.5, 0.3, false, material);
      set_setting(scene.settings, "ipc_stopping", static_cast<double>(rule));
      const Run result = run(scene, 6);
      REQUIRE(clean(result));
      for (const compare::StepMetrics& row : result.rows) CHECK(row.iterations <= 4);
    }
}

TEST_CASE("IPC: each accepted step lowers the energy, and no state intersects", "[property]") {
  Stepper stepper(drop_scene());
  int accepted = 0;
  stepper.solver.on_accepted = [&](double change, double noise) {
    CHECK((change < 0 || change <= noise));
    ++accepted;
  };
  std::int64_t contacts = 0;
  for (int step = 0; step < 20; ++step) {
    const compare::StepMetrics row = stepper.step();
    REQUIRE(row.status == compare::step_clean);
    REQUIRE_FALSE(stepper.intersects());
    CHECK(row.smallest_distance > 0);
    contacts += row.vertex_facet_contacts + row.edge_edge_contacts;
  }
  CHECK(accepted > 40);
  CHECK(contacts > 100);
}

TEST_CASE("IPC: both stopping rules end a step where they say, and counts of iterations add up to those of the step",
          "[property]") {
  for (const auto rule : {reference::IpcStopping::displacement, reference::IpcStopping::velocity}) {
    compare::Scene scene = drop_scene();
    set_setting(scene.settings, "ipc_stopping", static_cast<double>(rule));
    const Run result = run(scene, 12);
    REQUIRE(clean(result));
    for (const compare::StepMetrics& row : result.rows) {
      if (rule == reference::IpcStopping::displacement)
        CHECK(row.residual < get_setting(scene.settings, "ipc_tolerance"));
      REQUIRE(static_cast<std::int64_t>(row.iteration_rows.size()) == row.iterations);
      std::int64_t discrete = 0, continuous = 0, broad = 0;
      for (const compare::IterationMetrics& iteration : row.iteration_rows)
        discrete += iteration.discrete_detections, continuous += iteration.continuous_detections,
            broad += iteration.broad_phases;
      CHECK(discrete == row.discrete_detections - 1);  // the detection at the start of the step belongs to no iteration
      CHECK(broad == row.broad_phases - 1);
      CHECK(continuous == row.continuous_detections);
    }
  }
}

TEST_CASE("IPC: what lies on a plane rests where the barrier carries its weight", "[property]") {
  compare::Material material = heavy();
  material.friction = 0;
  compare::Scene scene = triangle_on_plane(1.5e-3, material);
  set_setting(scene.settings, "ipc_distance", 2e-3);
  set_setting(scene.settings, "ipc_stiffness", 1e10);
  set_setting(scene.settings, "ipc_tolerance", 1e-9);
  scene.settings.time_step = 0.05;
  const Run result = run(scene, 60);
  REQUIRE(clean(result));
  const double weight = material.density * 0.5 * 1e-4 / 3 * 9.81, support = 4e-6;
  const double y = double{result.end.positions[0].y};
  // Each vertex acts on the plane once; the triangle's edges are far from the plane's edges.
  CHECK(-1e10 * reference::barrier_slopes(y * y, support).slope[0] * 2 * y == Approx(weight).epsilon(1e-3));
}

TEST_CASE("IPC: friction brakes what slides with its coefficient times gravity, and then holds it", "[property]") {
  compare::Material material = heavy();
  material.friction = 0.4;
  compare::Scene scene = triangle_on_plane(0.8e-3, material);
  for (std::size_t v = 0; v < 3; ++v) scene.velocities[v] = {0.3, 0, 0};
  set_setting(scene.settings, "ipc_distance", 1e-3);
  set_setting(scene.settings, "ipc_tolerance", 1e-7);
  scene.settings.friction_velocity = 1e-4;
  set_setting(scene.settings, "newton_friction_solves", 20);
  scene.settings.time_step = 0.005;
  const Run result = run(scene, 40);
  REQUIRE(clean(result));
  const double way = 0.3 * 0.3 / (2 * 0.4 * 9.81);
  CHECK(double{result.end.positions[0].x} == Approx(way).epsilon(0.1));
  CHECK(std::abs(double{result.end.velocities[0].x}) < 1e-3);
}

// Gravity is inclined by 20 degrees to a level floor: g (sin θ − μ cos θ) along it. Implicit Euler adds half a step to
// the distance, 0.5 % of it after 200 steps. At first the sheet falls by a tenth of the barrier's distance until the
// barrier acts; nothing brakes it there.
TEST_CASE("IPC: a sheet slides down a slope by the law, however large the floor is", "[property]") {
  compare::Material material;
  material.density = 1;
  material.lame_mu = material.lame_lambda = 1000;
  material.friction = 0.2;
  const double angle = 20 * std::numbers::pi / 180;
  for (const double floor : {6.0, 60.0}) {
    compare::Scene scene;
    scene.name = "slope";
    add_sheet(scene, 5, 0.2, 1.1e-3 * std::sqrt(2.0) * floor, false, material);
    add_sheet(scene, 2, floor, 0, true, material);
    scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
    scene.settings.time_step = 0.005;
    const double begin = scene.mesh.positions[12].x;
    const Run result = run(scene, 200);
    REQUIRE(clean(result));
    const double law = 9.81 * (std::sin(angle) - 0.2 * std::cos(angle));
    INFO(floor << " m");
    CHECK(double{result.end.positions[12].x} - begin == Approx(law / 2).epsilon(0.03));
    CHECK(double{result.end.velocities[12].x} == Approx(law).epsilon(0.03));
  }
}

TEST_CASE("IPC: prescribed vertices reach their targets where nothing is in the way", "[unit]") {
  compare::Scene scene;
  scene.name = "carried";
  add_sheet(scene, 5, 0.04, 0, false);
  compare::PrescribedMotion motion;
  motion.vertices = {0, 1, 2, 3, 4};
  motion.velocity = {-0.2, 0, 0};
  scene.motions.push_back(motion);
  const Run result = run(scene, 5);
  REQUIRE(clean(result));
  for (const compare::StepMetrics& row : result.rows) CHECK(row.largest_lag == 0);
  CHECK(double{result.end.positions[0].x} == Approx(-0.02 - 0.05 * 0.2).epsilon(1e-6));
}

TEST_CASE("IPC: prescribed vertices that would go through free cloth push it along, without an intersection",
          "[property]") {
  compare::Scene scene;
  scene.name = "press";
  add_sheet(scene, 5, 0.04, 0, false);
  add_sheet(scene, 4, 0.03, 0.004, false);
  compare::PrescribedMotion motion;
  for (compare::Index v = 25; v < 41; ++v) motion.vertices.push_back(v);
  motion.velocity = {0, -1, 0};
  motion.end = 0.03;
  scene.motions.push_back(motion);
  scene.gravity = {};
  set_setting(scene.settings, "ipc_distance", 1e-3);
  Stepper stepper(scene);
  for (int step = 0; step < 4; ++step) {
    const compare::StepMetrics row = stepper.step();
    REQUIRE(row.status == compare::step_clean);
    REQUIRE_FALSE(stepper.intersects());
    // The augmented Lagrangian leaves a thousandth of the step's motion.
    CHECK(row.largest_lag <= 2e-3 * 0.01);
  }
  CHECK(stepper.x[12][1] < -0.02);
}

TEST_CASE("IPC: a start that intersects or touches is refused with the pairs", "[unit]") {
  compare::Scene crossing;
  crossing.name = "crossing";
  append_body(crossing, {.name = "a", .material = heavy()}, {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}, {}});
  append_body(crossing, {.name = "b", .material = heavy()},
              {{{0.2, -0.5, 0.2}, {0.2, 0.5, 0.2}, {0.3, 0.5, 0.4}}, {{0, 1, 2}}, {}});
  CHECK_THROWS_WITH(
      reference::start_ipc(crossing, {}),
      ContainsSubstring("edge of body 'b' (vertices 0, 1) and triangle 0 of body 'a' (vertices 0, 1, 2) intersect"));
  compare::Scene thick = triangle_on_plane(1e-3, heavy());
  set_setting(thick.settings, "ipc_thickness", 2e-3);
  CHECK_THROWS_WITH(
      reference::start_ipc(thick, {}),
      ContainsSubstring(
          "vertex 0 of body 'block' and triangle 0 of body 'plane' (vertices 0, 1, 2; 1 in the scene) have no gap") &&
          ContainsSubstring("beyond the thickness"));
  CHECK_NOTHROW(reference::start_ipc(triangle_on_plane(1e-3, heavy()), {}));
}

TEST_CASE("IPC: a time of impact of zero ends the step with the pair's name, never a loop", "[unit]") {
  compare::Material material = heavy();
  compare::Scene scene = triangle_on_plane(0x1p-60, material);
  set_setting(scene.settings, "ipc_distance", 1e-3);
  const auto simulation = reference::start_ipc(scene, {});
  const auto rows = simulation->advance(3);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].status == compare::step_not_converged);
  REQUIRE(rows[0].notes.size() == 2);
  CHECK_THAT(rows[0].notes[0], ContainsSubstring("held by vertex") && ContainsSubstring("triangle 0 of body 'plane'") &&
                                   ContainsSubstring("follows the gradient"));
  CHECK_THAT(rows[0].notes[1], ContainsSubstring("along the gradient"));
  CHECK(simulation->snapshot().step == 0);
}

TEST_CASE("IPC: one iteration a step is one iteration a step", "[unit]") {
  compare::Scene scene = drop_scene();
  set_setting(scene.settings, "ipc_iterations", 1);
  set_setting(scene.settings, "ipc_tolerance", 0);
  const Run result = run(scene, 8);
  REQUIRE(clean(result));
  for (const compare::StepMetrics& row : result.rows) {
    CHECK(row.iterations == 1);
    CHECK(row.notes.empty());
  }
  set_setting(scene.settings, "ipc_tolerance", 1e-6);
  CHECK_THAT(run(scene, 1).rows[0].notes.at(0), ContainsSubstring("limit of 1 iterations"));
}

/// At speeds between d̂/(2h) and twice that, the CFL-like rule shortens a fall although nothing is near.
TEST_CASE("IPC: in one iteration a step, CCD of all pairs leaves a free fall alone, and the CFL-like rule does not",
          "[property]") {
  compare::Scene scene;
  scene.name = "fall";
  add_sheet(scene, 4, 0.3, 0, false);
  for (compare::Vec3& v : scene.velocities) v = {0, -1, 0};
  scene.gravity = {};
  set_setting(scene.settings, "ipc_distance", 0.015);
  set_setting(scene.settings, "ipc_iterations", 1);
  set_setting(scene.settings, "ipc_tolerance", 0);
  set_setting(scene.settings, "ipc_ccd", "full");
  CHECK(double{run(scene, 2).end.positions[0].y} == Approx(-0.02).epsilon(1e-6));
  set_setting(scene.settings, "ipc_ccd", "partial");
  CHECK(double{run(scene, 2).end.positions[0].y} == Approx(-0.015).epsilon(1e-6));
}

/// The line search makes more discrete detections than iterations, because it halves steps. The guard tests each trial
/// state with a lower energy for intersections, with one broad phase.
TEST_CASE(
    "IPC: with CCD of all pairs no accepted step intersects, the guard never shortens one, and the minimiser is that "
    "of partial CCD",
    "[property]") {
  compare::Scene scene = drop_scene();
  set_setting(scene.settings, "ipc_tolerance", 1e-6);
  set_setting(scene.settings, "ipc_ccd", "full");
  Stepper full(scene);
  set_setting(scene.settings, "ipc_ccd", "partial");
  Stepper partial(scene);
  int accepted = 0;
  full.solver.on_accepted = [&](double, double) { ++accepted; };
  for (int step = 0; step < 15; ++step) {
    accepted = 0;
    const compare::StepMetrics row = full.step();
    REQUIRE(row.status == compare::step_clean);
    REQUIRE_FALSE(full.intersects());
    // The start of a step and each bound of a step length make one broad phase each. The guard makes all others, one
    // per tested state. If the guard tested only accepted states, it rejected none.
    const std::int64_t bounds = row.continuous_detections / 2, guards = row.broad_phases - 1 - bounds;
    CHECK(guards == accepted);
    REQUIRE(partial.step().status == compare::step_clean);
    for (std::size_t v = 0; v < full.x.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) CHECK(full.x[v][axis] == Approx(partial.x[v][axis]).margin(1e-6));
    partial.x = full.x, partial.v = full.v;
  }
}

TEST_CASE("IPC: threads change no bit, and a run does not depend on those before", "[property]") {
  const Run one = [] {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    return run(drop_scene(), 8);
  }();
  const Run two = run(drop_scene(), 8);
  CHECK(one.end.positions == two.end.positions);
  CHECK(one.end.velocities == two.end.velocities);
}

TEST_CASE("IPC goes on from any snapshot to the same bits in double, whatever pattern the matrix had before",
          "[property]") {
  check_goes_on_from_any_snapshot(reference::start_ipc, drop_scene());
}

TEST_CASE("IPC: thickness is kept", "[property]") {
  compare::Scene scene = drop_scene();
  set_setting(scene.settings, "ipc_distance", 1e-3);
  set_setting(scene.settings, "ipc_thickness", 1e-3);
  const Run result = run(scene, 12);
  REQUIRE(clean(result));
  double smallest = 1;
  for (const compare::StepMetrics& row : result.rows) smallest = std::min(smallest, row.smallest_distance);
  CHECK(smallest > 1e-3);
  CHECK(smallest < 2e-3);
}
