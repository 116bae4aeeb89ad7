// Tests closest_face: values derived by hand on one triangle in all orders of its vertices, planes between features,
// collapsed triangles, needles.
#include "reference/geometry/closest_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using compare::ClosestFaceIn;
using compare::TriangleFeature;
using compare::Vec3f;
using reference::Corners;

namespace {

// The corners are a = (0,0,0), b = (4,0,0), c = (0,4,0).
const Corners triangle{Vec3f{0, 0, 0}, Vec3f{4, 0, 0}, Vec3f{0, 4, 0}};

struct Case {
  Vec3f point;
  TriangleFeature feature;
  double distance;
  std::array<double, 3> weights;
};

// Points strictly inside each region, then on each plane between two regions (the lower-dimensional feature wins), then
// on three planes at once.
const std::vector<Case> cases{
    {{1, 1, 3}, TriangleFeature::interior, 3, {0.5, 0.25, 0.25}},
    {{-1, -2, 2}, TriangleFeature::corner_0, 3, {1, 0, 0}},
    {{6, -1, 2}, TriangleFeature::corner_1, 3, {0, 1, 0}},
    {{-1, 6, 2}, TriangleFeature::corner_2, 3, {0, 0, 1}},
    {{1, -3, 4}, TriangleFeature::edge_01, 5, {0.75, 0.25, 0}},
    {{4, 4, 1}, TriangleFeature::edge_12, 3, {0, 0.5, 0.5}},
    {{-3, 1, 4}, TriangleFeature::edge_20, 5, {0.75, 0, 0.25}},
    {{1, 0, 5}, TriangleFeature::edge_01, 5, {0.75, 0.25, 0}},  // interior | edge_01
    {{2, 2, 3}, TriangleFeature::edge_12, 3, {0, 0.5, 0.5}},    // interior | edge_12
    {{0, 1, 6}, TriangleFeature::edge_20, 6, {0.75, 0, 0.25}},  // interior | edge_20
    {{0, -3, 4}, TriangleFeature::corner_0, 5, {1, 0, 0}},      // edge_01 | corner_0
    {{-3, 0, 4}, TriangleFeature::corner_0, 5, {1, 0, 0}},      // edge_20 | corner_0
    {{4, -3, 4}, TriangleFeature::corner_1, 5, {0, 1, 0}},      // edge_01 | corner_1
    {{6, 2, 1}, TriangleFeature::corner_1, 3, {0, 1, 0}},       // edge_12 | corner_1
    {{-3, 4, 4}, TriangleFeature::corner_2, 5, {0, 0, 1}},      // edge_20 | corner_2
    {{2, 6, 1}, TriangleFeature::corner_2, 3, {0, 0, 1}},       // edge_12 | corner_2
    {{0, 0, 7}, TriangleFeature::corner_0, 7, {1, 0, 0}},
    {{4, 0, 7}, TriangleFeature::corner_1, 7, {0, 1, 0}},
    {{0, 0, 0}, TriangleFeature::corner_0, 0, {1, 0, 0}},
    {{1, 1, 0}, TriangleFeature::interior, 0, {0.5, 0.25, 0.25}},
};

/// Returns the feature of the permuted triangle (t[order[0]], …) that has the same points as `feature` of t.
TriangleFeature renamed(TriangleFeature feature, const std::array<std::size_t, 3>& order) {
  const auto place = [&](std::size_t corner) {
    return static_cast<int>(std::find(order.begin(), order.end(), corner) - order.begin());
  };
  const auto f = static_cast<std::size_t>(feature);
  if (f < 3) return static_cast<TriangleFeature>(place(f));
  if (f == 6) return feature;
  const int a = place(f - 3), b = place((f - 2) % 3);
  return static_cast<TriangleFeature>(3 + ((a + 1) % 3 == b ? a : b));
}

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

/// Returns the distance from p to the point with these weights.
double distance_at(const Corners& t, const std::array<double, 3>& w, const Vec3f& p) {
  return length(w[0] * t[0].x + w[1] * t[1].x + w[2] * t[2].x - p.x,
                w[0] * t[0].y + w[1] * t[1].y + w[2] * t[2].y - p.y,
                w[0] * t[0].z + w[1] * t[1].z + w[2] * t[2].z - p.z);
}

}  // namespace

