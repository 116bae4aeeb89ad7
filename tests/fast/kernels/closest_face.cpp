// Tests hand-computed values: the triangle (0,0,0), (4,0,0), (0,4,0), and points over each of its seven faces and on
// the planes between them.
#include "fast/kernels/closest_face.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;

struct Hand {
  Vec x;
  int face;  // bit set of the corners of the closest face
  double distance;
};

const std::array<Vec, 3> corners{Vec{0, 0, 0}, Vec{4, 0, 0}, Vec{0, 4, 0}};

const std::vector<Hand> hands{
    {{1, 1, 2}, 7, 2},               // over the inside
    {{-3, -4, 0}, 1, 5},             // beyond corner 0
    {{4, -3, 4}, 2, 5},              // on the end plane of corner 1 and edge 01: the corner wins
    {{1, -3, 4}, 3, 5},              // beside edge 01
    {{1, 0, 2}, 3, 2},               // over edge 01: the edge wins over the inside
    {{4, 4, 0}, 6, std::sqrt(8.0)},  // beside edge 12: foot (2, 2)
    {{-2, 1, 0}, 5, 2},              // beside edge 20
    {{0, 0, 3}, 1, 3},               // over a corner
    {{0, 9, 12}, 4, 13},             // beyond corner 2
};

/// Returns the corners of the feature, as a bit set.
int bits(TriangleFeature feature) {
  constexpr std::array<int, 7> of{1, 2, 4, 3, 6, 5, 7};
  return of[static_cast<std::size_t>(feature)];
}

double distance_to_segment(const Vec& x, const Vec& a, const Vec& b) {
  using Wide = long double;
  const std::array<Wide, 3> u{Wide(x.x) - a.x, Wide(x.y) - a.y, Wide(x.z) - a.z},
      e{Wide(b.x) - a.x, Wide(b.y) - a.y, Wide(b.z) - a.z};
  const Wide ee = e[0] * e[0] + e[1] * e[1] + e[2] * e[2], ue = u[0] * e[0] + u[1] * e[1] + u[2] * e[2];
  const Wide t = ee > 0 ? std::min<Wide>(1, std::max<Wide>(0, ue / ee)) : 0;
  return static_cast<double>(
      std::sqrt(std::pow(u[0] - t * e[0], 2) + std::pow(u[1] - t * e[1], 2) + std::pow(u[2] - t * e[2], 2)));
}

double distance_to_triangle(const Vec& x, const Corners& t) {
  const double edges = std::min(
      {distance_to_segment(x, t.a, t.b), distance_to_segment(x, t.b, t.c), distance_to_segment(x, t.a, t.c)});
  using Wide = long double;
  const auto minus = [](const Vec& p, const Vec& q) {
    return std::array<Wide, 3>{Wide(p.x) - q.x, Wide(p.y) - q.y, Wide(p.z) - q.z};
  };
  const auto by = [](const auto& p, const auto& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  const auto times = [](const auto& p, const auto& q) {
    return std::array<Wide, 3>{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  const auto u = minus(x, t.a), e = minus(t.b, t.a), w = minus(t.c, t.a), n = times(e, w);
  const Wide nn = by(n, n), at_b = by(times(u, w), n), at_c = by(times(e, u), n);
  if (!(nn > 0 && at_b > 0 && at_c > 0 && at_b + at_c < nn)) return edges;
  return std::min(edges, static_cast<double>(std::abs(by(u, n)) / std::sqrt(nn)));
}

}  // namespace

TEST_CASE("closest_face: hand cases in all six orders of the corners", "[unit]") {
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (const Hand& hand : hands) {
    for (const auto& order : orders) {
      const auto at = [&](std::size_t k) { return corners[static_cast<std::size_t>(order[k])]; };
      const Corners t{at(0), at(1), at(2)};
      int face = 0;
      for (std::size_t k = 0; k < 3; ++k) face |= (bits(closest_feature(hand.x, t)) >> k & 1) << order[k];
      CHECK(face == hand.face);
      CHECK(point_triangle_distance(hand.x, t).value == Approx(hand.distance).epsilon(1e-14));
    }
  }
}

TEST_CASE("closest_face: a collapsed triangle has no inside, and its distance is that of its edges", "[unit]") {
  const Corners line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, point{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  for (const Vec& x : {Vec{1, 0, 0}, Vec{0.3F, 0.1F, 7}, Vec{-1, -2, -3}, Vec{1, 2, 3}, Vec{0, 0, 0}}) {
    CHECK(closest_feature(x, line) != TriangleFeature::interior);
    CHECK(closest_feature(x, point) == TriangleFeature::corner_0);
    const Distance d = point_triangle_distance(x, line);
    CHECK(d.value == Approx(distance_to_triangle(x, line)).margin(1e-14));
    CHECK(static_cast<double>(d.below()) <= distance_to_triangle(x, line));
  }
}

TEST_CASE("closest_face: distance_below never exceeds the distance, and is close to it", "[property]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-20, 20), thinness(-24, 0);
  const auto point = [&](float size) { return Vec{size * unit(random), size * unit(random), size * unit(random)}; };
  int above = 0, loose = 0;
  for (int i = 0; i < 200000; ++i) {
    const float size = std::ldexp(1.0F, exponent(random));
    Corners t{point(size), point(size), point(size)};
    // slivers
    if (i % 3 == 1) t.c = t.a + unit(random) * (t.b - t.a) + std::ldexp(1.0F, thinness(random)) * point(size);
    // needles
    if (i % 3 == 2) t.b = t.a + std::ldexp(1.0F, thinness(random)) * point(size);
    const Vec x = i % 2 == 0 ? point(size)
                             : (1.0F / 3) * (t.a + t.b + t.c) + std::ldexp(1.0F, thinness(random)) * point(size);
    const Distance d = point_triangle_distance(x, t);
    const double exact = distance_to_triangle(x, t), extent = static_cast<double>(size) * 8;
    above += static_cast<double>(d.below()) > exact * (1 + 1e-15) + extent * 1e-18;
    loose += exact - static_cast<double>(d.below()) > 24 * 0x1p-24 * std::max(exact, extent);
  }
  CHECK(above == 0);
  CHECK(loose == 0);
}

TEST_CASE("closest_face: the chosen face attains the triangle's distance, on lattices as on random points",
          "[property]") {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> lattice(-3, 3);
  std::uniform_real_distribution<float> unit(-1, 1);
  int wrong = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto point = [&] {
      return i % 2 == 0 ? Vec{static_cast<float>(lattice(random)), static_cast<float>(lattice(random)),
                              static_cast<float>(lattice(random))}
                        : Vec{unit(random), unit(random), unit(random)};
    };
    const Corners t{point(), point(), point()};
    const Vec x = point();
    const Vec weights = closest_weights(x, t, closest_feature(x, t));
    const Vec foot = weights.x * t.a + weights.y * t.b + weights.z * t.c;
    const double reached = distance_to_segment(x, foot, foot), exact = distance_to_triangle(x, t);
    wrong += std::abs(reached - exact) > 2e-6 * (1 + exact);  // single-precision weights on coordinates up to 3
  }
  CHECK(wrong == 0);
}
