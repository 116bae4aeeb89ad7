// The seven regions are disjoint for a triangle of positive area, and lower-dimensional ones are closed towards higher-dimensional ones, so one
// conjunction of conditions a feature decides everything; the order of the features breaks the ties of collapsed triangles.
#include "reference/geometry/closest_face.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/geometry/formulas.hpp"
#include "reference/geometry/sensitivity.hpp"

namespace ogc::reference {
namespace {

constexpr int feature_count = 7;

struct Conditions {
  std::array<Condition, 3> items;
  int count = 0;
};

/// Corner k: on or behind both planes across its edges. Edge k: between its ends, on or beyond its side plane. Interior: inside all side planes.
Conditions conditions_of(const Corners& t, TriangleFeature feature, const Vec3f& p) {
  const int f = static_cast<int>(feature);
  if (f < 3) {
    const Vec3f &a = t[f], &b = t[(f + 1) % 3], &c = t[(f + 2) % 3];
    return {{Condition{along(a, b, p), false}, Condition{along(a, c, p), false}}, 2};
  }
  if (f < 6) {
    const Vec3f &a = t[f - 3], &b = t[(f - 2) % 3], &c = t[(f - 1) % 3];
    return {{Condition{along(a, b, p), true}, Condition{along(b, a, p), true}, Condition{side(a, b, c, p), false}}, 3};
  }
  return {{Condition{side(t[0], t[1], t[2], p), true}, Condition{side(t[1], t[2], t[0], p), true}, Condition{side(t[2], t[0], t[1], p), true}}, 3};
}

bool in_region(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  const Conditions conditions = conditions_of(triangle, feature, point);
  return std::all_of(conditions.items.begin(), conditions.items.begin() + conditions.count, holds);
}

/// Margins whose shares of their sum are the weights of the feature's corners, and these corners.
struct WeightRule {
  std::array<Margin, 3> margins;
  std::array<int, 3> corners{};
  int count = 0;
};

WeightRule weight_rule(const Corners& t, TriangleFeature feature, const Vec3f& p) {
  const int f = static_cast<int>(feature);
  if (f < 3) return {{}, {f}, 1};
  if (f < 6) {
    const int a = f - 3, b = (f - 2) % 3;
    return {{along(t[b], t[a], p), along(t[a], t[b], p)}, {a, b}, 2};
  }
  return {{side(t[1], t[2], t[0], p), side(t[2], t[0], t[1], p), side(t[0], t[1], t[2], p)}, {0, 1, 2}, 3};
}

std::array<double, 3> weights_of(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  const WeightRule rule = weight_rule(triangle, feature, point);
  std::array<double, 3> weights{};
  if (rule.count == 1) {
    weights[rule.corners[0]] = 1;
    return weights;
  }
  const std::vector<double> values = shares({rule.margins.data(), static_cast<std::size_t>(rule.count)});
  for (int k = 0; k < rule.count; ++k) weights[rule.corners[k]] = values[k];
  return weights;
}

using Number = Dual<9>;

/// The point and the last two corners relative to the first corner, each coordinate an input.
std::array<Point<Number>, 4> seed(const Corners& t, const Vec3f& p) {
  const std::array<Vec3f, 3> moving{t[1], t[2], p};
  std::array<Point<Number>, 4> points{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& q = moving[k];
    points[k + 1] = {Number(static_cast<double>(q.x) - t[0].x, 3 * k), Number(static_cast<double>(q.y) - t[0].y, 3 * k + 1),
                     Number(static_cast<double>(q.z) - t[0].z, 3 * k + 2)};
  }
  return points;
}

/// Σ|∂w/∂δᵢ||δᵢ| of one weight.
double spread(const Number& weight, const std::array<Point<Number>, 4>& points) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<Number>& q = points[k + 1];
    sum += std::abs(weight.slope[3 * k] * q.x.value) + std::abs(weight.slope[3 * k + 1] * q.y.value) + std::abs(weight.slope[3 * k + 2] * q.z.value);
  }
  return sum;
}

