// Tests Newton's method with the frames of rods as unknowns: derivatives against differences, the minimiser of the
// sweeps, the deflection of a cantilever, and the twist at which a ring leaves its plane.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/problem/rods.hpp"
#include "reference/simulation.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "reference/solvers/rods/rod_system.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using reference::Triple;

namespace {

using compare::Index;
using compare::Vec3;

/// Returns a rod along these points with its first segment fixed.
compare::Scene held_rod(const std::vector<Vec3>& points, const compare::RodMaterial& rod) {
  compare::Scene scene;
  scene.name = "rod";
  compare::Mesh mesh;
  mesh.positions = points;
  for (Index v = 1; v < static_cast<Index>(points.size()); ++v) mesh.loose_edges.push_back({v - 1, v});
  compare::Body body;
  body.name = "rod";
  body.material.rod = rod;
  append_body(scene, body, mesh);
  scene.motions = {{.name = "clamp", .vertices = {0, 1}, .keyframes = {}}};
  scene.settings.contact_radius = 1e-4;
  compare::round_to_single(scene);
  return scene;
}

std::vector<Vec3> straight(int segments) {
  std::vector<Vec3> points;
  for (int k = 0; k <= segments; ++k) points.push_back({1e-3 * k, 0, 0});
  return points;
}

double distance(const compare::Vec3f& a, const compare::Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

}  // namespace

TEST_CASE("rods: gradients and Hessians of segments and joints are those of their energies", "[property]") {
  std::vector<Vec3> points;
  for (int k = 0; k <= 3; ++k) points.push_back({1e-3 * k, 4e-4 * k * k, 2e-4 * std::sin(2.0 * k)});
  compare::Scene scene = held_rod(points, {.damping = 1e-3});
  const compare::Topology topology = build_topology(scene);
  reference::RodSystem system(scene, reference::rest_state({&scene, &topology}).exact);
  std::vector<Triple<double>> x;
  for (const Vec3& p : scene.mesh.positions) x.push_back({p.x, p.y, p.z});
  system.begin_step(x, 1);
  for (std::size_t v = 0; v < x.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) x[v][axis] += 1e-4 * std::sin(3.0 * static_cast<double>(3 * v + axis));
  system.sweep(x);  // changes the frames, so that they differ from those at the start and at rest
  x.resize(x.size() + system.segments());
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto unknown = system.vertices(i);
    const reference::StencilDerivatives at = system.derivatives(i, x, reference::HessianProjection::none);
    CHECK(at.energy == Approx(system.energy(i, x)));
    const auto moved = [&](std::size_t a, double by, std::size_t b, double also) {
      auto to = x;
      to[static_cast<std::size_t>(unknown[a / 3])][a % 3] += by;
      to[static_cast<std::size_t>(unknown[b / 3])][b % 3] += also;
      return system.energy(i, to);
    };
    const std::size_t count = unknown[2] < 0 ? 6 : 9;
    for (std::size_t a = 0; a < count; ++a) {
      // Positions are in metres, rotations in radians. With these steps a difference loses half of the digits.
      const auto step = [&](std::size_t k) { return unknown[k / 3] < 4 ? 1e-6 : 1e-3; };
      const double slope = (moved(a, step(a), a, 0) - moved(a, -step(a), a, 0)) / (2 * step(a));
      CHECK(at.gradient[a] == Approx(slope).epsilon(1e-5).margin(1e-9));
      for (std::size_t b = 0; b < count; ++b) {
        const double s = step(a), t = step(b);
        const double bend = (moved(a, s, b, t) - moved(a, s, b, -t) - moved(a, -s, b, t) + moved(a, -s, b, -t)) /
                            (4 * s * t);
        CHECK(at.hessian[12 * a + b] == Approx(bend).epsilon(1e-3).margin(1e-5 * (0.1 / (s * 1e3) / (t * 1e3))));
      }
    }
  }
}

