// Tests closest_points: values derived by hand for each pair of features, and for parallel, nearly parallel and
// zero-length edges.
#include "reference/geometry/closest_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using compare::ClosestPointsIn;
using compare::EdgeFeature;
using compare::Vec3f;
using Ends = std::array<Vec3f, 2>;

namespace {

constexpr EdgeFeature end_0 = EdgeFeature::end_0, end_1 = EdgeFeature::end_1, interior = EdgeFeature::interior;

compare::ClosestPointsTruth ask(const Ends& first, const Ends& second) {
  ClosestPointsIn in;
  in.first = {first};
  in.second = {second};
  return reference::closest_points(in);
}

struct Case {
  Ends second;
  EdgeFeature first_feature, second_feature;
  std::array<double, 2> parameters;
  double distance;
};

// The first edge goes from (0,0,0) to (4,0,0).
const Ends edge{Vec3f{0, 0, 0}, Vec3f{4, 0, 0}};
const std::vector<Case> cases{
    {{Vec3f{1, -1, 2}, Vec3f{1, 3, 2}}, interior, interior, {0.25, 0.25}, 2},
    {{Vec3f{-3, -1, 4}, Vec3f{-3, 3, 4}}, end_0, interior, {0, 0.25}, 5},
    {{Vec3f{7, -1, 4}, Vec3f{7, 3, 4}}, end_1, interior, {1, 0.25}, 5},
    {{Vec3f{1, 3, 4}, Vec3f{1, 9, 4}}, interior, end_0, {0.25, 0}, 5},
    {{Vec3f{1, 9, 4}, Vec3f{1, 3, 4}}, interior, end_1, {0.25, 1}, 5},
    {{Vec3f{7, 0, 4}, Vec3f{9, 1, 4}}, end_1, end_0, {1, 0}, 5},
    {{Vec3f{-9, 1, 4}, Vec3f{-3, 0, 4}}, end_0, end_1, {0, 1}, 5},
    // This pair lies on the plane between the interior and end_0 of the first edge.
    {{Vec3f{0, -1, 3}, Vec3f{0, 3, 3}}, end_0, interior, {0, 0.25}, 3},
    {{Vec3f{1, 0, 3}, Vec3f{1, 3, 3}}, interior, end_0, {0.25, 0}, 3},  // the same for the second edge
    {{Vec3f{4, 0, 3}, Vec3f{4, 3, 3}}, end_1, end_0, {1, 0}, 3},        // for both edges
    {{Vec3f{4, 3, 4}, Vec3f{8, 3, 4}}, end_1, end_0, {1, 0}, 5},        // parallel, projections share one point
    {{Vec3f{7, 0, 4}, Vec3f{9, 0, 4}}, end_1, end_0, {1, 0}, 5},        // parallel, projections apart
    {{Vec3f{1, 3, 4}, Vec3f{1, 3, 4}}, interior, end_0, {0.25, 0}, 5},  // zero length
    {{Vec3f{7, 0, 4}, Vec3f{7, 0, 4}}, end_1, end_0, {1, 0}, 5},
};

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

double distance_at(const Ends& e, double s, const Ends& f, double t) {
  const auto at = [](double a, double b, double k) { return a + k * (b - a); };
  return length(at(e[0].x, e[1].x, s) - at(f[0].x, f[1].x, t), at(e[0].y, e[1].y, s) - at(f[0].y, f[1].y, t),
                at(e[0].z, e[1].z, s) - at(f[0].z, f[1].z, t));
}

/// Returns an edge with this slope that crosses above the middle of an edge along x.
Ends sloped(float slope) { return {Vec3f{-1, -slope, 0.5f}, Vec3f{1, slope, 0.5f}}; }

}  // namespace

