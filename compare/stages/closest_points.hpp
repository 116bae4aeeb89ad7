// Stage closest_points: the closest points of two closed edges, the faces whose interiors hold them, and the rule for
// nearly parallel edges (Alg. 2 lines 6, 9, 10; method.md §1.2 to §1.4).
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

enum class EdgeFeature : std::uint8_t { end_0, end_1, interior };  ///< of a closed edge

/// n independent cases; `first` is the lower-numbered edge. Edges of zero length are legal (during a run): the closest
/// point of such an edge is its end_0.
struct ClosestPointsIn {
  std::vector<std::array<Vec3f, 2>> first, second;  ///< by case and end [m]
};

/// `nearly_parallel`: ‖e×e'‖² < 10⁻⁶ ‖e‖² ‖e'‖² and the projection of the second edge on the line of the first overlaps
/// the first in more than a point. Then both features are interior, and the points are the middle of the overlap and
/// its projection on the (closed) second edge.
struct ClosestPointsOut {
  std::vector<EdgeFeature> first_feature, second_feature;  ///< features that hold the closest points
  std::vector<std::uint8_t> nearly_parallel;               ///< 0 or 1
  std::vector<std::array<float, 2>> parameters;            ///< of the contact points, in [0, 1] from end_0 to end_1
  std::vector<float> contact_distance;                     ///< [m], between the contact points, nearest
  std::vector<float> distance_below;                       ///< [m], never above the exact distance of the two edges
};

/// Code of an answer: first_feature + 3 · second_feature + 9 · nearly_parallel; it is accepted if bit `code` of
/// `accepted` is set.
struct ClosestPointsTruth {
  ClosestPointsOut exact;                          ///< rounded
  std::vector<std::uint32_t> accepted;             ///< bit of each accepted code
  std::vector<std::uint8_t> near;                  ///< 1 where a margin between answers lies within near_factor
  std::vector<double> contact_distance, distance;  ///< [m]
  std::vector<std::array<double, 2>> parameters;   ///< exact
  std::vector<double> parameter_condition;         ///< defined as weight_condition of closest_face
};

/// Largest errors, in units as in closest_face; the interior–interior solution has two more products in its
/// determinant.
inline constexpr double closest_points_distance_tolerance = 16;
inline constexpr double closest_points_parameter_tolerance = 16;
/// Derived as closest_face_below_tolerance: nearly parallel edges at an angle θ cost ρ S/θ by their normal, S ≤ 2 Σ|δ|,
/// or θ ‖e‖ by their ends; 2⁸ roundings in double give √ρ = 2.9 u at the best change-over, 2 √ρ S = 12 u Σ|δ|; twice
/// that for the kernel, and a third for the two products.
inline constexpr double closest_points_below_tolerance = 32;

}  // namespace ogc::compare
