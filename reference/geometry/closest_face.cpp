// The regions of a triangle of positive area are disjoint: a point on a common boundary belongs to the region of lower
// dimension. So one conjunction of conditions for each feature decides whether the feature is closest. If the triangle
// is collapsed, several conjunctions may hold; the first feature wins.
#include "reference/geometry/closest_face.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/geometry/formulas.hpp"

namespace ogc::reference {
namespace {

constexpr int feature_count = 7;

/// Holds the nine margins that separate the regions, and computes each at most once. The sign of a margin tells where
/// the point lies relative to edge k:
///
///  margin k      > 0: ahead of the edge's first end, in the direction of the edge
///  margin 3 + k  > 0: ahead of the edge's second end, in the opposite direction
///  margin 6 + k  > 0: on the inner side of the edge's side plane
class Regions {
 public:
  Regions(const Corners& triangle, const Vec3f& point) : corners_(triangle), point_(point) {}

  const MarginAnswer& margin(int number) const {
    auto& known = margins_[static_cast<std::size_t>(number)];
    if (!known) {
      const int k = number % 3;
      const Vec3f &a = corners_[k], &b = corners_[(k + 1) % 3], &c = corners_[(k + 2) % 3];
      known = examine(number < 3 ? along(a, b, point_) : number < 6 ? along(b, a, point_) : side(a, b, c, point_));
    }
    return *known;
  }

  /// The conditions of a feature's region. Corner k: on both edges from corner k, the point does not lie ahead of the
  /// corner. Edge k: the point lies between the edge's ends and on or beyond the edge's side plane. Interior: the point
  /// lies inside all side planes.
  struct Conditions {
    std::array<int, 3> margins{};
    std::array<bool, 3> positive{};
    int count = 0;
  };
  static Conditions conditions_of(int feature) {
    if (feature < 3) return {{feature, 3 + (feature + 2) % 3}, {false, false}, 2};
    if (feature < 6) return {{feature - 3, feature, feature + 3}, {true, true, false}, 3};
    return {{6, 7, 8}, {true, true, true}, 3};
  }

  bool holds(int feature) const {
    const Conditions conditions = conditions_of(feature);
    for (int k = 0; k < conditions.count; ++k)
      if ((margin(conditions.margins[k]).sign > 0) != conditions.positive[k]) return false;
    return true;
  }

  Membership membership(int feature) const {
    const Conditions conditions = conditions_of(feature);
    Membership membership;
    for (int k = 0; k < conditions.count && membership.possible; ++k) {
      const MarginAnswer& m = margin(conditions.margins[k]);
      require(membership, (m.sign > 0) == conditions.positive[k], m.grey);
    }
    return membership;
  }

  bool is_near(int feature) const {
    const Conditions conditions = conditions_of(feature);
    return std::any_of(conditions.margins.begin(), conditions.margins.begin() + conditions.count,
                       [&](int number) { return margin(number).near; });
  }

  int closest() const {
    for (int f = 0; f + 1 < feature_count; ++f)
      if (holds(f)) return f;
    return feature_count - 1;
  }

  std::uint8_t possible(int closest, bool area) const {
    const auto bit = [](int f) { return static_cast<std::uint8_t>(1u << f); };
    std::uint8_t features = bit(closest);
    if (area && membership(closest).certain) return features;
    for (int f = 0; f < feature_count; ++f)
      if ((area || f + 1 < feature_count) && membership(f).possible) features |= bit(f);
    return features;
  }