TEST_CASE("closest_points: every pair of features, with the edges in both roles and directions", "[unit]") {
  const auto flipped = [](EdgeFeature f) { return f == interior ? f : f == end_0 ? end_1 : end_0; };
  for (const Case& c : cases) {
    CAPTURE(c.second[0].x, c.second[0].y, c.second[0].z);
    const auto truth = ask(edge, c.second);
    CHECK(truth.exact.first_feature[0] == c.first_feature);
    CHECK(truth.exact.second_feature[0] == c.second_feature);
    CHECK(truth.exact.nearly_parallel[0] == 0);
    CHECK(truth.parameters[0] == c.parameters);
    CHECK(truth.distance[0] == c.distance);
    CHECK(truth.contact_distance[0] == c.distance);
    CHECK(truth.exact.distance_below[0] == static_cast<float>(c.distance));
    const auto swapped = ask(c.second, edge);
    CHECK(swapped.exact.first_feature[0] == c.second_feature);
    CHECK(swapped.exact.second_feature[0] == c.first_feature);
    CHECK(swapped.distance[0] == c.distance);
    const auto reversed = ask({edge[1], edge[0]}, c.second);
    CHECK(reversed.exact.first_feature[0] == flipped(c.first_feature));
    CHECK(reversed.exact.second_feature[0] == c.second_feature);
  }
}

TEST_CASE("closest_points: parallel edges that overlap meet in the middle of the overlap", "[unit]") {
  // The overlap is [2, 4] on the first edge. The middle of the overlap has s = 0.75 on the first edge and t = (3 − 2)/4
  // on the second.
  const auto truth = ask(edge, {Vec3f{2, 3, 4}, Vec3f{6, 3, 4}});
  CHECK(truth.exact.nearly_parallel[0] == 1);
  CHECK(truth.exact.first_feature[0] == interior);
  CHECK(truth.exact.second_feature[0] == interior);
  CHECK(truth.parameters[0] == std::array<double, 2>{0.75, 0.25});
  CHECK(truth.contact_distance[0] == 5);
  CHECK(truth.distance[0] == 5);
  const auto reversed = ask(edge, {Vec3f{6, 3, 4}, Vec3f{2, 3, 4}});
  CHECK(reversed.parameters[0] == std::array<double, 2>{0.75, 0.75});
}

TEST_CASE("closest_points: the limit between nearly parallel and not is 10⁻⁶ of the squared sine", "[unit]") {
  // For edges (2,0,0) and (2, 2y, 0), sin² = y²/(1 + y²); it is < 10⁻⁶ if y < 10⁻³ (1 + 5·10⁻⁷).
  const Ends first{Vec3f{-1, 0, 0}, Vec3f{1, 0, 0}};
  CHECK(ask(first, sloped(0.001f)).exact.nearly_parallel[0] == 1);
  CHECK(ask(first, sloped(0.0010001f)).exact.nearly_parallel[0] == 0);
  CHECK(ask(first, sloped(0.0009f)).exact.nearly_parallel[0] == 1);
  const auto crossing = ask(first, sloped(0.0011f));
  CHECK(crossing.exact.first_feature[0] == interior);
  CHECK(crossing.exact.second_feature[0] == interior);
  CHECK(crossing.distance[0] == 0.5);
}

TEST_CASE("closest_points: a nearly parallel pair keeps its true distance beside that of the contact points",
          "[unit]") {
  // Edges of slope 10⁻⁴ cross at x = −1/2 above the first edge; their true distance is 1/2. At x = 0, the middle of the
  // overlap, the second edge is 5·10⁻⁵ to the side.
  const Ends first{Vec3f{-1, 0, 0}, Vec3f{1, 0, 0}};
  const float slope = 1e-4f;
  const auto truth = ask(first, {Vec3f{-1, -0.5f * slope, 0.5f}, Vec3f{1, 1.5f * slope, 0.5f}});
  CHECK(truth.exact.nearly_parallel[0] == 1);
  CHECK(truth.distance[0] == 0.5);
  CHECK(truth.contact_distance[0] == Approx(std::sqrt(0.25 + 0.25e-8)).epsilon(1e-12));
  CHECK(truth.parameters[0][0] == 0.5);
}

TEST_CASE("closest_points: crossing interiors keep the exact distance down a ladder of angles", "[unit]") {
  const Ends first{Vec3f{-1, 0, 0}, Vec3f{1, 0, 0}};
  for (int k = 1; k <= 12; ++k) {
    const auto truth = ask(first, sloped(std::pow(10.0f, static_cast<float>(-k))));
    CAPTURE(k);
    CHECK(truth.distance[0] == 0.5);
    CHECK(truth.exact.distance_below[0] == 0.5f);
  }
}

