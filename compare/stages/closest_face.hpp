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

/// n independent cases; all arrays have length n. Coordinates [m]. A triangle of zero area is legal: its interior is
/// never the closest face.
struct ClosestFaceIn {
  std::vector<Vec3f> point;                    ///< by case [m]
  std::vector<std::array<Vec3f, 3>> triangle;  ///< by case and corner [m]
};

/// The answer; all arrays have length n.
struct ClosestFaceOut {
  /// of equally near features the lower-dimensional one wins
  std::vector<TriangleFeature> feature;
  std::vector<std::array<float, 3>> weights;  ///< barycentric weights of the closest point, ≥ 0
  std::vector<float> distance;                ///< [m], nearest
  std::vector<float> distance_below;          ///< [m], never above the exact distance
};

/// The exact answer. `accepted[i]` has bit k set where feature k is acceptable: the exact one and, in a grey case,
/// those on the other side of a boundary. Distances: `distance_below` is the largest single-precision number that is
/// not above the exact distance.
struct ClosestFaceTruth {
  ClosestFaceOut exact;                        ///< rounded
  std::vector<std::uint8_t> accepted;          ///< bit f: feature f is accepted
  std::vector<std::uint8_t> near;              ///< 1 where a margin between features lies within near_factor
  std::vector<double> distance;                ///< [m], within 2⁻⁴⁰ max(distance, Σ|δ|)
  std::vector<std::array<double, 3>> weights;  ///< within 2⁻⁴⁰ weight_condition
  /// ∂(weights)/∂(relative coordinates) summed with the coordinates' moduli; ≥ 1, infinite for zero area
  std::vector<double> weight_condition;
};

/// Largest error accepted in `distance`, in units of u · distance. A kernel may form differences (exact to u each when
/// the coordinates are of one size; the case's condition enters through them), a closest point, a difference again and
/// a norm: 3 + 4 + 1 + 4 roundings, half of them systematic. Differences of the given coordinates are amplified by
/// Σ|δ|/distance; the judge multiplies by max(1, Σ|δ|/distance).
inline constexpr double closest_face_distance_tolerance = 12;
/// Largest error accepted in a weight, in units of u · weight_condition; the same count.
inline constexpr double closest_face_weight_tolerance = 12;
/// Largest shortfall accepted in `distance_below`, in units of u · max(distance, Σ|δ|): a bound below that is valid but
/// uselessly loose. No kernel knows the plane of a needle well: with relative errors ρ its normal, of length ‖n‖ beside
/// sides of length L, moves the distance by ρ S L²/‖n‖, where S = ‖p − a‖ + ‖b − a‖ + ‖c − a‖ ≤ 3 Σ|δ|; taking a needle
/// for its edges costs its height ‖n‖/L. Changing over at ‖n‖ = √ρ L² costs √ρ S either way. With 2⁷ roundings in
/// double √ρ = 2⁻²³ = 2 u: a bound 2 √ρ S below the distance, for a slack as large as the error, is 12 u Σ|δ|; twice
/// that for the kernel.
inline constexpr double closest_face_below_tolerance = 24;

}  // namespace ogc::compare
