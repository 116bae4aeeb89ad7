// Tests whole runs of rods against closed forms (spin, rest, rigid motions, twist, energies), and the bits of resumed
// runs.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "compare/problem/rods.hpp"
#include "compare/problem/validate.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/sweep.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

using compare::Index;
using compare::Vec3;
using std::numbers::pi;

compare::RodMaterial yarn() { return {.density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = 0, .diameter = 1e-3}; }

/// Returns a scene of one rod along these points, in free space. h and the number of iterations are those of the yarn
/// scenes.
compare::Scene rod_scene(const std::vector<Vec3>& points, bool closed = false,
                         const compare::RodMaterial& rod = yarn()) {
  compare::Scene scene;
  scene.name = "rod";
  compare::Mesh mesh;
  mesh.positions = points;
  const auto n = static_cast<Index>(points.size());
  for (Index i = 1; i < n; ++i) mesh.loose_edges.push_back({i - 1, i});
  if (closed) mesh.loose_edges.push_back({n - 1, 0});
  compare::Body body;
  body.name = "rod";
  body.material.rod = rod;
  append_body(scene, body, mesh);
  scene.gravity = {};
  scene.settings.time_step = 4e-4;
  scene.settings.iterations = 4;
  scene.settings.contact_radius = 1e-4;
  compare::round_to_single(scene);
  return scene;
}

std::vector<Vec3> straight(int segments, double length) {
  std::vector<Vec3> points;
  for (int k = 0; k <= segments; ++k) points.push_back({length * k, 0, 0});
  return points;
}

std::vector<Vec3> helix(int segments) {
  std::vector<Vec3> points;
  for (int k = 0; k <= segments; ++k) {
    const double t = 0.3 * k;
    points.push_back({3e-3 * std::cos(t), 3e-3 * std::sin(t), 2e-4 * k});
  }
  return points;
}

RestState rest_of(const compare::Scene& scene) { return build_rest_state(scene, build_topology(scene)); }

/// Returns Σ m x × v about the z axis.
double spin(const compare::Scene& scene, const compare::Snapshot& state) {
  const RestState rest = rest_of(scene);
  double sum = 0;
  for (std::size_t v = 0; v < state.positions.size(); ++v)
    sum += double{rest.mass[v]} * (double{state.positions[v].x} * state.velocities[v].y -
                                   double{state.positions[v].y} * state.velocities[v].x);
  return sum;
}

/// Returns the share of the angular momentum that a straight rod keeps: 100 segments of 1 mm that rotate at 10 rad/s
/// for 0.2 s.
double kept_spin(compare::RodStart frames) {
  compare::Scene scene = rod_scene(straight(100, 1e-3));
  for (std::size_t v = 0; v < scene.velocities.size(); ++v) {
    Vec3& x = scene.mesh.positions[v];
    x.x -= 0.05;
    scene.rest_positions[v] = x;
    scene.velocities[v] = {0, 10 * x.x, 0};
  }
  scene.settings.rod_start = frames;
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  const double before = spin(scene, simulation->snapshot());
  simulation->advance(500);
  return spin(scene, simulation->snapshot()) / before;
}

bool same_bits(const compare::Snapshot& a, const compare::Snapshot& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return same(a.positions, b.positions) && same(a.velocities, b.velocities) && same(a.orientations, b.orientations);
}

double distance(const compare::Vec3f& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Returns the angle of the twist from orientation a to orientation b, which have the same director.
double twist_between(const compare::Quaternion& a, const compare::Quaternion& b) {
  const double z = double{a[3]} * b[2] - double{a[2]} * b[3] - double{a[0]} * b[1] + double{a[1]} * b[0],
               w = double{a[3]} * b[3] + double{a[2]} * b[2] + double{a[0]} * b[0] + double{a[1]} * b[1];
  return 2 * std::atan2(w < 0 ? -z : z, std::abs(w));
}

}  // namespace

TEST_CASE("a free rod keeps its angular momentum but for what backward Euler loses; without turned frames it does not",
          "[property]") {
  // Backward Euler loses the share (ω h)² per step: 500 · (10 · 4·10⁻⁴)² = 0.8 %.
  CHECK(kept_spin(compare::RodStart::turned) == Approx(0.992).margin(0.002));
  CHECK(kept_spin(compare::RodStart::kept) < 0.6);
}

