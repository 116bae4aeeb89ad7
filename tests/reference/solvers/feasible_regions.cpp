// Tests the feasible regions of solvers in double precision: proposals and steps stay inside them, with and without
// planes.
#include "reference/solvers/feasible_regions.hpp"

#include <cmath>
#include <random>

#include "compare/oracle/audit.hpp"
#include "reference/geometry/plane.hpp"
#include "reference/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/runs.hpp"

using namespace ogc;
using namespace ogc::tests;
using namespace ogc::reference;

namespace {

/// Returns for each vertex v a ball about a random point in [-1, 1]³, and v mod 5 planes.
Detected random_regions(std::size_t count) {
  std::mt19937 engine(27);
  std::uniform_real_distribution<float> draw(-1, 1);
  Detected detected;
  detected.planes.offsets.push_back(0);
  for (std::size_t v = 0; v < count; ++v) {
    const float size = std::pow(10.0f, -6 + 5 * std::abs(draw(engine)));
    detected.previous.push_back({draw(engine), draw(engine), draw(engine)});
    detected.bound.push_back(size);
    const compare::Vec3f& p = detected.previous.back();
    for (std::size_t k = 0; k < v % 5; ++k) {
      const compare::Vec3f n{draw(engine), draw(engine), draw(engine)};
      const double height = double{n.x} * p.x + double{n.y} * p.y + double{n.z} * p.z;
      detected.planes.items.push_back({{}, n, height + 0.3 * double{size} * std::abs(draw(engine))});
    }
    detected.planes.offsets.push_back(static_cast<compare::Index>(detected.planes.items.size()));
  }
  return detected;
}

StartSolver start_reference_vbd = [](const compare::Scene& scene, const compare::SimulationOptions& options) {
  return start_vbd(scene, options, {});
};

/// Runs the scene, checks the guarantee at each state, and returns the number of half-spaces over all states.
std::size_t half_spaces_of_held_run(StartSolver start, const compare::Scene& scene, int steps) {
  const compare::Topology topology = compare::build_topology(scene);
  const compare::Exclusions exclusions = compare::exclusions(scene);
  const std::vector<std::uint8_t> is_fixed = compare::fixed_flags(exclusions.groups);
  const auto simulation = start(scene, {});
  std::size_t half_spaces = 0;
  for (int step = 1; step <= steps; ++step) {
    const compare::StepMetrics row = simulation->advance(1).at(0);
    INFO("step " << step);
    REQUIRE(row.status == compare::step_clean);
    const compare::Snapshot state = simulation->snapshot();
    half_spaces += state.planes.items.size();
    const compare::PlaneIn in{&topology, exclusions,         state.previous,
                              is_fixed,  state.query_radius, static_cast<float>(scene.settings.bounds_relaxation)};
    CHECK(plane_guarantee(in, {state.planes, state.bounds}).kept());
    CHECK(broken_planes(state.planes, state.positions) == 0);
    CHECK(compare::audit(topology, compare::to_double(state.positions), exclusions).count == 0);
  }
  return half_spaces;
}

}  // namespace

TEST_CASE("what lies in a region keeps its half-spaces after rounding, too", "[property]") {
  const Detected detected = random_regions(3000);
  const FeasibleRegions regions(detected, GENERATE(compare::Bounds::planes, compare::Bounds::dat));
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1, 1);
  const State centre = widened(detected.previous);
  State x, scaled, path;
  std::size_t cut = 0;
  for (std::size_t v = 0; v < centre.size(); ++v) {
    const Triple<double> step = 2 * double{detected.bound[v]} *
                                Triple<double>{draw(engine), draw(engine), draw(engine)};
    const FeasibleRegions::Inside inside = regions.inside(v, centre[v], centre[v] + step);
    cut += inside.cut;
    x.push_back(inside.x);
    path.push_back(regions.inside_on_path(v, centre[v], centre[v] + step).x);
    scaled.push_back(centre[v] + regions.share_inside(v, centre[v], step) * step);
  }
  CHECK(cut > 1000);
  for (const State& state : {x, scaled, path}) CHECK(broken_planes(detected.planes, rounded(state)) == 0);
}

