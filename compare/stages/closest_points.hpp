// Stage closest_points: the closest points of two closed edges, the faces whose interiors hold them, and the rule for
// nearly parallel edges (Alg. 2 lines 6, 9, 10; method.md §1.2 to §1.4).
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

enum class EdgeFeature : std::uint8_t { end_0, end_1, interior };  ///< features of a closed edge

/// n independent cases; `first` is the lower-numbered edge. Edges of zero length, which may arise during a run, are
/// legal; their closest point is end_0.
struct ClosestPointsIn {
  std::vector<std::array<Vec3f, 2>> first, second;  ///< by case and end [m]
};

/// `nearly_parallel`: ‖e×e'‖² < 10⁻⁶ ‖e‖² ‖e'‖² and the projection of the second edge on the line of the first overlaps
/// the first in more than a point. Then both features are interior, and the points are the middle of the overlap and
/// its projection on the (closed) second edge.
struct ClosestPointsOut {
  std::vector<EdgeFeature> first_feature, second_feature;  ///< features that hold the closest points
  std::vector<std::uint8_t> nearly_parallel;               ///< 0 or 1
  std::vector<std::array<float, 2>> parameters;            ///< of the contact points, from 0 at end_0 to 1 at end_1
  std::vector<float> contact_distance;                     ///< distance of the contact points, rounded to nearest [m]
  std::vector<float> distance_below;                       ///< never above the exact distance of the two edges [m]
};

/// The code of an answer is first_feature + 3 · second_feature + 9 · nearly_parallel. The answer is accepted if bit
/// `code` of `accepted` is set.
struct ClosestPointsTruth {
  ClosestPointsOut exact;                          ///< rounded
  std::vector<std::uint32_t> accepted;             ///< bit of each accepted code
  std::vector<std::uint8_t> near;                  ///< 1 where a margin between answers lies within near_factor
  std::vector<double> contact_distance, distance;  ///< [m]
  std::vector<std::array<double, 2>> parameters;   ///< exact
  std::vector<double> parameter_condition;         ///< defined as weight_condition of closest_face
};

/// Largest errors, in the units of closest_face. They exceed the tolerances of closest_face (12), because the
/// determinant of the solution for two interior points has two more products.
inline constexpr double closest_points_distance_tolerance = 16;
inline constexpr double closest_points_parameter_tolerance = 16;
/// Largest amount by which `distance_below` may be too small, in units of u · max(distance, Σ|δ|), u = 2⁻²⁴. As for
/// closest_face_below_tolerance, let ρ be the relative rounding error and S ≤ 2 Σ|δ| a sum of lengths.
///
/// - For nearly parallel edges at an angle θ the normal's error changes the distance by ρ S/θ.
/// - A kernel that computes distances from the ends of edges instead errs by θ ‖e‖.
/// - If the kernel does so for θ < √ρ, both errors together are at most 2 √ρ S.
///
/// With 2⁸ rounding errors in double √ρ = 2.83 u, so 2 √ρ S < 12 u Σ|δ|. The tolerance is twice that (24), plus a third
/// of it for the two products of the determinant.
inline constexpr double closest_points_below_tolerance = 32;

}  // namespace ogc::compare