TEST_CASE("a bent and twisted rod at rest stays, wherever it is turned to, and drifts without a force", "[property]") {
  compare::Scene scene = rod_scene(helix(30));
  const double angle = 0.7;
  for (Vec3& x : scene.mesh.positions)
    x = {std::cos(angle) * x.x - std::sin(angle) * x.z, x.y, std::sin(angle) * x.x + std::cos(angle) * x.z};
  // Rotates the orientations at rest like the positions.
  const RestState rest = rest_of(scene);
  const Quat turn{0, static_cast<float>(-std::sin(angle / 2)), 0, static_cast<float>(std::cos(angle / 2))};
  for (const Quat& q : rest.rods.orientations) scene.orientations.push_back(quaternion(unit(turn * q)));
  for (Vec3& v : scene.velocities) v = {0.01, -0.02, 0.005};
  compare::round_to_single(scene);
  CHECK(compare::describe(compare::validate(scene)).empty());
  const auto simulation = start_cpu(scene, {});
  const auto rows = simulation->advance(100);
  const compare::Snapshot state = simulation->snapshot();
  const double time = 100 * scene.settings.time_step;
  double worst = 0;
  for (std::size_t v = 0; v < state.positions.size(); ++v) {
    const Vec3& x = scene.mesh.positions[v];
    worst = std::max(worst, distance(state.positions[v], {x.x + 0.01 * time, x.y - 0.02 * time, x.z + 0.005 * time}));
  }
  // tolerance: rounding errors of 100 steps, for segments of 1 mm at 1 cm from the origin
  CHECK(worst < 1e-6);
  CHECK(rows.back().mean_stretch == Approx(0).margin(1e-4));
}

TEST_CASE("a rod that is straight at rest and wound to a circle has the energy of its curvature", "[property]") {
  for (const int n : {50, 200}) {
    const double radius = 0.02, length = 2 * pi * radius / n;
    compare::Scene scene = rod_scene(straight(n, length));
    // Segments of `length` are chords, so n of them are slightly more than a whole circle.
    const double chord = 2 * std::asin(length / (2 * radius));
    for (int k = 0; k <= n; ++k) {
      const double t = chord * k - pi;
      scene.mesh.positions[static_cast<std::size_t>(k)] = {radius * std::sin(t), radius * std::cos(t), 0};
    }
    scene.settings.iterations = 1;
    scene.settings.contact_radius = 1e-5;
    for (Vec3& v : scene.velocities) v = {};
    scene.bodies[0].material.rod->density = 1e6;  // so heavy that it has not moved after a step
    // The end segments are held, because their orientations would change otherwise.
    scene.motions = {{.name = "first", .vertices = {0, 1}, .keyframes = {}},
                     {.name = "last", .vertices = {n - 1, n}, .keyframes = {}}};
    compare::round_to_single(scene);
    const auto simulation = start_cpu(scene, {});
    const double energy = simulation->advance(1).back().elastic_energy;
    // Each of n − 1 joints has the angle θ = `chord` and the energy k_b/(2 l̄) θ², up to the factor 1 − θ²/48.
    CHECK(energy == Approx(yarn().bend * (n - 1) * chord * chord / (2 * length)).epsilon(1e-3));
  }
}

TEST_CASE("twist between two turned ends is linear in arc length", "[property]") {
  compare::Scene scene = rod_scene(straight(20, 1e-3));
  const double rate = 2, turned = 1.0;
  compare::PrescribedMotion left, right;
  left.name = "left", right.name = "right";
  left.vertices = {0, 1}, right.vertices = {19, 20};
  right.axis = {1, 0, 0}, right.angular_velocity = rate, right.end = turned / rate;
  scene.motions = {left, right};
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  simulation->advance(2000);  // 0.5 s of turning, 0.3 s of rest: 1,200 sweeps
  const std::vector<compare::Quaternion> q = simulation->snapshot().orientations;
  REQUIRE(q.size() == 20);
  double sum = 0;
  for (std::size_t e = 1; e < q.size(); ++e) {
    const double angle = std::abs(twist_between(q[e - 1], q[e]));
    CHECK(angle == Approx(turned / 19).epsilon(0.01));
    sum += angle;
  }
  CHECK(sum == Approx(turned).epsilon(1e-3));
}

TEST_CASE("renumbered vertices and segments that run the other way give the same motion but for roundings",
          "[property]") {
  const std::vector<Vec3> points = helix(24);
  compare::Scene one = rod_scene(points);
  one.gravity = {0, -9.81, 0};
  one.motions.push_back({.name = "held", .vertices = {0, 1}, .keyframes = {}});
  compare::Scene other = one;
  const auto n = static_cast<Index>(points.size());
  std::vector<Index> place(points.size());
  for (Index v = 0; v < n; ++v) place[static_cast<std::size_t>(v)] = (7 * v + 3) % n;
  for (Index v = 0; v < n; ++v) {
    const auto from = static_cast<std::size_t>(v), to = static_cast<std::size_t>(place[from]);
    other.mesh.positions[to] = one.mesh.positions[from];
    other.rest_positions[to] = one.rest_positions[from];
  }
  std::reverse(other.mesh.loose_edges.begin(), other.mesh.loose_edges.end());
  for (std::size_t e = 0; e < other.mesh.loose_edges.size(); ++e) {
    compare::Edge& ends = other.mesh.loose_edges[e];
    for (Index& v : ends) v = place[static_cast<std::size_t>(v)];
    if (e % 3 == 0) std::swap(ends[0], ends[1]);
  }
  for (Index& v : other.motions[0].vertices) v = place[static_cast<std::size_t>(v)];
  // Colours depend on vertex numbers, and sweeps that have not converged depend on colours. So the sweeps converge
  // here.
  for (compare::Scene* scene : {&one, &other}) scene->settings.iterations = 100;
  const auto first = start_cpu(one, {}), second = start_cpu(other, {});
  first->advance(50), second->advance(50);
  const compare::Snapshot a = first->snapshot(), b = second->snapshot();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const compare::Vec3f& x = b.positions[static_cast<std::size_t>(place[v])];
    CHECK(distance(a.positions[v], {x.x, x.y, x.z}) < 1e-5);  // after a fall of 2 mm
  }
}