TEST_CASE(
    "closest_points: no two points are nearer, parameters reach the distance, distance_below is the float just below "
    "it",
    "[property]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-20, 10), coordinate(-1, 1), share(0, 1);
  ClosestPointsIn in;
  for (int i = 0; i < 4000; ++i) {
    const float scale = std::exp2(exponent(random)), slope = i % 2 == 0 ? 1 : std::exp2(exponent(random));
    const auto draw = [&] {
      return Vec3f{scale * coordinate(random), scale * coordinate(random), scale * coordinate(random)};
    };
    const Vec3f a = draw(), b = draw(), c = draw(), d = draw();
    in.first.push_back({a, b});
    // Every second pair is parallel up to `slope`.
    in.second.push_back(
        {c, i % 2 == 0 ? d : Vec3f{c.x + b.x - a.x + slope * d.x, c.y + b.y - a.y + slope * d.y, c.z + b.z - a.z}});
  }
  const auto truth = reference::closest_points(in);
  for (std::size_t i = 0; i < in.first.size(); ++i) {
    CAPTURE(i);
    const Ends &e = in.first[i], &f = in.second[i];
    const auto [s, t] = truth.parameters[i];
    const double d = truth.distance[i],
                 size = std::abs(e[0].x) + std::abs(e[1].x) + std::abs(f[0].x) + std::abs(f[1].x) + d;
    CHECK((s >= 0 && s <= 1 && t >= 0 && t <= 1));
    CHECK(std::abs(distance_at(e, s, f, t) - truth.contact_distance[i]) <= 1e-13 * size);
    CHECK(truth.contact_distance[i] >= d * (1 - 1e-15));
    for (int k = 0; k < 20; ++k) CHECK(distance_at(e, share(random), f, share(random)) >= d - 1e-14 * size);
    const float below = truth.exact.distance_below[i];
    CHECK(static_cast<double>(below) <= d * (1 + 0x1p-52));
    CHECK(static_cast<double>(std::nextafter(below, std::numeric_limits<float>::infinity())) > d * (1 - 0x1p-52));
  }
}

TEST_CASE("closest_points: next to a boundary both answers are accepted, away from it only one", "[unit]") {
  const auto code = [](EdgeFeature f, EdgeFeature g, unsigned parallel_rule) {
    return 1u << (static_cast<unsigned>(f) + 3 * static_cast<unsigned>(g) + 9 * parallel_rule);
  };
  // The second edge lies in the plane x + y = 8 through end_1 = (4,4,0), up to one unit in the last place of a
  // coordinate; 8 − 5.1 and 8 − 5.7 are exact.
  const Ends diagonal{Vec3f{0, 0, 0}, Vec3f{4, 4, 0}};
  const auto nudged = [&](float x) { return ask(diagonal, {Vec3f{x, 8 - 5.1f, 2}, Vec3f{8 - 5.7f, 5.7f, 2}}); };
  const auto inside = nudged(std::nextafter(5.1f, 0.0f)), on = nudged(5.1f),
             outside = nudged(std::nextafter(5.1f, 9.0f)), away = nudged(5.2f);
  CHECK(inside.exact.first_feature[0] == interior);
  CHECK(on.exact.first_feature[0] == end_1);
  CHECK(outside.exact.first_feature[0] == end_1);
  for (const auto& truth : {inside, on, outside})
    CHECK(truth.accepted[0] == (code(end_1, interior, 0) | code(interior, interior, 0)));
  CHECK(away.accepted[0] == code(end_1, interior, 0));
  const auto limit = ask({Vec3f{-1, 0, 0}, Vec3f{1, 0, 0}}, {Vec3f{-1, -0.001f, 0.5f}, Vec3f{1, 0.001f, 0.5f}});
  CHECK(limit.accepted[0] == (code(interior, interior, 1) | code(interior, interior, 0)));
}
