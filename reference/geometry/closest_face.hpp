// Stage closest_face: decides in which Voronoi region of a closed triangle a point lies (Alg. 1 lines 4 and 8;
// method.md §2.2).
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

/// Returns the closest feature, exactly. A collapsed triangle has no interior: the result is a corner if one is
/// closest, otherwise the lowest-numbered edge.
TriangleFeature closest_feature(const Corners& triangle, const Vec3f& point);

/// Returns whether a feature is the closest one: in exact numbers, possibly (if grey conditions may flip), and
/// certainly (even if they flip).
Membership is_closest(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Returns a mask. Bit k is set if feature k is certainly or possibly the closest one. If the closest feature is
/// certain, only its bit is set.
std::uint8_t possible_features(const Corners& triangle, const Vec3f& point);

/// Returns whether the point lies near the boundary of a feature's region (compare::near_factor).
bool near_feature(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Returns the gap d² − r² with r = 0 (see with_radius), where d is the distance of the point from the feature's
/// corner, line or plane. For the closest feature, d is the distance to the triangle.
Margin feature_gap(const Corners& triangle, TriangleFeature feature, const Vec3f& point);

/// Returns the truth of all cases; computes them in parallel.
compare::ClosestFaceTruth closest_face(const compare::ClosestFaceIn& in);

}  // namespace ogc::reference
