// Stage closest_face: the Voronoi regions of a closed triangle (Alg. 1 lines 4 and 8; method.md §2.2).
#pragma once

#include <array>

#include "compare/stages/closest_face.hpp"
#include "reference/geometry/conditions.hpp"

namespace ogc::reference {

using compare::TriangleFeature;
/// The corners of a triangle [m].
using Corners = std::array<Vec3f, 3>;

/// Returns whether the triangle has area, decided exactly.
bool has_area(const Corners& triangle);

/// Returns the exact closest feature. For a collapsed triangle it is a corner where one is closest, otherwise the
/// lowest-numbered edge, never the interior.
TriangleFeature closest_feature(const Corners& triangle, const Vec3f& point);

/// Returns whether a feature is the closest one, or could be after a flip of grey conditions.
Membership is_closest(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Returns a mask: bit k is set where feature k is, or could be, the closest one. Where the closest one is certain, no
/// other region can begin: only its bit is set.
std::uint8_t possible_features(const Corners& triangle, const Vec3f& point);

/// Returns whether the point lies near the boundary of a feature's region (compare::near_factor).
bool near_feature(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Returns the distance to the corner, line or plane of a feature, as a gap; it is the distance to the triangle where
/// the feature is the closest one.
Margin feature_gap(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Computes all cases, in parallel over them.
compare::ClosestFaceTruth closest_face(const compare::ClosestFaceIn& in);

}  // namespace ogc::reference
