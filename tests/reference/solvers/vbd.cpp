// Compares Vertex Block Descent in double with the potential that Newton differentiates.
#include "reference/solvers/vbd_solver.hpp"

#include <algorithm>
#include <cmath>

#include "reference/simulation.hpp"
#include "reference/solvers/colouring.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::State, reference::operator+;

TEST_CASE(
    "reference VBD: a vertex's force is minus the gradient of the potential with friction of the same state; its block "
    "is positive definite",
    "[property]") {
  compare::Scene scene = two_sheets();
  round_to_single(scene);
  const compare::Topology topology = build_topology(scene);
  reference::Potential potential(scene, topology);
  const State start = reference::widened(compare::to_single(scene.mesh.positions));
  State target = start, x = start;
  for (std::size_t v = 0; v < x.size(); ++v) {
    target[v][1] -= 1e-3;
    const auto phase = static_cast<double>(v);
    const reference::Triple<double> moved{2e-4 * std::sin(7 * phase), -3e-4, 1e-4 * std::cos(5 * phase)};
    if (potential.mobility()[v] == reference::Mobility::free) x[v] = x[v] + moved;
  }
  potential.begin_step(start, target);
  const reference::Detected found = reference::detect(scene, topology, rigid_groups(scene), reference::rounded(start),
                                                      8e-3F);
  potential.set_contacts(found.sets, start);
  REQUIRE(potential.contacts().size() > 20);
  potential.lag_friction(x);
  const reference::PotentialDerivatives derivatives = potential.derivatives(x, reference::HessianProjection::none);
  reference::VertexSystems systems(potential);
  systems.read_contacts();
  const std::vector<compare::Index> colour(x.size(), 0);
  double largest = 0;
  for (const auto& g : derivatives.gradient) largest = std::max(largest, std::hypot(g[0], g[1], g[2]));
  REQUIRE(largest > 0);
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (potential.mobility()[v] != reference::Mobility::free) continue;
    const reference::VertexSystem system = systems.at(static_cast<compare::Index>(v), {x, x, colour});
    const auto& b = system.block;
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(std::abs(system.force[axis] + derivatives.gradient[v][axis]) <= 1e-9 * largest);
    CHECK(b[0] > 0);
    CHECK(b[0] * b[3] - b[1] * b[1] > 0);
    CHECK(b[0] * (b[3] * b[5] - b[4] * b[4]) - b[1] * (b[1] * b[5] - b[4] * b[2]) + b[2] * (b[1] * b[4] - b[3] * b[2]) >
          0);
  }
}

TEST_CASE("reference VBD lowers the residual from 1 to the noise of doubles, single-precision storage left out",
          "[property]") {
  compare::Scene scene = two_sheets();
  // Contacts that are stiff compared with the inertia slow convergence: with 100 N/m and h = 1/100 s, thousands of
  // iterations are not enough.
  for (compare::Body& body : scene.bodies) body.material.contact_stiffness = 10;
  scene.settings.time_step = 1.0 / 400;
  scene.settings.iterations = 250;
  scene.settings.detection_fraction = 0;
  scene.settings.detection_every = 5;
  const auto rows = reference::start_vbd(scene, {.iterations = true})->advance(1);
  REQUIRE(rows[0].iteration_rows.size() == 251);
  CHECK(rows[0].iteration_rows.front().residual > 0.5);
  CHECK(rows[0].iteration_rows.back().residual < 1e-9);
  CHECK(rows[0].residual < 1e-9);
  CHECK(std::count_if(rows[0].iteration_rows.begin(), rows[0].iteration_rows.end(),
                      [](const auto& row) { return row.detected == 1; }) >= 49);
}

