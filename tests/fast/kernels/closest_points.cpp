#include "fast/kernels/closest_points.hpp"

#include <array>
#include <cmath>
#include <random>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;
using Exact = std::array<long double, 3>;

Exact minus(const Exact& a, const Exact& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double by(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact widened(const Vec& a) { return {a.x, a.y, a.z}; }

long double to_segment(const Exact& x, const Exact& a, const Exact& b) {
  const Exact u = minus(x, a), e = minus(b, a);
  const long double ee = by(e, e), t = ee > 0 ? std::min(1.0L, std::max(0.0L, by(u, e) / ee)) : 0;
  const Exact p = minus(u, {t * e[0], t * e[1], t * e[2]});
  return std::sqrt(by(p, p));
}

/// Returns the distance by ternary search over the first edge; the distance to the second edge is convex along the
/// first.
double searched_distance(const Ends& p, const Ends& q) {
  const Exact a = widened(p.a), b = widened(p.b), c = widened(q.a), d = widened(q.b);
  const auto at = [&](long double s) {
    const Exact e = minus(b, a);
    return to_segment({a[0] + s * e[0], a[1] + s * e[1], a[2] + s * e[2]}, c, d);
  };
  long double low = 0, high = 1;
  for (int i = 0; i < 120; ++i) {
    const long double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) = at(low + third) < at(high - third) ? high - third : low + third;
  }
  return static_cast<double>(std::min({at(low), at(0), at(1)}));
}

}  // namespace

TEST_CASE("closest_points: hand cases", "[unit]") {
  const Ends x_axis{{0, 0, 0}, {4, 0, 0}};
  const auto features = [&](const Vec& a, const Vec& b) {
    const EdgePairFeatures on = closest_edge_features(x_axis, {a, b});
    return std::pair{on.first, on.second};
  };
  CHECK(features({1, -1, 2}, {1, 1, 2}) == std::pair{EdgeFeature::interior, EdgeFeature::interior});
  CHECK(features({1, 1, 0}, {2, 5, 0}) == std::pair{EdgeFeature::interior, EdgeFeature::end_0});
  CHECK(features({6, -1, 0}, {6, 1, 0}) == std::pair{EdgeFeature::end_1, EdgeFeature::interior});
  CHECK(features({5, 1, 0}, {9, 1, 0}) == std::pair{EdgeFeature::end_1, EdgeFeature::end_0});
  // A point on the plane at an end, normal to the edge, is closest to the end.
  CHECK(features({4, 1, 0}, {4, 5, 0}) == std::pair{EdgeFeature::end_1, EdgeFeature::end_0});
  CHECK(features({-9, 3, 0}, {-3, 4, 0}) == std::pair{EdgeFeature::end_0, EdgeFeature::end_1});
  CHECK(edge_edge_distance(x_axis, {{-9, 3, 0}, {-3, 4, 0}}).value == 5);
  // An edge without length has end_0 as its closest feature.
  CHECK(features({2, 3, 4}, {2, 3, 4}) == std::pair{EdgeFeature::interior, EdgeFeature::end_0});
}

TEST_CASE("closest_points: nearly parallel edges meet in the middle of their overlap, with the true distance beside",
          "[unit]") {
  const Ends first{{0, 0, 0}, {4, 0, 0}}, second{{1, 3, 0}, {7, 3, 0}}, touching{{4, 3, 0}, {7, 3, 0}},
      steep{{1, 3, 0}, {7, 3.0625F, 0}};
  CHECK(is_overlapping_parallel(first, second));
  CHECK_FALSE(is_overlapping_parallel(first, touching));  // projections share one point only
  CHECK_FALSE(is_overlapping_parallel(first, steep));     // angle 0.01
  CHECK_FALSE(is_overlapping_parallel({{1, 1, 1}, {1, 1, 1}}, second));
  const EdgeParameters at = contact_parameters(first, second, {EdgeFeature::interior, EdgeFeature::interior, true});
  CHECK(at.first == 0.625);
  CHECK(at.second == 0.25);
  CHECK(points_distance(first, second, at) == 3);
  CHECK(edge_edge_distance(first, second).value == 3);
}

TEST_CASE("closest_points: distance_below never exceeds the distance on a ladder of angles down to parallel",
          "[property]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::uniform_int_distribution<int> angle(-40, 0), exponent(-20, 10);
  const auto point = [&](float size) { return Vec{size * unit(random), size * unit(random), size * unit(random)}; };
  int above = 0, loose = 0;
  for (int i = 0; i < 20000; ++i) {
    const float size = std::ldexp(1.0F, exponent(random));
    const Ends p{point(size), point(size)};
    Ends q{point(size), point(size)};
    if (i % 4 != 0) {  // near the first edge, at a small angle to it, crossing inside
      const Vec off = std::ldexp(1.0F, angle(random)) * point(size),
                turn = std::ldexp(1.0F, angle(random)) * point(size);
      q = {p.a + off - turn, p.b + off + turn};
    }
    const Distance d = edge_edge_distance(p, q);
    const double exact = searched_distance(p, q), extent = 8 * static_cast<double>(size);
    above += static_cast<double>(d.below()) > exact * (1 + 1e-12) + extent * 1e-16;
    loose += exact - static_cast<double>(d.below()) > 32 * 0x1p-24 * std::max(exact, extent);
  }
  CHECK(above == 0);
  CHECK(loose == 0);
}

TEST_CASE("closest_points: the chosen faces attain the distance of the edges, on lattices as on random points",
          "[property]") {
  std::mt19937 random(10);
  std::uniform_int_distribution<int> lattice(-3, 3);
  std::uniform_real_distribution<float> unit(-1, 1);
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto point = [&] {
      return i % 2 == 0 ? Vec{static_cast<float>(lattice(random)), static_cast<float>(lattice(random)),
                              static_cast<float>(lattice(random))}
                        : Vec{unit(random), unit(random), unit(random)};
    };
    const Ends p{point(), point()}, q{point(), point()};
    const EdgePairFeatures on = closest_edge_features(p, q);
    const double reached = points_distance(p, q, contact_parameters(p, q, on));
    wrong += std::abs(reached - edge_edge_distance(p, q).value) > 1e-9;
  }
  CHECK(wrong == 0);
}