TEST_CASE("rods: Newton's method and converged sweeps end at the same minimiser", "[property]") {
  std::vector<Vec3> points;
  for (int k = 0; k <= 10; ++k) points.push_back({1e-3 * k, 3e-4 * std::sin(0.8 * k), 2e-4 * std::cos(0.5 * k)});
  compare::Scene scene = held_rod(points, {});
  scene.motions[0].axis = {1, 0, 0};
  scene.motions[0].angular_velocity = 20;
  scene.settings.time_step = 1e-3;
  scene.settings.iterations = 2000;
  set_setting(scene.settings, "newton_tolerance", 1e-9);
  const auto newton = reference::start_newton(scene, {}), vbd = reference::start_vbd(scene, {});
  for (int step = 0; step < 5; ++step) {
    CHECK(newton->advance(1).back().status == compare::step_clean);
    vbd->advance(1);
  }
  const compare::Snapshot a = newton->snapshot(), b = vbd->snapshot();
  // Coordinates are below 1 cm. In each of five steps both solvers round them to single precision, by 2⁻²⁴ of 1 cm.
  for (std::size_t v = 0; v < points.size(); ++v) CHECK(distance(a.positions[v], b.positions[v]) < 5e-9);
  for (std::size_t e = 0; e < a.orientations.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(double{a.orientations[e][k]} == Approx(double{b.orientations[e][k]}).margin(1e-5));
}

// After its guess, a freely falling straight rod has no forces and torques except rounding. Implicit Euler falls by g
// h² n (n + 1)/2. The floor acts below −2.8 mm, which the sixth step reaches.
TEST_CASE("rods: Newton's steps of a straight cord converge in free fall, and when it meets the walls of a channel",
          "[property]") {
  compare::Scene scene;
  scene.name = "cord";
  compare::Material walls;
  walls.contact_stiffness = 1e4;
  walls.friction = 0;
  const double a = 0.12, b = 4e-3;
  append_body(scene, {.name = "channel", .fixed = true, .material = walls},
              {{{-a, -b, -b}, {-a, -b, b}, {-a, b, b}, {-a, b, -b}, {a, -b, -b}, {a, -b, b}, {a, b, b}, {a, b, -b}},
               {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}},
               {}});
  compare::Material cord = walls;
  cord.rod = compare::RodMaterial{.density = 5e-3, .stretch = 1000, .bend = 1e-4};
  append_body(scene, {.name = "cord", .material = cord},
              {{{-0.08, 0, 0}, {0, 0, 0}, {0.08, 0, 0}}, {}, {{0, 1}, {1, 2}}});
  for (std::size_t v = 8; v < 11; ++v) scene.velocities[v] = {0.05, 0, 0.02};
  const double h = scene.settings.time_step = 1.0 / 240;
  scene.settings.contact_radius = 1.2e-3;
  compare::round_to_single(scene);
  const auto newton = reference::start_newton(scene, {});
  for (int step = 1; step <= 60; ++step) {
    INFO("step " << step);
    REQUIRE(newton->advance(1).back().status == compare::step_clean);
    for (std::size_t v = 8; v < 11; ++v) {
      const compare::Vec3f x = newton->snapshot().positions[v];
      if (step <= 5) CHECK(double{x.y} == Approx(-9.81 * h * h * step * (step + 1) / 2).epsilon(1e-5));
      CHECK(std::abs(double{x.y}) < b);
      CHECK(std::abs(double{x.z}) < b);
    }
  }
}

TEST_CASE("rods: a cantilever under its weight sinks as a beam does, in proportion to load and 1/k_b", "[property]") {
  const auto deflection = [](double density, double bend) {
    compare::Scene scene = held_rod(straight(101), {.density = density, .stretch = 100, .bend = bend});
    scene.settings.time_step = 0.01;
    set_setting(scene.settings, "newton_tolerance", 1e-7);
    const auto newton = reference::start_newton(scene, {});
    newton->advance(60);
    return -double{newton->snapshot().positions.back().y};
  };
  const double density = 4e-4, bend = 1e-4, load = density * 9.81;
  // The rod is clamped at the middle of its fixed segment, half a segment before the free part.
  const double length = 100.5e-3, sunk = deflection(density, bend);
  CHECK(sunk == Approx(load * std::pow(length, 4) / (8 * bend)).epsilon(0.01));
  CHECK(deflection(density, 2 * bend) == Approx(sunk / 2).epsilon(2e-3));
  CHECK(deflection(density / 2, bend) == Approx(sunk / 2).epsilon(2e-3));
}

