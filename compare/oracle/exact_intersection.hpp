// Does a segment meet a triangle? Decided by exact predicates alone, and total: whatever the five points are, there is
// an answer. The degenerate configurations are not rare here; they are what an audit is asked about.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Closed segment pq and closed triangle abc share a point. Either may be degenerate: p = q is a point, a collinear
/// triangle is the segment or point that it covers. Coordinates must be finite.
bool segment_meets_triangle(const std::array<Vec3, 2>& segment, const std::array<Vec3, 3>& triangle);

/// Closed segments share a point; either may be a point. Coordinates must be finite.
bool segments_meet(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second);

}  // namespace ogc::compare
