// Tests the order of Algorithm 3 for given numbers of cut vertices, and the query radius of a step.
#include "reference/solvers/step.hpp"

#include <algorithm>
#include <cmath>

#include "reference/solvers/step_order.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using compare::Index;
using compare::StepEventKind;

namespace {

constexpr StepEventKind find = StepEventKind::detection, guess = StepEventKind::guess, sweep = StepEventKind::sweep;

/// Returns the events of a step. `cuts`: numbers of vertices that the rounds and iterations cut, in order; later ones
/// cut none.
std::vector<StepEventKind> order(const compare::Settings& settings, Index moving, std::vector<Index> cuts) {
  reference::StepOrder order(settings, moving);
  std::vector<StepEventKind> events;
  std::reverse(cuts.begin(), cuts.end());
  for (auto kind = order.next(); kind; kind = order.next()) {
    events.push_back(*kind);
    Index cut = 0;
    if (*kind != find && !cuts.empty()) cut = cuts.back(), cuts.pop_back();
    order.took_place(cut);
  }
  return events;
}

compare::Settings settings(std::int64_t iterations, double fraction = 0.01) {
  compare::Settings settings;
  settings.iterations = iterations;
  settings.detection_fraction = fraction;
  return settings;
}

/// Returns n × n vertices on a grid of 1 cm in the plane y = height.
compare::Mesh sheet(Index n, double height) {
  compare::Mesh mesh;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) mesh.positions.push_back({0.01 * i, height, 0.01 * j});
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return mesh;
}

compare::Scene scene_of(const compare::Mesh& mesh, const compare::Vec3& velocity) {
  compare::Scene scene;
  scene.name = "test";
  compare::append_body(scene, {.name = "sheet", .material = {}}, mesh);
  std::fill(scene.velocities.begin(), scene.velocities.end(), velocity);
  scene.settings.contact_radius = 0.004;
  scene.settings.iterations = 4;
  return scene;
}

/// Returns the truth about an answer whose vertices stay at their start.
compare::StepTruth truth_of(compare::Scene& scene) {
  compare::round_to_single(scene);
  const compare::Topology topology = compare::build_topology(scene);
  compare::StepOut answer;
  answer.target = answer.position = compare::to_single(scene.mesh.positions);
  answer.velocity.resize(answer.position.size());
  for (const compare::PrescribedMotion& motion : scene.motions)
    for (const Index v : motion.vertices)
      answer.target[static_cast<std::size_t>(v)] =
          reference::step({&scene, &topology}, answer).prescribed_target[static_cast<std::size_t>(v)];
  return reference::step({&scene, &topology}, answer);
}

}  // namespace

TEST_CASE("without a cut a step detects once, guesses once and sweeps", "[unit]") {
  CHECK(order(settings(3), 100, {}) == std::vector{find, guess, sweep, sweep, sweep});
}

TEST_CASE("the guess loop goes on while enough vertices are cut and rounds are left", "[unit]") {
  compare::Settings few = settings(1);
  CHECK(order(few, 100, {1, 2, 2}) == std::vector{find, guess, find, guess, find, guess, sweep});
  CHECK(order(few, 100, {1, 1}) == std::vector{find, guess, find, guess, sweep});
  CHECK(order(few, 10, {1, 1, 0}) == std::vector{find, guess, find, guess, find, guess, sweep});
  few.guess_rounds = 2;
  CHECK(order(few, 100, {1, 2, 0}) == std::vector{find, guess, find, guess, sweep});
  few.guess_rounds = 1;
  CHECK(order(few, 100, {100}) == std::vector{find, guess, sweep});
}

TEST_CASE("a detection follows an iteration that cut enough, but never the last one", "[unit]") {
  CHECK(order(settings(3), 100, {0, 1, 0, 1}) == std::vector{find, guess, sweep, find, sweep, sweep});
  CHECK(order(settings(2), 100, {0, 50, 50}) == std::vector{find, guess, sweep, find, sweep});
}

TEST_CASE("the threshold is the fraction of K rounded up, at least one vertex", "[unit]") {
  const auto again = [](double fraction, Index moving, Index cut) {
    return order(settings(2, fraction), moving, {0, cut}).size() == 5;
  };
  CHECK(again(0.25, 10, 3));
  CHECK_FALSE(again(0.25, 10, 2));
  CHECK(again(0.25, 8, 2));
  CHECK(again(0, 8, 1));
  CHECK_FALSE(again(0, 8, 0));
  CHECK(again(0.01, 0, 1));
  // 0.1f is slightly more than a tenth.
  CHECK_FALSE(again(0.1f, 10, 1));
}

TEST_CASE("detections by count are counted from the last detection", "[unit]") {
  compare::Settings by_count = settings(6);
  by_count.detection_every = 2;
  CHECK(order(by_count, 100, {}) == std::vector{find, guess, sweep, sweep, find, sweep, sweep, find, sweep, sweep});
  CHECK(order(by_count, 100, {0, 1}) ==
        std::vector{find, guess, sweep, find, sweep, sweep, find, sweep, sweep, find, sweep});
}

