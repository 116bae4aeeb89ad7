// Stage closest_face: the face of a closed triangle whose interior holds the point closest to a given point (Alg. 1
// lines 4 and 8; method.md §2.2).
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Faces of a triangle (a, b, c): corners, then edges from corner k to corner k+1, then the interior.
enum class TriangleFeature : std::uint8_t { corner_0, corner_1, corner_2, edge_01, edge_12, edge_20, interior };

/// n independent cases; all arrays have length n. A triangle of zero area is legal: its interior is never the closest
/// face.
struct ClosestFaceIn {
  std::vector<Vec3f> point;                    ///< by case [m]
  std::vector<std::array<Vec3f, 3>> triangle;  ///< by case and corner [m]
};

/// The answer; all arrays have length n.
struct ClosestFaceOut {
  /// the lower-dimensional one of equally near features
  std::vector<TriangleFeature> feature;
  std::vector<std::array<float, 3>> weights;  ///< barycentric weights of the closest point, ≥ 0
  std::vector<float> distance;                ///< [m], rounded to nearest
  std::vector<float> distance_below;          ///< [m], never above the exact distance
};

/// The exact answer. `accepted[i]` has bit k set if feature k is accepted: the exact feature and, in a grey case, every
/// feature that another sign of a grey margin would give. `distance_below` is the largest single-precision number that
/// is not above the exact distance.
struct ClosestFaceTruth {
  ClosestFaceOut exact;                        ///< rounded
  std::vector<std::uint8_t> accepted;          ///< bit f: feature f is accepted
  std::vector<std::uint8_t> near;              ///< 1 where a margin between features lies within near_factor
  std::vector<double> distance;                ///< [m], within 2⁻⁴⁰ max(distance, Σ|δ|)
  std::vector<std::array<double, 3>> weights;  ///< within 2⁻⁴⁰ weight_condition
  /// Σ |∂w/∂δ| |δ| over the weights w and the coordinates δ relative to the first corner; ≥ 1, infinite for zero area
  std::vector<double> weight_condition;
};

/// Largest error accepted in `distance`, in units of u · distance · max(1, Σ|δ|/distance), u = 2⁻²⁴. Rounding errors: a
/// difference (3), a closest point (4), another difference (1), a norm (4). The factor max(…), where δ are the
/// coordinates relative to the first corner, covers coordinates that are large relative to the distance.
inline constexpr double closest_face_distance_tolerance = 12;
/// Largest error accepted in a weight, in units of u · weight_condition. It counts the same rounding errors as
/// closest_face_distance_tolerance.
inline constexpr double closest_face_weight_tolerance = 12;
/// Largest amount by which `distance_below` may be below the exact distance, in units of u · max(distance, Σ|δ|), u =
/// 2⁻²⁴. A smaller bound is valid, but too loose to be useful.
///
/// In a needle (a triangle of small height) rounding moves the plane. Let ρ be the relative rounding error, n the
/// normal, L the length of the sides, S = ‖p − a‖ + ‖b − a‖ + ‖c − a‖ ≤ 3 Σ|δ|.
///
/// - The normal's error changes the distance by ρ S L²/‖n‖.
/// - A kernel that uses the needle's edges instead of its plane changes the distance by the height ‖n‖/L.
/// - If the kernel uses edges for ‖n‖ < √ρ L², either error is at most √ρ S.
///
/// With 2⁷ rounding errors in double √ρ = 2⁻²³ = 2 u. If the kernel subtracts its error, its bound is up to 2 √ρ S = 12
/// u Σ|δ| below the distance. The tolerance is twice that.
inline constexpr double closest_face_below_tolerance = 24;

}  // namespace ogc::compare
