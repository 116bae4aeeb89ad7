// Stage closest_points: decides which points of two closed edges are closest, by optimality conditions (Alg. 2;
// method.md §1.2 to §1.4).
#pragma once

#include <array>

#include "compare/stages/closest_points.hpp"
#include "reference/geometry/conditions.hpp"

namespace ogc::reference {

using compare::EdgeFeature;

/// Two edges; `first` is the lower-numbered one.
struct EdgePair {
  std::array<Vec3f, 2> first, second;  ///< by end [m]
};

/// The features, end or interior, that hold the closest points of two edges.
struct EdgeFeatures {
  /// feature of the first edge, of the second edge
  EdgeFeature first = EdgeFeature::end_0, second = EdgeFeature::end_0;
  friend bool operator==(const EdgeFeatures&, const EdgeFeatures&) = default;
};

/// Number of pairs of features. Features are ordered end_0, end_1, interior; the first closest pair wins ties.
inline constexpr int edge_feature_pairs = 9;
/// Returns the pair of features with this index, below edge_feature_pairs.
inline EdgeFeatures edge_features(int number) {
  return {static_cast<EdgeFeature>(number / 3), static_cast<EdgeFeature>(number % 3)};
}

/// Returns the features that hold the closest points, without the rule for nearly parallel edges. They are unique
/// unless the edges are exactly parallel; then the first pair in the order of edge_features is returned. An edge of
/// length zero counts as its end_0.
EdgeFeatures closest_features(const EdgePair& pair);

/// Returns whether the features are the closest ones:
///
/// - `exact`: in exact numbers
/// - `possible`: if grey conditions may flip
/// - `certain`: even if grey conditions flip. Then no other pair of features is possible, except the other end of the
///   overlap of exactly parallel edges.
Membership are_closest(const EdgePair& pair, EdgeFeatures features);

/// Returns whether the edges e and e' are nearly parallel: ‖e×e'‖² < 10⁻⁶‖e‖²‖e'‖², and the second edge, projected on
/// the line of the first edge, overlaps the first edge in more than a point.
Membership are_nearly_parallel(const EdgePair& pair);
/// Returns whether are_nearly_parallel holds exactly.
bool nearly_parallel(const EdgePair& pair);

/// Returns whether a margin that decides the closest points is near 0 (compare::near_factor): the margin of the rule
/// for nearly parallel edges or, if the rule does not hold, a margin of the closest features' region.
bool is_near_decision(const EdgePair& pair, EdgeFeatures closest, bool is_parallel);

/// Returns the gap d² − r² with r = 0 (see with_radius), where d is the distance between the two features. An interior
/// counts as the edge's whole line. For the closest features, d is the distance of the edges.
Margin feature_gap(const EdgePair& pair, EdgeFeatures features);

/// Returns the truth of all cases; computes them in parallel.
compare::ClosestPointsTruth closest_points(const compare::ClosestPointsIn& in);

}  // namespace ogc::reference