TEST_CASE(
    "reference VBD ends a step after the first iteration that moves nothing farther than settled_move, cuts nothing "
    "and "
    "asks for no detection",
    "[property]") {
  std::int64_t cut = 0, detected = 0, shorter = 0;
  for (const std::int64_t every : {0, 3}) {
    INFO("detection_every " << every);
    constexpr std::size_t most = 16;
    compare::Scene scene = two_sheets();
    for (compare::Body& body : scene.bodies) body.material.contact_stiffness = 10;
    scene.settings.time_step = 1.0 / 400;
    scene.settings.detection_fraction = 1;
    scene.settings.guess_rounds = 1;
    scene.settings.detection_every = every;
    for (std::size_t v = 0; v < 8; ++v) scene.velocities[v].y = -4;  // too fast for bounds: they are cut
    const auto advanced = [&](std::size_t iterations, double settled_move) {
      scene.settings.iterations = static_cast<std::int64_t>(iterations);
      scene.settings.settled_move = settled_move;
      const auto simulation = reference::start_vbd(scene, {.iterations = true});
      compare::StepMetrics row = simulation->advance(1).at(0);
      return std::pair(std::move(row), simulation->snapshot().positions);
    };
    std::vector<std::vector<compare::Vec3f>> ends;
    for (std::size_t n = 1; n <= most; ++n) ends.push_back(advanced(n, 0).second);
    const std::vector<compare::IterationMetrics> rows = advanced(most, 0).first.iteration_rows;
    REQUIRE(rows.size() == most + 1);
    std::vector<double> moves{1};  // by iteration; that of the first one is not known
    for (std::size_t n = 1; n < most; ++n) {
      double largest = 0;
      for (std::size_t v = 0; v < ends[n].size(); ++v)
        for (float compare::Vec3f::*axis : {&compare::Vec3f::x, &compare::Vec3f::y, &compare::Vec3f::z})
          largest = std::max(largest, std::abs(double{ends[n][v].*axis} - ends[n - 1][v].*axis));
      moves.push_back(largest);
    }
    for (std::size_t n = 1; n < most; ++n)
      for (const double factor : {0.99, 1.01}) {  // positions are rounded, by far less than a percent of these moves
        std::size_t expected = 0;
        const auto settles = [&](std::size_t i) {
          return moves[i] <= factor * moves[n] && rows[i].vertices_cut == 0 && rows[i + 1].detected == 0;
        };
        while (expected + 1 < most && !settles(expected)) ++expected;
        const auto [row, end] = advanced(most, factor * moves[n]);
        CHECK(row.iterations == static_cast<std::int64_t>(expected) + 1);
        CHECK(end == ends[expected]);
        shorter += expected + 1 < most;
        for (std::size_t i = 1; i < expected; ++i) {
          if (moves[i] > factor * moves[n]) continue;
          cut += rows[i].vertices_cut > 0 && rows[i + 1].detected == 0;
          detected += rows[i].vertices_cut == 0 && rows[i + 1].detected != 0;
        }
      }
  }
  CHECK(shorter > 0);
  CHECK(cut > 0);
  CHECK(detected > 0);
}

/// Facing vertices of one contact that share a colour are updated at once. If their blocks had the squared contact
/// weight instead of the factor of method.md §7.4, each vertex would remove the whole overlap. The same number of
/// sweeps would then leave a residual twelve times as large (Fig. 17).
TEST_CASE(
    "reference VBD: where contact is stiff more sweeps come closer, also with colours that facing vertices of equal "
    "sheets share",
    "[property]") {
  compare::Scene scene;
  scene.name = "pressed";
  compare::Material material;
  material.contact_stiffness = 10;
  for (const double height : {0.0, 2.5e-3, 5e-3}) add_sheet(scene, 6, 0.05, height, false, material);
  for (std::size_t v = 0; v < scene.velocities.size(); ++v)
    scene.velocities[v] = {0, v < 36 ? 0.3 : v < 72 ? 0 : -0.3, 0};
  scene.settings.detection_fraction = 0;
  const auto residual = [&](const std::vector<compare::Index>& colour, std::int64_t iterations) {
    scene.settings.iterations = iterations;
    return reference::start_vbd(scene, {.iterations = true}, colour)->advance(1).at(0).iteration_rows.back().residual;
  };
  round_to_single(scene);
  const compare::Topology topology = build_topology(scene);
  const std::vector<compare::Index> turned = reference::colours_of(
      scene, reference::rest_state({&scene, &topology}).exact, compare::rigid_groups(scene));
  std::vector<compare::Index> shared;
  for (std::size_t v = 0; v < turned.size(); ++v) shared.push_back(turned[v % 36]);
  for (std::size_t v = 36; v < turned.size(); ++v) CHECK(turned[v] != turned[v - 36]);
  for (const auto& colour : {shared, turned}) {
    double before = 1;
    for (const std::int64_t sweeps : {5, 10, 20, 40, 80}) {
      const double after = residual(colour, sweeps);
      CAPTURE(sweeps, before, after);
      CHECK(after < before);
      before = after;
    }
  }
}

TEST_CASE("reference VBD: colours that do not fit the scene are refused", "[unit]") {
  compare::Scene scene = two_sheets();
  round_to_single(scene);
  const compare::Topology topology = build_topology(scene);
  CHECK_THROWS(reference::VbdSolver(scene, topology, {}, {0, 1, 2}));
  CHECK_THROWS(reference::VbdSolver(scene, topology, {}, std::vector<compare::Index>(scene.mesh.positions.size(), 0)));
}
