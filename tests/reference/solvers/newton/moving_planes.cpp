// Tests steps that are cut pair by pair: nothing intersects during a step, and sheets that move together are not cut.
#include "reference/solvers/newton/moving_planes.hpp"

#include <cmath>
#include <random>

#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "reference/simulation.hpp"
#include "reference/solvers/detection.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;
using namespace ogc::reference;

namespace {

constexpr float relaxation = 0.45f;

/// The planes of a scene's first state, and the data from which they are made.
struct Held {
  compare::Scene scene;
  compare::Topology topology;
  compare::Exclusions exclusions;
  std::vector<compare::Vec3f> previous;
  MovingPlanes planes;

  Held(compare::Scene from, float query_radius) : scene(std::move(from)) {
    round_to_single(scene);
    topology = compare::build_topology(scene);
    exclusions = compare::exclusions(scene);
    previous = compare::to_single(scene.mesh.positions);
    planes = MovingPlanes(detect_pairs(topology, exclusions, previous, query_radius, double{relaxation}), previous,
                          mobility_of(scene), double{query_radius}, double{relaxation});
  }

  std::size_t intersections(const State& x) const {
    return compare::audit(topology, compare::to_double(rounded(x)), exclusions).count;
  }
};

State shifted(const State& x, double share, const State& step) {
  State to = x;
  for (std::size_t v = 0; v < x.size(); ++v) to[v] = x[v] + share * step[v];
  return to;
}

/// Returns two free sheets `gap` apart. The upper sheet is sheared, so none of its vertices lies straight above a
/// vertex of the lower sheet.
compare::Scene facing(double gap) {
  compare::Scene scene;
  scene.name = "facing";
  add_sheet(scene, 7, 0.06, 0, false);
  add_sheet(scene, 6, 0.05, gap, false);
  for (std::size_t v = 49; v < 85; ++v) scene.mesh.positions[v].x += 0.3 * scene.mesh.positions[v].z;
  return scene;
}

State uniform(const Held& held, const Triple<double>& lower, const Triple<double>& upper) {
  State step(held.previous.size(), lower);
  for (std::size_t v = 49; v < step.size(); ++v) step[v] = upper;
  return step;
}

}  // namespace

TEST_CASE("pair by pair: whatever a step wants, nothing meets on its way, and what is stored keeps its side",
          "[property]") {
  std::mt19937 engine(25);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::size_t meetings_uncut = 0, cut = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Held held(trial % 3 == 0 ? drop_scene() : facing(std::pow(10.0, -2.3 - 3 * std::abs(draw(engine)))), 8e-3f);
    const State x = widened(held.previous);
    State wanted(x.size());
    const double size = std::pow(10.0, -4 + 2.5 * std::abs(draw(engine)));
    for (std::size_t v = 0; v < x.size(); ++v)
      if (mobility_of(held.scene)[v] == Mobility::free)
        wanted[v] = size * Triple<double>{draw(engine), draw(engine), draw(engine)};
    const State step = held.planes.truncated(x, wanted);
    REQUIRE(held.planes.share_inside(x, State(x.size())) == 1);
    CHECK(held.planes.share_inside(x, step) == 1);
    CHECK(held.planes.kept_by(rounded(shifted(x, 1, step))));
    for (const double share : {0.1, 0.35, 0.7, 1.0}) CHECK(held.intersections(shifted(x, share, step)) == 0);
    meetings_uncut += held.intersections(shifted(x, 1, wanted));
    cut += step != wanted;
    const State next = shifted(x, 1, step);
    CHECK(held.intersections(shifted(next, 1, held.planes.truncated(next, wanted))) == 0);
  }
  CHECK(meetings_uncut > 100);
  CHECK(cut > 20);
}

TEST_CASE("pair by pair: sheets 10 µm apart that travel together are not cut, in any direction", "[unit]") {
  const Held held(facing(1e-5), 8e-3f);
  const State x = widened(held.previous);
  for (const Triple<double>& way : {Triple<double>{0, 3e-3, 0}, {0, -3e-3, 0}, {3e-3, 0, 0}, {1e-3, 2e-3, -2e-3}}) {
    const State step = uniform(held, way, way);
    CHECK(held.planes.truncated(x, step) == step);
  }
}

TEST_CASE("pair by pair: sheets leave one another as far as the balls let them, and come no nearer than a tenth",
          "[unit]") {
  const Held held(facing(1e-4), 8e-3f);
  const State x = widened(held.previous);
  const State apart = uniform(held, {0, -3e-3, 0}, {0, 3e-3, 0});
  CHECK(held.planes.truncated(x, apart) == apart);
  const State step = held.planes.truncated(x, uniform(held, {0, 2e-3, 0}, {0, -1e-3, 0})), end = shifted(x, 1, step);
  const auto distances = compare::smallest_distances(held.topology, compare::to_double(rounded(end)), held.exclusions);
  const double least = std::min(distances.vertex_triangle, distances.edge_edge);
  // At least 1 − 2γ_p of the gap is left. Sweeps may leave more, because they do not project onto the regions.
  CHECK(least > 0.0999e-4);
}

TEST_CASE("pair by pair: what is nearer than rounding stays where it is", "[unit]") {
  const Held held(facing(1e-9), 8e-3f);
  State x = widened(held.previous);
  for (Triple<double>& p : x) p[0] += 1e-10;
  held.planes.enter(x);
  const State step = held.planes.truncated(x, uniform(held, {0, 1e-3, 0}, {0, 1e-3, 0}));
  // Only vertices that face the other sheet, away from its rim, are checked.
  std::size_t facing_others = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (std::abs(x[v][0]) > 0.016 || std::abs(x[v][2]) > 0.016) continue;
    ++facing_others;
    CHECK(x[v] == widened(held.previous)[v]);
    CHECK(step[v] == Triple<double>{});
  }
  CHECK(facing_others > 16);
}

TEST_CASE("pair by pair: what is stored beyond a plane or a ball is found", "[unit]") {
  const Held held(facing(1e-4), 8e-3f);
  std::vector<compare::Vec3f> stored = held.previous;
  CHECK(held.planes.kept_by(stored));
  for (std::size_t v = 49; v < 85; ++v) stored[v].y -= 1.1e-4f;
  CHECK_FALSE(held.planes.kept_by(stored));
  stored = held.previous;
  stored[48].y -= 4e-3f;
  CHECK_FALSE(held.planes.kept_by(stored));
}

TEST_CASE("Newton pair by pair: sheets that are close and travel far in one step converge in a few iterations",
          "[property]") {
  // Two sheets 0.1 mm apart travel 2 cm together and slide 1 cm along each other. Balls of γ_p · 0.1 mm would need 400
  // iterations.
  compare::Scene scene = facing(1e-4);
  scene.gravity = {};
  for (std::size_t v = 0; v < 85; ++v) scene.velocities[v] = {v < 49 ? 0.5 : -0.5, 2, 0};
  scene.settings.detection_fraction = 0;
  set_setting(scene.settings, "newton_tolerance", 1e-6);
  set_setting(scene.settings, "newton_iterations", 60);
  set_setting(scene.settings, "newton_truncation", "pair");
  const Run pairs = run_of(start_newton, scene, 1);
  REQUIRE(clean(pairs));
  CHECK(pairs.rows[0].residual <= 1e-6);
  set_setting(scene.settings, "newton_truncation", "vertex");
  const Run balls = run_of(start_newton, scene, 1);
  CHECK(balls.rows[0].status == compare::step_not_converged);
  CHECK(balls.rows[0].residual > 1e-3);
}
