// Decides for any points whether a segment meets a triangle or a segment, with exact predicates only. An audit often
// meets degenerate configurations, so they are handled, too.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns whether closed segment pq and closed triangle abc share a point. Either may be degenerate: for p = q the
/// segment is a point, and a collinear triangle is the segment or point that it covers. Coordinates must be finite.
bool segment_meets_triangle(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle);

/// Returns whether closed segments share a point; either may be a point. Coordinates must be finite.
bool segments_meet(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second);

}  // namespace ogc::compare