TEST_CASE("rods: a ring of a straight rod with k_b = GJ leaves its plane at a twist of 2 pi sqrt 3 (Michell)",
          "[property]") {
  // Returns the growth of a ripple in half a second. The ring is a polygon without one side; its first and last sides
  // are fixed.
  const auto growth = [](double share_of_critical) {
    constexpr Index n = 60;
    const double radius = 0.02, angle = 2 * std::numbers::pi / (n + 1), side = 2 * radius * std::sin(angle / 2);
    std::vector<Vec3> rest;
    for (Index k = 0; k <= n; ++k) rest.push_back({side * k, 0, 0});
    compare::Scene scene = held_rod(rest, {.density = 1e-3, .stretch = 1, .bend = 2e-7});
    scene.motions.push_back({.name = "other clamp", .vertices = {n - 1, n}, .keyframes = {}});
    constexpr double ripple = 1e-3;  // share of the radius
    for (Index k = 0; k <= n; ++k) {
      const bool is_held = k < 2 || k + 1 >= n;
      scene.mesh.positions[static_cast<std::size_t>(k)] = {radius * std::sin(angle * k), radius * std::cos(angle * k),
                                                           is_held ? 0 : ripple * radius * std::sin(2 * angle * k)};
    }
    // Frames follow the polygon. Side e has the direction of the x axis, rotated by -angle (e + 1/2) about z. Each
    // frame is also rotated about its director by the ring's twist at side e.
    const double twist = share_of_critical * std::sqrt(3.0) * angle;
    for (Index e = 0; e < n; ++e) {
      const double way = -angle * (e + 0.5) / 2, turn = twist * e / 2, half = std::sqrt(0.5);
      // Product of three rotations, the right one first: the twist about z, a rotation by π/2 about y that takes z to
      // x, and twice `way` about z: (0, 0, sin way, cos way) (0, half, 0, half) (0, 0, sin turn, cos turn).
      const double x = half * std::sin(turn), y = half * std::cos(turn), z = half * std::sin(turn),
                   w = half * std::cos(turn);
      scene.orientations.push_back({static_cast<float>(std::cos(way) * x - std::sin(way) * y),
                                    static_cast<float>(std::cos(way) * y + std::sin(way) * x),
                                    static_cast<float>(std::cos(way) * z + std::sin(way) * w),
                                    static_cast<float>(std::cos(way) * w - std::sin(way) * z)});
    }
    for (compare::Quaternion& q : scene.orientations) {
      const double size = std::sqrt(double{q[0]} * q[0] + double{q[1]} * q[1] + double{q[2]} * q[2] +
                                    double{q[3]} * q[3]);
      for (float& part : q) part = static_cast<float>(part / size);
    }
    scene.gravity = {};
    scene.settings.contact_radius = 1e-5;
    scene.settings.time_step = 0.01;
    set_setting(scene.settings, "newton_tolerance", 1e-4);
    compare::round_to_single(scene);
    const auto newton = reference::start_newton(scene, {});
    newton->advance(50);
    double largest = 0;
    for (const compare::Vec3f& x : newton->snapshot().positions) largest = std::max(largest, std::abs(double{x.z}));
    return largest / (ripple * radius);
  };
  // Three of the ring's 61 sides do not bend: both fixed sides and the missing one. So the ring is stiffer by about
  // 3/61, and its critical twist is higher by this share.
  CHECK(growth(1) < 1);
  CHECK(growth(1.08) > 10);
}