TEST_CASE("a run of rods that is interrupted goes on to the same bits", "[property]") {
  compare::Scene scene = rod_scene(helix(40));
  scene.gravity = {0, -9.81, 0};
  scene.bodies[0].material.rod->damping = 1e-4;
  scene.motions.push_back(
      {.name = "turned", .vertices = {0, 1}, .axis = {0, 0, 1}, .angular_velocity = 5, .keyframes = {}});
  scene.settings.contact_radius = 1e-3;
  compare::round_to_single(scene);
  const auto whole = start_cpu(scene, {}), begun = start_cpu(scene, {}), resumed = start_cpu(scene, {});
  whole->advance(60);
  begun->advance(25);
  resumed->restore(begun->snapshot());
  resumed->advance(35);
  CHECK(same_bits(whole->snapshot(), resumed->snapshot()));
}

TEST_CASE("yarn tied by springs has the bits that it has beside a triangle that is far away", "[property]") {
  const auto scene_with = [](bool tied, bool has_triangle, compare::DampingForm damping) {
    compare::Scene scene = rod_scene(helix(60));
    scene.gravity = {0, -9.81, 0};
    scene.bodies[0].material.rod->damping = 1e-4;
    scene.bodies[0].material.friction = 0.2;
    scene.settings.contact_radius = 5e-3;  // windings are 4.2 mm apart
    scene.settings.damping = damping;
    scene.settings.lanes = 2;
    if (tied)
      for (const Index end : {20, 45})
        scene.springs.push_back({.first = 0, .second = end, .stiffness = 50, .rest_length = 2e-3, .damping = 1e-4});
    if (has_triangle) {
      compare::Mesh mesh;
      mesh.positions = {{10, 0, 0}, {11, 0, 0}, {10, 0, 1}};
      mesh.triangles = {{0, 1, 2}};
      compare::Body body;
      body.name = "far";
      append_body(scene, body, mesh);
    }
    compare::round_to_single(scene);
    return scene;
  };
  const auto asked = [](const compare::Scene& scene) { return asked_of_sum(rest_of(scene), scene) & ~asks_any_model; };
  const auto colours = [](const compare::Scene& scene) { return colour_vertices(rest_of(scene)).count; };
  for (const auto damping : {compare::DampingForm::strain, compare::DampingForm::per_vertex}) {
    const compare::Scene alone = scene_with(true, false, damping), beside = scene_with(true, true, damping),
                         untied = scene_with(false, false, damping);
    CHECK(asked(untied) == Kinds::bit<SegmentKind>);
    CHECK(asked(alone) == (Kinds::bit<SegmentKind> | Kinds::bit<SpringKind>));
    CHECK(asked(beside) == (Kinds::bit<SegmentKind> | Kinds::bit<SpringKind> | Kinds::bit<TriangleKind>));
    REQUIRE(colours(alone) == colours(beside));  // otherwise the order of the sweep differs
    const auto one = start_cpu(alone, {}), other = start_cpu(beside, {}), without = start_cpu(untied, {});
    const std::vector<compare::StepMetrics> rows = one->advance(80);
    other->advance(80);
    without->advance(80);
    CHECK(rows.back().edge_edge_contacts > 0);
    compare::Snapshot seen = other->snapshot();
    seen.positions.resize(alone.mesh.positions.size());
    seen.velocities.resize(alone.mesh.positions.size());
    CHECK(same_bits(one->snapshot(), seen));
    CHECK(!same_bits(one->snapshot(), without->snapshot()));  // a spring acts
  }
}

TEST_CASE("an open chain of segments takes two colours, an odd ring three", "[unit]") {
  const auto colours = [](const compare::Scene& scene) {
    const RestState rest = rest_of(scene);
    return std::array{colour_segments(rest.rods).count, colour_vertices(rest).count};
  };
  CHECK(colours(rod_scene(straight(99, 1e-3))) == std::array{2, 2});
  std::vector<Vec3> ring;
  for (int k = 0; k < 7; ++k) ring.push_back({std::cos(2 * pi * k / 7), std::sin(2 * pi * k / 7), 0});
  CHECK(colours(rod_scene(ring, true)) == std::array{3, 3});
}
