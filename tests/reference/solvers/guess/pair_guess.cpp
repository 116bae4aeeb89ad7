// The guess by certificate of pairs, and what the truth says of guesses that are none.
#include "reference/solvers/guess/pair_guess.hpp"

#include <algorithm>
#include <random>

#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using compare::Index;
using compare::Vec3f;

namespace {

/// A scene at its start, and where inertia leads it.
struct Guessed {
  compare::Scene scene;
  compare::Topology topology;
  compare::Exclusions exclusions;

  explicit Guessed(compare::Scene made) : scene(std::move(made)) {
    compare::round_to_single(scene);
    topology = compare::build_topology(scene);
    exclusions = compare::exclusions(scene);
  }

  /// Every free vertex moves by its velocity times h.
  compare::PairGuessIn question() const {
    compare::PairGuessIn in;
    in.topology = &topology;
    in.exclusions = exclusions;
    in.previous = compare::to_single(scene.mesh.positions);
    in.bound_relaxation = 0.45F;
    in.contact_radius = static_cast<float>(scene.settings.contact_radius);
    in.largest_reach = reference::largest_reach(scene.settings);
    const auto h = static_cast<float>(scene.settings.time_step);
    for (std::size_t v = 0; v < in.previous.size(); ++v) {
      const Vec3f& x = in.previous[v];
      const compare::Vec3& u = scene.velocities[v];
      const bool moves = exclusions.groups[v] != 0;
      const auto moved = [&](float a, double b) { return moves ? a + h * static_cast<float>(b) : a; };
      in.target.push_back({moved(x.x, u.x), moved(x.y, u.y), moved(x.z, u.z)});
    }
    const compare::DetectIn detect{&topology, exclusions, in.previous,
                                   static_cast<float>(scene.settings.contact_radius), in.largest_reach};
    const compare::DetectVertexFacetOut facets = reference::detect_vertex_facet(detect).exact;
    const compare::DetectEdgeEdgeOut edges = reference::detect_edge_edge(detect).exact;
    in.bound =
        reference::bound({&topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, 0.45F}).exact.bound;
    return in;
  }
};

/// `layers` free sheets of 5 × 5 vertices, 2 mm apart, all with one velocity, and a fixed one `below` them [m].
compare::Scene heap(int layers, double below, const compare::Vec3& velocity) {
  compare::Scene scene;
  scene.name = "heap";
  for (int k = 0; k < layers; ++k) tests::add_sheet(scene, 5, 0.04, 0.002 * k, false);
  std::fill(scene.velocities.begin(), scene.velocities.end(), velocity);
  tests::add_sheet(scene, 5, 0.06, -below, true);
  return scene;
}

/// A sheet that is thrown at a fixed one, each vertex a little differently.
compare::Scene thrown(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  compare::Scene scene;
  scene.name = "thrown";
  tests::add_sheet(scene, 5, 0.04, between(0.001, 0.015), false);
  const double speed = between(0.2, 4);
  for (std::size_t v = 0; v < 25; ++v) {
    scene.velocities[v] = {between(-0.3, 0.3), -speed * between(0.7, 1), between(-0.3, 0.3)};
    scene.mesh.positions[v].y += between(0, 0.004);
  }
  tests::add_sheet(scene, 4, 0.08, 0, true);
  return scene;
}

}  // namespace

TEST_CASE("a heap that moves as one keeps its whole displacement in one guess, whatever its bounds", "[property]") {
  for (const compare::Vec3& velocity : {compare::Vec3{0, -1.5, 0}, compare::Vec3{0.8, 0.9, -0.7}}) {
    const Guessed heaped(heap(4, 0.1, velocity));
    const compare::PairGuessIn in = heaped.question();
    REQUIRE(reference::leaves_ball(in, in.target[12], 12));
    const compare::PairGuessOut out = reference::pair_guess(in);
    CHECK(out.position == in.target);
    const compare::PairGuessTruth truth = reference::pair_guess_truth(in, out);
    CHECK(truth.unsafe.empty());
    CHECK(truth.pairs > 100);
  }
}

TEST_CASE("a sheet thrown at a wall never crosses it, at any speed", "[property]") {
  int cut = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const Guessed wall(thrown(seed));
    const compare::PairGuessIn in = wall.question();
    const compare::PairGuessOut out = reference::pair_guess(in);
    const compare::PairGuessTruth truth = reference::pair_guess_truth(in, out);
    CHECK(truth.unsafe.empty());
    CHECK(truth.held_back.empty());
    for (std::size_t v = 0; v < 25; ++v) {
      CHECK(out.position[v].y > 0);
      cut += !(out.position[v] == in.target[v]);
    }
    CHECK(reference::pair_guess(in).position == out.position);
  }
  CHECK(cut > 100);
}

TEST_CASE("a heap that lands keeps its order, and another beside it is not held back", "[property]") {
  compare::Scene scene = heap(5, 0.003, {0, -1.6, 0});
  const std::size_t first = scene.mesh.positions.size();
  tests::add_sheet(scene, 5, 0.04, 0.05, false);
  for (std::size_t v = first; v < scene.mesh.positions.size(); ++v) {
    scene.velocities[v] = {0, -1.6, 0};
    scene.mesh.positions[v].x += 0.5;
  }
  const Guessed landing(scene);
  const compare::PairGuessIn in = landing.question();
  const compare::PairGuessOut out = reference::pair_guess(in);
  for (std::size_t v = 0; v < 25; ++v)
    for (std::size_t k = 0; k + 1 < 5; ++k) CHECK(out.position[25 * k + v].y < out.position[25 * (k + 1) + v].y);
  for (std::size_t v = first; v < out.position.size(); ++v) CHECK(out.position[v] == in.target[v]);
  const compare::PairGuessTruth truth = reference::pair_guess_truth(in, out);
  CHECK(truth.unsafe.empty());
  CHECK(truth.held_back.empty());
}

TEST_CASE("the truth finds a way through a wall, and a piece that is held back", "[unit]") {
  const Guessed falling(heap(2, 0.003, {0, -1.6, 0})), flying(heap(2, 0.1, {0, -1.6, 0}));
  const compare::PairGuessIn through = falling.question();
  CHECK_FALSE(reference::pair_guess_truth(through, {through.target}).unsafe.empty());
  CHECK(reference::pair_guess_truth(through, {through.previous}).unsafe.empty());
  const compare::PairGuessIn free = flying.question();
  CHECK(reference::pair_guess_truth(free, {free.previous}).held_back.size() == 50);
  CHECK(reference::pair_guess_truth(free, {free.target}).held_back.empty());
}
