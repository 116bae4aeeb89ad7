// Cuts faces of more than three corners into triangles: always the same way, with every corner kept. A library that
// drops corners on straight lines leaves gaps between a face and its neighbours.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Cuts a face of n ≥ 4 different corners into n − 2 triangles with its orientation. Corners need not lie in a plane:
/// inside is decided as seen along the face's area vector Σ xᵢ × xᵢ₊₁ / 2 (Newell). The shape of a triangle is its
/// signed area over its squared longest side.
///
/// A quad is cut from its first corner to its third. The other cut is taken only if it is much better: its worse
/// triangle has more than twice the shape of the first cut's worse triangle. So concave quads are cut correctly, and
/// all nearly square quads in the same way. From larger faces the ear with the best shape is cut off first (of equal
/// ears the first), which avoids slivers where the face allows it. Returns nothing if the face has no area or, seen
/// along the area vector, crosses itself. `corners` are vertices; `positions` are by vertex [m].
std::vector<Triangle> triangulate(std::span<const Index> corners, std::span<const Vec3> positions);

}  // namespace ogc::compare