TEST_CASE("closest_face: every region and every plane between two, in all six vertex orders", "[unit]") {
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    for (const Case& c : cases) {
      ClosestFaceIn in;
      in.point = {c.point};
      in.triangle = {{triangle[order[0]], triangle[order[1]], triangle[order[2]]}};
      const auto truth = reference::closest_face(in);
      CAPTURE(c.point.x, c.point.y, c.point.z, order[0], order[1]);
      CHECK(truth.exact.feature[0] == renamed(c.feature, order));
      CHECK(truth.distance[0] == c.distance);
      CHECK(truth.exact.distance_below[0] == static_cast<float>(c.distance));
      for (std::size_t k = 0; k < 3; ++k) CHECK(truth.weights[0][k] == c.weights[order[k]]);
      CHECK((truth.accepted[0] >> static_cast<unsigned>(truth.exact.feature[0]) & 1) == 1);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("closest_face: the smallest step across a plane changes the feature, and both answers are accepted",
          "[unit]") {
  // The plane between the interior and edge_12 passes through (1.1, 2.9, z). One unit in the last place of x moves the
  // point to either side.
  const Corners t{Vec3f{0, 0, 0}, Vec3f{4, 0, 0}, Vec3f{0, 4, 0}};
  const float y = 2.9f, on = 4 - y;  // exact: 4 − y needs fewer digits than y
  ClosestFaceIn in;
  in.point = {{std::nextafter(on, 0.0f), y, 1}, {on, y, 1}, {std::nextafter(on, 9.0f), y, 1}, {on - 0.01f, y, 1}};
  in.triangle.assign(4, t);
  const auto truth = reference::closest_face(in);
  CHECK(truth.exact.feature[0] == TriangleFeature::interior);
  CHECK(truth.exact.feature[1] == TriangleFeature::edge_12);
  CHECK(truth.exact.feature[2] == TriangleFeature::edge_12);
  constexpr std::uint8_t both = 1u << 6 | 1u << 4;
  for (std::size_t i = 0; i < 3; ++i) CHECK(truth.accepted[i] == both);
  CHECK(truth.accepted[3] == 1u << 6);
}

TEST_CASE("closest_face: a collapsed triangle gives corners and edges, never its interior", "[unit]") {
  const Vec3f a{0, 0, 0}, b{4, 0, 0}, middle{1, 0, 0};
  ClosestFaceIn in;
  const auto add = [&](const Corners& t, const Vec3f& p) {
    in.triangle.push_back(t);
    in.point.push_back(p);
  };
  add({a, b, middle}, {2, 3, 4});   // next to the common part of edges 01 and 12: the lower-numbered edge
  add({a, b, middle}, {1, 3, 4});   // right next to the middle corner
  add({a, b, middle}, {-3, 0, 4});  // beyond an end
  add({a, a, b}, {2, 3, 4});        // two corners coincide: edge 12 is the lowest with positive length
  add({a, a, b}, {-3, 0, 4});
  add({b, b, b}, {4, 3, 4});
  const auto truth = reference::closest_face(in);
  const std::array<TriangleFeature, 6> features{TriangleFeature::edge_01,  TriangleFeature::corner_2,
                                                TriangleFeature::corner_0, TriangleFeature::edge_12,
                                                TriangleFeature::corner_0, TriangleFeature::corner_0};
  for (std::size_t i = 0; i < features.size(); ++i) {
    CAPTURE(i);
    CHECK(truth.exact.feature[i] == features[i]);
    CHECK(truth.distance[i] == 5);
    CHECK((truth.accepted[i] & 1u << 6) == 0);
    CHECK(std::isinf(truth.weight_condition[i]));
  }
}

TEST_CASE(
    "closest_face: no point of the triangle is nearer, weights reach the distance, distance_below is the float just "
    "below it",
    "[property]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-20, 10), coordinate(-1, 1), share(0, 1);
  ClosestFaceIn in;
  for (int i = 0; i < 4000; ++i) {
    const float scale = std::exp2(exponent(random)), flat = std::exp2(exponent(random) / 2 - 5);
    const auto draw = [&](float height) {
      return Vec3f{scale * coordinate(random), scale * coordinate(random), scale * height * coordinate(random)};
    };
    const Vec3f a = draw(1), along = draw(1);
    // Every second triangle is a needle: its third corner lies almost on the line of the other two.
    const float s = share(random);
    const Vec3f needle{a.x + s * along.x + flat * scale * coordinate(random), a.y + s * along.y, a.z + s * along.z};
    in.triangle.push_back({a, {a.x + along.x, a.y + along.y, a.z + along.z}, i % 2 == 0 ? draw(1) : needle});
    in.point.push_back(draw(flat));
  }
  const auto truth = reference::closest_face(in);
  for (std::size_t i = 0; i < in.point.size(); ++i) {
    CAPTURE(i);
    const Corners& t = in.triangle[i];
    const auto& w = truth.weights[i];
    const double d = truth.distance[i], size = std::abs(t[0].x) + std::abs(t[1].x) + std::abs(in.point[i].x) + d;
    CHECK(std::min({w[0], w[1], w[2]}) >= 0);
    CHECK(w[0] + w[1] + w[2] == Approx(1).epsilon(1e-14));
    CHECK(distance_at(t, w, in.point[i]) - d <= 1e-14 * size);
    for (int k = 0; k < 20; ++k) {
      const double u = share(random), v = share(random) * (1 - u);
      CHECK(distance_at(t, {u, v, 1 - u - v}, in.point[i]) >= d - 1e-14 * size);
    }
    const float below = truth.exact.distance_below[i];
    CHECK(static_cast<double>(below) <= d * (1 + 0x1p-52));
    CHECK(static_cast<double>(std::nextafter(below, std::numeric_limits<float>::infinity())) > d * (1 - 0x1p-52));
    CHECK(truth.weight_condition[i] >= 1);
  }
}

TEST_CASE("closest_face: random cases are hardly ever grey", "[property]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> coordinate(0, 1);
  const auto draw = [&] { return Vec3f{coordinate(random), coordinate(random), coordinate(random)}; };
  ClosestFaceIn in;
  for (int i = 0; i < 100000; ++i) {
    in.point.push_back(draw());
    in.triangle.push_back({draw(), draw(), draw()});
  }
  const auto truth = reference::closest_face(in);
  const auto grey = std::count_if(truth.accepted.begin(), truth.accepted.end(),
                                  [](unsigned bits) { return (bits & (bits - 1)) != 0; });
  CHECK(grey <= 10);
}
