// Compares the reference's hinge with differences of its energy and with mechanics. Also tests angles that jump or do
// not exist.
#include "reference/energies/bending.hpp"

#include <numbers>
#include <random>

#include "compare/oracle/smallest_distances.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::BendingCase;

namespace {

/// Returns the hinge's angle from unit vectors perpendicular to the edge, without normals of triangles: 0 if flat,
/// positive about x1 − x0.
double angle(const std::array<Point, 4>& x) {
  Point edge = minus(x[1], x[0]);
  const double length = norm(edge);
  for (double& e : edge) e /= length;
  const auto across = [&](const Point& p) {
    Point a = minus(p, x[0]);
    const double along = inner(a, edge);
    for (std::size_t k = 0; k < 3; ++k) a[k] -= along * edge[k];
    return a;
  };
  const Point a = across(x[2]), b = across(x[3]);
  const Point continued{-b[0], -b[1], -b[2]};
  return std::atan2(inner(outer(a, continued), edge), inner(a, continued));
}

std::array<Point, 4> points(const std::array<compare::Vec3f, 4>& x) {
  return {point(x[0]), point(x[1]), point(x[2]), point(x[3])};
}

BendingCase random_case(Draw& draw) {
  BendingCase c;
  const auto shape = [&] {
    std::array<compare::Vec3f, 4> x{draw.in_box(0.2), draw.in_box(0.2), draw.in_box(0.3), draw.in_box(0.3)};
    x[1].x += 1;
    x[2].y += 1;
    x[3].y -= 1;
    return x;
  };
  c.vertex = shape();
  c.start = shape();
  c.stiffness = draw.single(0.5, 2);
  c.rest_angle = draw.single(-1, 1);
  c.damping = draw.single(0, 2);
  return c;
}

/// Returns a case of the isometric model with a flat rest shape similar to that of random_case.
BendingCase isometric_case(Draw& draw) {
  BendingCase c = random_case(draw);
  c.model = compare::BendingModel::isometric_quadratic;
  c.weight = {draw.single(0.5, 2), draw.single(-2, -0.5), draw.single(-2, -0.5)};
  return c;
}

/// Returns ℓ of the isometric model, Σ w x, from the vertices themselves instead of their differences.
Point curvature(const std::array<Point, 4>& x, const BendingCase& c) {
  const std::array<double, 4> w{-double{c.weight[0]} - c.weight[1] - c.weight[2], c.weight[0], c.weight[1],
                                c.weight[2]};
  Point sum{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) sum[i] += w[k] * x[k][i];
  return sum;
}

double energy(const Point& own, const BendingCase& c) {
  std::array<Point, 4> x = points(c.vertex);
  x[static_cast<std::size_t>(c.own)] = own;
  if (c.model == compare::BendingModel::isometric_quadratic) {
    const Point l = curvature(x, c);
    const double moved = c.damping > 0 ? angle(x) - angle(points(c.start)) : 0;
    return c.stiffness / 2 * (inner(l, l) + c.damping * moved * moved);
  }
  const double now = angle(x), bent = now - c.rest_angle, moved = now - angle(points(c.start));
  return c.stiffness / 2 * (bent * bent + c.damping * moved * moved);
}

}  // namespace

TEST_CASE("the reference's hinge force is minus the slope of the energy at each of its vertices", "[property]") {
  Draw draw(1);
  for (int i = 0; i < 300; ++i) {
    BendingCase c = i % 8 < 4 ? random_case(draw) : isometric_case(draw);
    c.own = i % 4;
    const auto answers = reference::bending(c);
    REQUIRE(answers.size() == 1);
    const Point fallen = slope([&](const Point& x) { return energy(x, c); },
                               point(c.vertex[static_cast<std::size_t>(c.own)]), 1e-5);
    // Energies are about 10 J, and third derivatives below 10⁴ for heights above 0.4 m. Truncation gives 10⁻¹⁰/6 · 10⁴,
    // rounding 10 · 2⁻⁵³/10⁻⁵.
    CHECK(std::abs(answers[0].force.x + fallen[0]) < 1e-6);
    CHECK(std::abs(answers[0].force.y + fallen[1]) < 1e-6);
    CHECK(std::abs(answers[0].force.z + fallen[2]) < 1e-6);
  }
}