TEST_CASE("a proposal beyond one half-space slides along it, in the metric that it is given", "[unit]") {
  Detected detected;
  detected.previous = {{0, 0, 0}};
  detected.bound = {10};
  detected.planes = {{0, 1}, {{{}, {0, 1, 0}, 1}}};
  const FeasibleRegions regions(detected, compare::Bounds::planes);
  const auto slid = regions.inside(0, {0, 0, 0}, {2, 3, 0});
  CHECK(slid.cut);
  CHECK(slid.x[0] == 2);
  CHECK(slid.x[1] == Approx(1).epsilon(1e-5));
  const auto sheared = regions.inside(0, {0, 0, 0}, {2, 3, 0}, [](const Triple<double>& n) {
    return Triple<double>{n[1], n[1], 0};
  });
  CHECK(sheared.x[0] == Approx(0).margin(1e-5));
  CHECK(regions.inside_on_path(0, {0, 0, 0}, {2, 3, 0}).x[0] == Approx(2.0 / 3).epsilon(1e-5));
  CHECK_FALSE(regions.inside(0, {0, 0, 0}, {2, -3, 0}).cut);
  CHECK_FALSE(FeasibleRegions(detected, compare::Bounds::off).inside(0, {0, 0, 0}, {2000, 3000, 0}).cut);
}

TEST_CASE("with bounds=dat a proposal is scaled from X_prev, wherever the vertex is", "[unit]") {
  Detected detected;
  detected.previous = {{0, 0, 0}};
  detected.bound = {10};
  detected.planes = {{0, 1}, {{{}, {0, 1, 0}, 1}}};
  const FeasibleRegions regions(detected, compare::Bounds::dat);
  for (const auto& kept :
       {regions.inside(0, {1, 0.5, 0}, {2, 3, 0}), regions.inside_on_path(0, {1, 0.5, 0}, {2, 3, 0})}) {
    CHECK(kept.cut);
    CHECK(kept.x[0] == Approx(2.0 / 3).epsilon(1e-5));
    CHECK(kept.x[1] == Approx(1).epsilon(1e-5));
  }
  CHECK_FALSE(regions.inside(0, {1, 0.5, 0}, {2, -3, 0}).cut);
}

TEST_CASE("reference VBD and Newton keep the guarantee with planes as with balls", "[property]") {
  compare::Scene scene = drop_scene();
  scene.settings.iterations = 10;
  compare::round_to_single(scene);
  for (const StartSolver start : {start_reference_vbd, StartSolver{start_newton}}) {
    scene.settings.bounds = compare::Bounds::ball;
    CHECK(half_spaces_of_held_run(start, scene, 12) == 0);
    scene.settings.bounds = compare::Bounds::planes;
    CHECK(half_spaces_of_held_run(start, scene, 12) > 1000);
  }
}

TEST_CASE("reference VBD keeps the guarantee with bounds=dat, Newton refuses it by name", "[property]") {
  compare::Scene scene = drop_scene();
  scene.settings.iterations = 10;
  scene.settings.bounds = compare::Bounds::dat;
  compare::round_to_single(scene);
  CHECK(half_spaces_of_held_run(start_reference_vbd, scene, 12) > 1000);
  CHECK_THROWS_WITH(start_newton(scene, {}), ContainsSubstring("'bounds' can't be 'dat'"));
}

TEST_CASE("without bounds a step of either solver cuts nothing", "[unit]") {
  compare::Scene scene = drop_scene();
  scene.settings.iterations = 2;
  scene.settings.bounds = compare::Bounds::off;
  for (const StartSolver start : {start_reference_vbd, StartSolver{start_newton}}) {
    const Run run = run_of(start, scene, 1);
    CHECK(clean(run));
    CHECK(run.rows[0].vertices_cut == 0);
  }
}