 private:
  const Corners& corners_;
  const Vec3f& point_;
  mutable std::array<std::optional<MarginAnswer>, 9> margins_;
};

/// Returns for each corner the index of the margin that is proportional to the corner's weight; −1 if the weight is 0.
std::array<int, 3> weight_margins(int f) {
  if (f == 6) return {7, 8, 6};
  std::array<int, 3> margins{-1, -1, -1};
  margins[f - 3] = f;
  margins[(f - 2) % 3] = f - 3;
  return margins;
}

/// Returns the weights in exact numbers, for cases that double does not resolve.
std::array<double, 3> exact_weights(const Corners& t, int f, const Vec3f& p) {
  std::array<double, 3> weights{};
  if (f == 6) {
    const std::array margins{side(t[1], t[2], t[0], p), side(t[2], t[0], t[1], p), side(t[0], t[1], t[2], p)};
    const std::vector<double> values = shares(margins);
    return {values[0], values[1], values[2]};
  }
  const int a = f - 3, b = (f - 2) % 3;
  const std::array margins{along(t[b], t[a], p), along(t[a], t[b], p)};
  const std::vector<double> values = shares(margins);
  weights[a] = values[0];
  weights[b] = values[1];
  return weights;
}

/// Weights in double precision, with the limit of their error.
struct Weights {
  std::array<double, 3> values{};
  double error = 0;
};

Weights weights_of(const Regions& regions, int feature) {
  Weights weights;
  if (feature < 3) {
    weights.values[feature] = 1;
    return weights;
  }
  const std::array<int, 3> margins = weight_margins(feature);
  double sum = 0, error = 0;
  for (const int number : margins) {
    if (number < 0) continue;
    sum += regions.margin(number).value;
    error += regions.margin(number).error;
  }
  if (!(error <= 0.25 * sum)) return {{}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k)
    if (margins[k] >= 0) weights.values[k] = std::max(0.0, regions.margin(margins[k]).value / sum);
  // A weight is m/Σ, where m is one margin and Σ is the sum of the margins. Let e and Σe be the error of m and the sum
  // of all errors. Then the weight has an error of at most (e + m/Σ Σe)/(Σ − Σe). The term 2⁻⁵¹ covers three roundings.
  weights.error = 3 * error / sum + 0x1p-51;
  return weights;
}

using Vector = Point<double>;

Vector between(const Vec3f& from, const Vec3f& to) {
  return {double{to.x} - from.x, double{to.y} - from.y, double{to.z} - from.z};
}
Vector combined(double s, const Vector& a, double t, const Vector& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

double spread(const Vector& slope, const Vector& delta) {
  return std::abs(slope.x * delta.x) + std::abs(slope.y * delta.y) + std::abs(slope.z * delta.z);
}

/// Returns Σ|∂w/∂δ||δ| for the weight w of b on the edge e = b − a, w‖e‖² = (p − a)·e. The coordinates δ are relative
/// to `origin`. ∂w/∂p = e/‖e‖², ∂w/∂b = (p − a − 2 w e)/‖e‖², ∂w/∂a = −∂w/∂p − ∂w/∂b.
double edge_spread(const Vec3f& a, const Vec3f& b, const Vec3f& p, const Vec3f& origin) {
  const Vector e = between(a, b), x = between(a, p);
  const double squared = dot(e, e), w = dot(x, e) / squared;
  const Vector by_p = combined(1 / squared, e, 0, e), by_b = combined(1 / squared, x, -2 * w / squared, e);
  return spread(by_p, between(origin, p)) + spread(by_b, between(origin, b)) +
         spread(combined(-1, by_p, -1, by_b), between(origin, a));
}

/// Returns the largest Σ|∂w/∂δ||δ| of the three weights. With p = Σ w_i t_i + η n, n = e₁ × e₂ and g_k = ∂w_k/∂p:
/// ∂w_k/∂t₁ = −w₁ g_k − η e₂ × g_k and ∂w_k/∂t₂ = −w₂ g_k − η g_k × e₁. The coordinates δ are relative to t₀.
double interior_spread(const Corners& t, const Vec3f& p, const std::array<double, 3>& w) {
  const Vector e1 = between(t[0], t[1]), e2 = between(t[0], t[2]), x = between(t[0], p), n = cross(e1, e2);
  const double squared = dot(n, n), eta = dot(x, n) / squared;
  const Vector g1 = cross(e2, n), g2 = cross(n, e1);
  double worst = 0;
  for (const Vector& unscaled : {combined(-1, g1, -1, g2), g1, g2}) {
    const Vector g = combined(1 / squared, unscaled, 0, unscaled);
    worst = std::max(worst, spread(g, x) + spread(combined(-w[1], g, -eta, cross(e2, g)), e1) +
                                spread(combined(-w[2], g, -eta, cross(g, e1)), e2));
  }
  return worst;
}

/// Returns the largest Σ|∂w/∂δᵢ||δᵢ| of the three weights, at least 1; infinite for a triangle of zero area.
double condition_of(const Corners& t, int feature, const Vec3f& point, const std::array<double, 3>& weights,
                    bool area) {
  if (!area) return std::numeric_limits<double>::infinity();
  if (feature < 3) return 1;
  const double worst = feature < 6 ? edge_spread(t[feature - 3], t[(feature - 2) % 3], point, t[0])
                                   : interior_spread(t, point, weights);
  return std::isfinite(worst) ? std::max(1.0, worst) : std::numeric_limits<double>::infinity();
}

compare::ClosestFaceTruth sized(std::size_t n) {
  compare::ClosestFaceTruth truth;
  truth.exact.feature.resize(n);
  truth.exact.weights.resize(n);
  truth.exact.distance.resize(n);
  truth.exact.distance_below.resize(n);
  truth.accepted.resize(n);
  truth.near.resize(n);
  truth.distance.resize(n);
  truth.weights.resize(n);
  truth.weight_condition.resize(n);
  return truth;
}

void answer(compare::ClosestFaceTruth& truth, std::size_t i, const Corners& triangle, const Vec3f& point) {
  const Regions regions(triangle, point);
  const int closest = regions.closest();
  const auto feature = static_cast<TriangleFeature>(closest);
  const bool area = has_area(triangle);
  const GapDistance gap = measure(feature_gap(triangle, feature, point));
  truth.exact.feature[i] = feature;
  truth.accepted[i] = regions.possible(closest, area);
  truth.near[i] = regions.is_near(closest);
  truth.distance[i] = gap.distance;
  truth.exact.distance[i] = static_cast<float>(gap.distance);
  truth.exact.distance_below[i] = gap.below;
  const Weights weights = weights_of(regions, closest);
  const double condition = condition_of(triangle, closest, point, weights.values, area);
  truth.weights[i] = weights.error <= 0x1p-40 * (area ? condition : 1) ? weights.values
                                                                       : exact_weights(triangle, closest, point);
  for (std::size_t k = 0; k < 3; ++k) truth.exact.weights[i][k] = static_cast<float>(truth.weights[i][k]);
  truth.weight_condition[i] = condition;
}

}  // namespace

bool has_area(const Corners& triangle) { return sign(side(triangle[0], triangle[1], triangle[2], triangle[2])) > 0; }

TriangleFeature closest_feature(const Corners& triangle, const Vec3f& point) {
  return static_cast<TriangleFeature>(Regions(triangle, point).closest());
}

Membership is_closest(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  if (feature == TriangleFeature::interior && !has_area(triangle)) return {false, false, false};
  return Regions(triangle, point).membership(static_cast<int>(feature));
}

std::uint8_t possible_features(const Corners& triangle, const Vec3f& point) {
  const Regions regions(triangle, point);
  return regions.possible(regions.closest(), has_area(triangle));
}

bool near_feature(const Corners& triangle, TriangleFeature feature, const Vec3f& point) {
  return Regions(triangle, point).is_near(static_cast<int>(feature));
}

Margin feature_gap(const Corners& t, TriangleFeature feature, const Vec3f& point) {
  const int f = static_cast<int>(feature);
  if (f < 3) return gap_points(t[f], point);
  if (f < 6) return gap_line(t[f - 3], t[(f - 2) % 3], point);
  return gap_plane(t[0], t[1], t[2], point);
}

compare::ClosestFaceTruth closest_face(const compare::ClosestFaceIn& in) {
  compare::ClosestFaceTruth truth = sized(in.point.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, in.point.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        answer(truth, i, in.triangle[i], in.point[i]);
                    });
  return truth;
}

}  // namespace ogc::reference