TEST_CASE("the reference's hinge exerts no net force and no net torque", "[property]") {
  Draw draw(2);
  for (int i = 0; i < 300; ++i) {
    BendingCase c = i % 2 == 0 ? random_case(draw) : isometric_case(draw);
    Point force{}, torque{};
    double scale = 0;
    for (c.own = 0; c.own < 4; ++c.own) {
      const compare::ForceAnswer answer = reference::bending(c)[0];
      const Point f{answer.force.x, answer.force.y, answer.force.z},
          turn = outer(point(c.vertex[static_cast<std::size_t>(c.own)]), f);
      for (std::size_t k = 0; k < 3; ++k) {
        force[k] += f[k];
        torque[k] += turn[k];
      }
      scale += answer.force_scale;
    }
    // The energy depends only on the relative positions of the four points, so only rounding in double remains: some
    // tens of 2⁻⁵³ on arms shorter than 2 m. In the isometric model, force_scale contains less than a quarter of the
    // elastic force's Σ |∂f/∂q| |q| over its inputs q.
    CHECK(norm(force) < 1e-13 * scale);
    CHECK(norm(torque) < 1e-13 * scale);
  }
}

TEST_CASE("the reference's hinge block is positive semidefinite, and the force vanishes at the rest angle",
          "[property]") {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    BendingCase c = random_case(draw);
    c.own = i % 4;
    const compare::ForceAnswer answer = reference::bending(c)[0];
    CHECK(smallest_quadratic(answer.block, draw) >= -1e-12 * answer.block_scale);
    c.rest_angle = static_cast<float>(angle(points(c.vertex)));
    c.damping = 0;
    const compare::ForceAnswer rest = reference::bending(c)[0];
    // θ₀ is the angle, rounded to single precision. force_scale includes the sensitivity to θ₀, so this rounding
    // changes the force by at most 2⁻²⁴ force_scale.
    CHECK(norm({rest.force.x, rest.force.y, rest.force.z}) <= 2 * compare::unit_roundoff * rest.force_scale);
  }
}

TEST_CASE("a hinge folded by π may answer from either side, and a collapsed one answers nothing", "[property]") {
  BendingCase c;
  c.vertex = {{{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.25f, 1, 0}}};
  c.start = c.vertex;
  c.stiffness = 1;
  c.own = 2;
  const auto folded = reference::bending(c);
  REQUIRE(folded.size() == 2);
  CHECK(folded[0].force.z == Approx(-folded[1].force.z));
  CHECK(std::abs(folded[0].force.z) == Approx(std::numbers::pi));
  c.vertex[3] = {0.25f, 0, 0};
  const auto collapsed = reference::bending(c);
  REQUIRE(collapsed.size() == 1);
  CHECK(collapsed[0].force == compare::Vec3{});
}

TEST_CASE("a hinge with a needle may count as collapsed, and a sound one may not", "[property]") {
  BendingCase c;
  c.vertex = {{{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -0.5f, 0.5f}}};
  c.start = c.vertex;
  c.stiffness = 1;
  c.own = 3;
  REQUIRE(reference::bending(c).size() == 1);
  c.vertex[2].y = 0x1p-20f;  // the sine of the angle at either end is 32 · 2⁻²⁴
  const auto needle = reference::bending(c);
  REQUIRE(needle.size() == 2);
  CHECK(norm({needle[0].force.x, needle[0].force.y, needle[0].force.z}) > 0.5);
  CHECK(needle[1].force == compare::Vec3{});
}

TEST_CASE(
    "the isometric model agrees with the hinge for small angles of a shape that keeps its lengths, and is 2 sin(θ/2) "
    "for large ones",
    "[property]") {
  // x0 and x1 lie on the edge, o0 above it, and o1 below it, rotated by `theta` about the edge. The weights belong to
  // this rest shape.
  const double length = 2, foot_a = 0.5, foot_b = 1.25, height_a = 1, height_b = 0.5;
  for (const double theta : {0.0, 1e-3, 0.7, 2.5}) {
    BendingCase c;
    const auto f = [](double x) { return static_cast<float>(x); };
    c.vertex = {{{0, 0, 0},
                 {f(length), 0, 0},
                 {f(foot_a), f(height_a), 0},
                 {f(foot_b), f(-height_b * std::cos(theta)), f(height_b * std::sin(theta))}}};
    c.start = c.vertex;
    c.stiffness = 3;
    c.weight = {f((foot_a / height_a + foot_b / height_b) / length), f(-1 / height_a), f(-1 / height_b)};
    const Point l = curvature(points(c.vertex), c);
    CHECK(norm(l) == Approx(2 * std::sin(theta / 2)).epsilon(1e-6).margin(1e-6));
    for (c.own = 0; c.own < 4; ++c.own) {
      c.model = compare::BendingModel::isometric_quadratic;
      const compare::ForceAnswer quadratic = reference::bending(c)[0];
      c.model = compare::BendingModel::discrete_hinge;
      const compare::ForceAnswer hinge = reference::bending(c)[0];
      const double apart = std::hypot(quadratic.force.x - hinge.force.x, quadratic.force.y - hinge.force.y,
                                      quadratic.force.z - hinge.force.z);
      // Forces of both models are at most c w θ, with c = 3 (`stiffness`) and the largest weight w = 2. They differ by
      // about θ² c w θ. Rounded coordinates add a few c w² 2⁻²⁴.
      if (theta < 0.1) CHECK(apart <= 1e-5);
    }
  }
}