TEST_CASE("cut vertices cause no detection within detection_gap iterations of the last one", "[unit]") {
  compare::Settings rare = settings(5);
  rare.detection_gap = 2;
  CHECK(order(rare, 100, {0, 1, 1, 1, 1, 1}) ==
        std::vector{find, guess, sweep, sweep, find, sweep, sweep, find, sweep});
  rare.detection_every = 1;
  CHECK(order(rare, 100, {}) == std::vector{find, guess, sweep, find, sweep, find, sweep, find, sweep, find, sweep});
}

TEST_CASE("a deep vertex makes a single cut cause a detection, unless the setting forbids it", "[unit]") {
  compare::Settings deep = settings(4, 0.5);
  const auto next_after = [&](Index cut, bool is_deep) {
    reference::StepOrder order(deep, 10);
    order.took_place(0);
    order.took_place(0);
    order.took_place(cut, {}, is_deep);
    return *order.next();
  };
  CHECK(next_after(1, true) == find);
  CHECK(next_after(1, false) == sweep);
  CHECK(next_after(0, true) == sweep);
  deep.detection_deep = 0;
  CHECK(next_after(1, true) == sweep);
  CHECK(next_after(5, false) == find);
}

TEST_CASE("a step ends after an iteration that moves nothing and cuts nothing, unless a detection is due", "[unit]") {
  compare::Settings settles = settings(6, 0.5);
  settles.settled_move = 1;
  struct Iteration {
    Index cut = 0;
    bool is_still = true;
    reference::StepLag lag{};
  };
  const auto sweeps = [&](const std::vector<Iteration>& iterations) {
    reference::StepOrder order(settles, 10);
    order.took_place(0);
    order.took_place(0, {}, false, true);  // the guess does not end the step
    std::size_t count = 0;
    for (auto kind = order.next(); kind; kind = order.next()) {
      if (*kind == find) {
        order.took_place(0, {}, false, true);
        continue;
      }
      const Iteration& own = count < iterations.size() ? iterations[count] : Iteration{0, false};
      order.took_place(own.cut, own.lag, false, own.is_still);
      ++count;
    }
    return count;
  };
  CHECK(sweeps({}) == 6);
  CHECK(sweeps({{}}) == 1);
  CHECK(sweeps({{0, false}, {0, false}, {}}) == 3);
  CHECK(sweeps({{1}, {4}, {}}) == 3);                                  // too few for a detection
  CHECK(sweeps({{5}, {}}) == 2);                                       // after a detection
  CHECK(sweeps({{1, true, {1, false}}, {1, true, {1, false}}}) == 6);  // the second lag causes no detection
  settles.detection_gap = 9;
  CHECK(sweeps({{9}, {9}, {}}) == 3);
  settles.detection_every = 2;
  CHECK(sweeps({{0, false}, {}, {}}) == 3);
  settles.detection_every = 1;
  CHECK(sweeps({{}, {}, {}, {}, {}, {}}) == 6);
  settles.settled_move = 0;
  settles.detection_every = 0;
  CHECK(sweeps({{}, {}, {}, {}, {}, {}}) == 6);
}

TEST_CASE("whether an iteration moved a vertex farther than settled_move is decided along each axis, without rounding",
          "[unit]") {
  compare::Scene scene = scene_of(sheet(2, 1), {});
  scene.gravity = {};
  scene.settings.settled_move = 0.25;
  compare::round_to_single(scene);
  const compare::Topology topology = compare::build_topology(scene);
  const auto events = [&](const compare::Vec3f& move) {
    compare::StepOut answer;
    answer.target = answer.position = compare::to_single(scene.mesh.positions);
    answer.velocity.resize(answer.position.size());
    for (const StepEventKind kind : {find, guess, sweep, sweep, sweep, sweep}) {
      compare::StepEvent& event = answer.events.emplace_back();
      event.kind = kind, event.position = answer.position;
    }
    answer.events[2].position[3] = {1, 1, 1};
    answer.events[3].position[3] = {1 + move.x, 1 + move.y, 1 + move.z};
    for (std::size_t i : {4, 5}) answer.events[i].position[3] = {9.0f + static_cast<float>(i), 0, 0};
    return reference::step({&scene, &topology}, answer).events.size();
  };
  const float more = 0.25f + 0x1p-23f;
  CHECK(events({0.25f, -0.25f, 0.25f}) == 4);
  for (const float sign : {1.0f, -1.0f}) {
    CHECK(events({sign * more, 0, 0}) == 6);
    CHECK(events({0, sign * more, 0}) == 6);
    CHECK(events({0, 0, sign * more}) == 6);
  }
}

TEST_CASE("r_q grows with the fastest vertex, a prescribed one included, up to its cap", "[unit]") {
  compare::Scene scene = scene_of(sheet(3, 1), {0, 0, 0});
  scene.gravity = {};
  scene.settings.detection_radius_cap = 4;
  CHECK(static_cast<float>(truth_of(scene).query_radius) == 0.004f);
  compare::PrescribedMotion motion;
  motion.vertices = {0};
  motion.velocity = {0.5, 0, 0};
  scene.motions.push_back(motion);
  CHECK(truth_of(scene).query_radius == Approx(0.009).epsilon(1e-6));
  CHECK(truth_of(scene).prescribed_target[0].x == Approx(0.005).epsilon(1e-6));
  scene.motions[0].velocity.x = 10;
  CHECK(truth_of(scene).query_radius == Approx(0.016).epsilon(1e-6));
}
