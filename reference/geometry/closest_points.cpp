// The distance of two segments is a convex function of two parameters. So the optimality conditions of a pair of
// features are necessary and sufficient, and each condition is the sign of one polynomial.
#include "reference/geometry/closest_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/geometry/edge_parameters.hpp"

namespace ogc::reference {
namespace {

struct Conditions {
  std::array<Condition, 4> items;
  int count = 0;
};

/// Returns the conditions under which end `i` of e and the interior of f have the closest points: the end projects
/// between f's ends, and a step from this end along e does not come nearer to f.
Conditions end_to_interior(const std::array<Vec3f, 2>& e, std::size_t i, const std::array<Vec3f, 2>& f) {
  const Vec3f& p = e[i];
  return {{Condition{along(f[0], f[1], p), true}, Condition{along(f[1], f[0], p), true},
           Condition{turn(p, e[1 - i], f[0], f[1]), false}},
          3};
}

Conditions conditions_of(const EdgePair& pair, EdgeFeatures features) {
  const auto &p = pair.first, &q = pair.second;
  const bool inside_p = features.first == EdgeFeature::interior, inside_q = features.second == EdgeFeature::interior;
  const auto i = static_cast<std::size_t>(features.first), j = static_cast<std::size_t>(features.second);
  if (inside_p && inside_q) {
    return {{Condition{turn(p[0], p[1], q[0], q[1]), true}, Condition{turn(p[1], p[0], q[0], q[1]), true},
             Condition{turn(q[0], q[1], p[0], p[1]), true}, Condition{turn(q[1], q[0], p[0], p[1]), true}},
            4};
  }
  if (inside_q) return end_to_interior(p, i, q);
  if (inside_p) return end_to_interior(q, j, p);
  return {{Condition{along(p[i], p[1 - i], q[j]), false}, Condition{along(q[j], q[1 - j], p[i]), false}}, 2};
}

bool hold(const Conditions& conditions) {
  return std::all_of(conditions.items.begin(), conditions.items.begin() + conditions.count, holds);
}

/// Returns whether some end of the second edge lies ahead of the first edge's end `from`. Ahead means in the direction
/// from this end to the first edge's other end.
Membership some_end_beyond(const EdgePair& pair, std::size_t from) {
  Membership either{false, false, false};
  for (const Vec3f& end : pair.second) {
    Membership one;
    require(one, {along(pair.first[from], pair.first[1 - from], end), true});
    either = {either.exact || one.exact, either.possible || one.possible, either.certain || one.certain};
  }
  return either;
}

Membership both(const Membership& a, const Membership& b) {
  return {a.exact && b.exact, a.possible && b.possible, a.certain && b.certain};
}

/// Returns the bit of an answer in ClosestPointsTruth::accepted.
std::uint32_t code_bit(EdgeFeatures features, bool is_parallel) {
  return 1u << (static_cast<unsigned>(features.first) + 3 * static_cast<unsigned>(features.second) +
                (is_parallel ? 9u : 0u));
}

constexpr EdgeFeatures interiors{EdgeFeature::interior, EdgeFeature::interior};

std::uint32_t accepted_codes(const EdgePair& pair, EdgeFeatures closest) {
  const Membership rule = are_nearly_parallel(pair);
  std::uint32_t codes = rule.possible ? code_bit(interiors, true) : 0u;
  if (rule.certain) return codes;
  if (are_closest(pair, closest).certain) return codes | code_bit(closest, false);
  for (int k = 0; k < edge_feature_pairs; ++k) {
    if (are_closest(pair, edge_features(k)).possible) codes |= code_bit(edge_features(k), false);
  }
  return codes;
}

bool is_near(const Conditions& conditions) {
  Nearness nearness;
  for (int k = 0; k < conditions.count; ++k) nearness.add(conditions.items[k]);
  return nearness.is_near();
}

compare::ClosestPointsTruth sized(std::size_t n) {
  compare::ClosestPointsTruth truth;
  truth.exact.first_feature.resize(n);
  truth.exact.second_feature.resize(n);
  truth.exact.nearly_parallel.resize(n);
  truth.exact.parameters.resize(n);
  truth.exact.contact_distance.resize(n);
  truth.exact.distance_below.resize(n);
  truth.accepted.resize(n);
  truth.near.resize(n);
  truth.contact_distance.resize(n);
  truth.distance.resize(n);
  truth.parameters.resize(n);
  truth.parameter_condition.resize(n);
  return truth;
}

void answer(compare::ClosestPointsTruth& truth, std::size_t i, const EdgePair& pair) {
  const EdgeFeatures closest = closest_features(pair);
  const bool is_parallel = nearly_parallel(pair);
  const EdgeFeatures features = is_parallel ? interiors : closest;
  const GapDistance gap = measure(feature_gap(pair, closest));
  const EdgeParameters parameters = is_parallel ? parallel_parameters(pair) : closest_parameters(pair, closest);
  truth.exact.first_feature[i] = features.first;
  truth.exact.second_feature[i] = features.second;
  truth.exact.nearly_parallel[i] = is_parallel;
  truth.parameters[i] = parameters.values;
  truth.parameter_condition[i] = parameters.condition;
  truth.distance[i] = gap.distance;
  truth.contact_distance[i] = is_parallel ? parameters.distance : truth.distance[i];
  truth.exact.parameters[i] = {static_cast<float>(parameters.values[0]), static_cast<float>(parameters.values[1])};
  truth.exact.contact_distance[i] = static_cast<float>(truth.contact_distance[i]);
  truth.exact.distance_below[i] = gap.below;
  truth.accepted[i] = accepted_codes(pair, closest) | code_bit(features, is_parallel);
  truth.near[i] = is_near_decision(pair, closest, is_parallel);
}

}  // namespace

bool is_near_decision(const EdgePair& pair, EdgeFeatures closest, bool is_parallel) {
  const Margin angle = parallel(pair.first[0], pair.first[1], pair.second[0], pair.second[1]);
  return examine(angle).near || (!is_parallel && is_near(conditions_of(pair, closest)));
}

EdgeFeatures closest_features(const EdgePair& pair) {
  for (int k = 0; k + 1 < edge_feature_pairs; ++k) {
    if (hold(conditions_of(pair, edge_features(k)))) return edge_features(k);
  }
  return {EdgeFeature::interior, EdgeFeature::interior};
}

Membership are_closest(const EdgePair& pair, EdgeFeatures features) {
  const Conditions conditions = conditions_of(pair, features);
  Membership membership;
  for (int k = 0; k < conditions.count && membership.possible; ++k) require(membership, conditions.items[k]);
  return membership;
}

Membership are_nearly_parallel(const EdgePair& pair) {
  const Margin margin = parallel(pair.first[0], pair.first[1], pair.second[0], pair.second[1]);
  const bool below = sign(margin) < 0, doubtful = grey(margin);
  const Membership angle{below, below || doubtful, below && !doubtful};
  if (!angle.possible) return angle;
  return both(angle, both(some_end_beyond(pair, 0), some_end_beyond(pair, 1)));
}

bool nearly_parallel(const EdgePair& pair) {
  if (sign(parallel(pair.first[0], pair.first[1], pair.second[0], pair.second[1])) >= 0) return false;
  const auto beyond = [&](std::size_t from) {
    return std::any_of(pair.second.begin(), pair.second.end(),
                       [&](const Vec3f& end) { return sign(along(pair.first[from], pair.first[1 - from], end)) > 0; });
  };
  return beyond(0) && beyond(1);
}

Margin feature_gap(const EdgePair& pair, EdgeFeatures features) {
  const auto &p = pair.first, &q = pair.second;
  const bool inside_p = features.first == EdgeFeature::interior, inside_q = features.second == EdgeFeature::interior;
  if (inside_p && inside_q) return gap_lines(p[0], p[1], q[0], q[1]);
  if (inside_q) return gap_line(q[0], q[1], p[static_cast<std::size_t>(features.first)]);
  if (inside_p) return gap_line(p[0], p[1], q[static_cast<std::size_t>(features.second)]);
  return gap_points(p[static_cast<std::size_t>(features.first)], q[static_cast<std::size_t>(features.second)]);
}

compare::ClosestPointsTruth closest_points(const compare::ClosestPointsIn& in) {
  compare::ClosestPointsTruth truth = sized(in.first.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, in.first.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        answer(truth, i, {in.first[i], in.second[i]});
                    });
  return truth;
}

}  // namespace ogc::reference