TEST_CASE("damping of the isometric model sees no rigid motion, and resists a change of the angle alone",
          "[property]") {
  Draw draw(8);
  BendingCase c = isometric_case(draw);
  c.damping = 1.5f;
  c.start = c.vertex;
  BendingCase elastic = c;
  elastic.damping = 0;
  // Since the start the hinge has been rotated by 90° about z and moved.
  for (std::size_t k = 0; k < 4; ++k) c.start[k] = {-c.vertex[k].y + 1, c.vertex[k].x, c.vertex[k].z};
  for (c.own = elastic.own = 0; c.own < 4; ++c.own, ++elastic.own) {
    const compare::ForceAnswer damped = reference::bending(c)[0], free = reference::bending(elastic)[0];
    CHECK(std::hypot(damped.force.x - free.force.x, damped.force.y - free.force.y, damped.force.z - free.force.z) <
          1e-5 * norm({free.force.x, free.force.y, free.force.z}) + 1e-6);
  }
}

TEST_CASE("damping by vertex of both bending models is k times the block on the vertex's motion", "[property]") {
  Draw draw(9);
  for (int i = 0; i < 100; ++i) {
    BendingCase c = i % 2 == 0 ? random_case(draw) : isometric_case(draw);
    c.own = i % 4;
    BendingCase elastic = c;
    elastic.damping = 0;
    c.damping_form = compare::DampingForm::per_vertex;
    const compare::ForceAnswer damped = reference::bending(c)[0], free = reference::bending(elastic)[0];
    const Point moved = minus(point(c.vertex[static_cast<std::size_t>(c.own)]),
                              point(c.start[static_cast<std::size_t>(c.own)]));
    const double along = free.block[1] * moved[0] + free.block[3] * moved[1] + free.block[4] * moved[2];
    CHECK(damped.force.y == Approx(free.force.y - c.damping * along).margin(1e-10));
    for (std::size_t k = 0; k < 6; ++k)
      CHECK(damped.block[k] == Approx((1 + double{c.damping}) * free.block[k]).margin(1e-10));
  }
}

TEST_CASE("a force that vanishes because angle and gradient both do keeps the product of their errors", "[unit]") {
  // x0 is the middle of o0 and o1. So the angle is 0, and the lever arms of both triangles cancel at x1.
  BendingCase c;
  c.vertex = {{{0.033203125f, 0.236328125f, 0.366210938f},
               {0.099609375f, 0.236425787f, 0.36597997f},
               {0.033203125f, 0.236328125f, 0.299316406f},
               {0.033203125f, 0.236328125f, 0.43310547f}}};
  c.start = c.vertex;
  c.stiffness = 1.5e-6f;
  c.own = 1;
  const compare::ForceAnswer answer = reference::bending(c)[0];
  const double error = compare::bending_force_tolerance * compare::unit_roundoff * answer.force_scale;
  CHECK(norm({answer.force.x, answer.force.y, answer.force.z}) < 1e-20);
  // A single-precision kernel has a force error of 1.5e-22 N here, the product of the errors of moment and gradient.
  // The gradient's error is 2⁻²⁴ divided by the height of the triangles.
  CHECK(error > 1.5e-22);
  CHECK(error < 1e-3 * c.stiffness / 0.0668945 * 0x1p-24);
}

TEST_CASE("a hinge passes from π to -π only where its triangles touch, so that its angle needs no unwrapping",
          "[property]") {
  // At ±π both triangles lie in one plane on the same side of their edge and overlap: a corner of one triangle lies in
  // the other, or two edges cross. Bounds keep the distances of these pairs above zero. Coordinates are integers, so
  // nothing is rounded.
  std::mt19937 engine(3);
  std::uniform_int_distribution<int> along(-8, 16), up(1, 12);
  const compare::Topology topology = compare::build_topology(4, std::vector<compare::Triangle>{{0, 1, 2}, {1, 0, 3}});
  for (int i = 0; i < 2000; ++i) {
    std::vector<compare::Vec3> x{{0, 0, 0}, {8, 0, 0}};
    for (int k = 0; k < 2; ++k) {
      const auto side = static_cast<double>(along(engine)), height = static_cast<double>(up(engine));
      x.push_back({side, 3 * height, 4 * height});
    }
    const auto touch = [&] {
      const compare::SmallestDistances nearest = compare::smallest_distances(topology, x);
      return nearest.vertex_triangle == 0 || nearest.edge_edge == 0;
    };
    if (!touch()) FAIL(x[2].x << ' ' << x[2].y << ", " << x[3].x << ' ' << x[3].y);
    x[3].y = -x[3].y;  // flat
    x[3].z = -x[3].z;
    CHECK_FALSE(touch());
  }
}