/// The largest spread of the three weights, at least 1; infinite for a triangle of zero area.
double condition_of(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  if (!has_area(triangle)) return std::numeric_limits<double>::infinity();
  const int f = static_cast<int>(feature);
  const auto q = seed(triangle, point);
  std::array<Number, 3> parts{};
  if (f < 3) return 1;
  if (f < 6) {
    const auto &a = q[f - 3], &b = q[(f - 2) % 3];
    parts = {along(a, b, q[3]), along(b, a, q[3]), Number()};
  } else {
    parts = {side(q[0], q[1], q[2], q[3]), side(q[1], q[2], q[0], q[3]), side(q[2], q[0], q[1], q[3])};
  }
  const Number sum = parts[0] + parts[1] + parts[2];
  double worst = 1;
  for (const Number& part : parts) worst = std::max(worst, spread(part / sum, q));
  return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
}

compare::ClosestFaceTruth sized(std::size_t n) {
  compare::ClosestFaceTruth truth;
  truth.exact.feature.resize(n);
  truth.exact.weights.resize(n);
  truth.exact.distance.resize(n);
  truth.exact.distance_below.resize(n);
  truth.accepted.resize(n);
  truth.distance.resize(n);
  truth.weights.resize(n);
  truth.weight_condition.resize(n);
  return truth;
}

void answer(compare::ClosestFaceTruth& truth, std::size_t i, const Corners& triangle, const Vec3f& point) {
  const TriangleFeature feature = closest_feature(triangle, point);
  const Margin gap = feature_gap(triangle, feature, point);
  truth.exact.feature[i] = feature;
  truth.accepted[i] = possible_features(triangle, point);
  truth.distance[i] = distance(gap);
  truth.exact.distance[i] = static_cast<float>(truth.distance[i]);
  truth.exact.distance_below[i] = distance_below(gap);
  truth.weights[i] = weights_of(triangle, feature, point);
  for (std::size_t k = 0; k < 3; ++k) truth.exact.weights[i][k] = static_cast<float>(truth.weights[i][k]);
  truth.weight_condition[i] = condition_of(triangle, feature, point);
}

}  // namespace

bool has_area(const Corners& triangle) { return sign(side(triangle[0], triangle[1], triangle[2], triangle[2])) > 0; }

TriangleFeature closest_feature(const Corners& triangle, const Vec3f& point) {
  for (int f = 0; f + 1 < feature_count; ++f) {
    if (in_region(triangle, static_cast<TriangleFeature>(f), point)) return static_cast<TriangleFeature>(f);
  }
  return TriangleFeature::interior;
}

Membership is_closest(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  if (feature == TriangleFeature::interior && !has_area(triangle)) return {false, false, false};
  const Conditions conditions = conditions_of(triangle, feature, point);
  Membership membership;
  for (int k = 0; k < conditions.count && membership.possible; ++k) require(membership, conditions.items[k]);
  return membership;
}

std::uint8_t possible_features(const Corners& triangle, const Vec3f& point) {
  const TriangleFeature closest = closest_feature(triangle, point);
  const auto bit = [](int f) { return static_cast<std::uint8_t>(1u << f); };
  std::uint8_t features = bit(static_cast<int>(closest));
  if (has_area(triangle) && is_closest(triangle, closest, point).certain) return features;
  for (int f = 0; f < feature_count; ++f) {
    if (is_closest(triangle, static_cast<TriangleFeature>(f), point).possible) features |= bit(f);
  }
  return features;
}

Margin feature_gap(const Corners& t, TriangleFeature feature, const Vec3f& point) {
  const int f = static_cast<int>(feature);
  if (f < 3) return gap_points(t[f], point);
  if (f < 6) return gap_line(t[f - 3], t[(f - 2) % 3], point);
  return gap_plane(t[0], t[1], t[2], point);
}

compare::ClosestFaceTruth closest_face(const compare::ClosestFaceIn& in) {
  compare::ClosestFaceTruth truth = sized(in.point.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, in.point.size(), 256), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) answer(truth, i, in.triangle[i], in.point[i]);
  });
  return truth;
}

}  // namespace ogc::reference
