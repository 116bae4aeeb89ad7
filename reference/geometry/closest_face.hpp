// Stage closest_face: the Voronoi regions of a closed triangle (Alg. 1 lines 4 and 8; method.md §2.2).
#pragma once

#include <array>

#include "compare/stages/closest_face.hpp"
#include "reference/geometry/conditions.hpp"

namespace ogc::reference {

using compare::TriangleFeature;
/// The corners of a triangle [m].
using Corners = std::array<Vec3f, 3>;

/// Decided exactly.
bool has_area(const Corners& triangle);

/// The exact closest feature. A collapsed triangle gives a corner where one is closest, otherwise the lowest-numbered
/// edge, never the interior.
TriangleFeature closest_feature(const Corners& triangle, const Vec3f& point);

/// Whether a feature is the closest one, or could be after a flip of grey conditions.
Membership is_closest(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Bit k is set where feature k is, or could be, the closest one. Where the closest one is certain, no other region can
/// begin: only its bit is set.
std::uint8_t possible_features(const Corners& triangle, const Vec3f& point);

/// Whether the point lies near the boundary of a feature's region (compare::near_factor).
bool near_feature(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// The distance to the corner, line or plane of a feature, as a gap: the distance to the triangle where the feature is
/// the closest one.
Margin feature_gap(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// All cases, in parallel over them.
compare::ClosestFaceTruth closest_face(const compare::ClosestFaceIn& in);

}  // namespace ogc::reference
