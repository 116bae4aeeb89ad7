// Steps that guess by certificate of pairs: what the reference says of their guesses, and that nothing else changes.
#include "fast/kernels/pair_guess.hpp"

#include <algorithm>
#include <random>

#include "compare/problem/validate.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/probes/probe_step.hpp"
#include "reference/solvers/guess/pair_guess.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Two free sheets over a fixed one, thrown at it askew.
compare::Scene thrown(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  compare::Scene scene = empty_scene();
  scene.settings.guess = compare::Guess::pairs;
  scene.settings.iterations = 3;
  const double speed = between(0.3, 4), height = between(0.002, 0.02);
  add_sheet(scene, 7, 0.06, height, false);
  add_sheet(scene, 7, 0.06, height + 0.003, false);
  for (std::size_t v = 0; v < 98; ++v) {
    scene.mesh.positions[v].y += 0.05 * scene.mesh.positions[v].x;
    scene.velocities[v] = {between(-0.2, 0.2), -speed * between(0.8, 1), between(-0.2, 0.2)};
  }
  add_sheet(scene, 6, 0.08, -0.002, true);
  compare::round_to_single(scene);
  return scene;
}

compare::PairGuessIn question_of(const compare::StepOut& out, const compare::Scene& scene,
                                 const compare::Topology& topology, const compare::Exclusions& exclusions) {
  compare::PairGuessIn in;
  in.topology = &topology;
  in.exclusions = exclusions;
  in.previous = out.events.at(0).position;
  in.target = out.target;
  in.bound = out.events.at(0).bound;
  in.bound_relaxation = static_cast<float>(scene.settings.bound_relaxation);
  in.contact_radius = static_cast<float>(scene.settings.contact_radius);
  in.largest_reach = reference::largest_reach(scene.settings);
  return in;
}

}  // namespace

TEST_CASE("a guess by pairs is safe, holds no free piece back, and a detection follows it", "[property]") {
  int by_pairs = 0, cut = 0;
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const compare::Scene scene = thrown(seed);
    const compare::Topology topology = compare::build_topology(scene);
    const compare::Exclusions exclusions = compare::exclusions(scene);
    const compare::StepOut out = probe_step<CpuBackend>({&scene, &topology});
    const compare::PairGuessIn in = question_of(out, scene, topology, exclusions);
    const std::vector<compare::Vec3f>& x = out.events.at(1).position;
    if (out.events.at(2).kind != compare::StepEventKind::detection) continue;
    ++by_pairs;
    cut += out.events[1].cut;
    const compare::PairGuessTruth truth = reference::pair_guess_truth(in, {x});
    CHECK(truth.unsafe.empty());
    CHECK(truth.held_back.empty());
    CHECK(out.events[2].position == x);
    CHECK(out.events.at(3).kind == compare::StepEventKind::sweep);
    for (std::size_t v = 0; v < 98; ++v) CHECK(x[v].y > -0.002F);
  }
  CHECK(by_pairs > 20);
  CHECK(cut > 100);
}

TEST_CASE("a guess by pairs has the same bits in each run, whatever room its lists begin with", "[property]") {
  const compare::Scene scene = thrown(7);
  const auto end = [&](int capacity) {
    ResidentSimulation<CpuBackend> simulation(CpuBackend{}, scene, {}, "", capacity);
    const std::vector<compare::StepMetrics> rows = simulation.advance(6);
    REQUIRE(rows.size() == 6);
    CHECK(rows.back().status % compare::step_list_grew == compare::step_clean);
    return simulation.snapshot().positions;
  };
  const std::vector<compare::Vec3f> expected = end(0);
  CHECK(end(0) == expected);
  CHECK(end(1) == expected);
}

TEST_CASE("a heap that falls far from everything loses nothing of its fall to one guess", "[property]") {
  compare::Scene scene = empty_scene();
  scene.settings.guess = compare::Guess::pairs;
  for (int k = 0; k < 4; ++k) add_sheet(scene, 7, 0.06, 0.006 * k, false);
  std::fill(scene.velocities.begin(), scene.velocities.end(), compare::Vec3{0, -1.2, 0});
  add_sheet(scene, 6, 0.08, -1, true);
  const std::vector<compare::StepMetrics> rows = start_cpu(scene, {})->advance(3);
  REQUIRE(rows.size() == 3);
  for (const compare::StepMetrics& row : rows) {
    CHECK(row.guess_rounds == 1);
    CHECK(row.momentum_lost_guess == 0);
    CHECK(row.discrete_detections == 2);
  }
}

TEST_CASE("a guess by pairs is refused where bounds are no balls", "[unit]") {
  compare::Scene scene = thrown(1);
  const std::size_t before = compare::validate(scene).size();  // names that no scene file may have
  scene.settings.bounds = compare::Bounds::planes;
  const std::vector<compare::Problem> problems = compare::validate(scene);
  REQUIRE(problems.size() == before + 1);
  CHECK(compare::describe(problems).find("'guess'") != std::string::npos);
}
