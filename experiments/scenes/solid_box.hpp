// Generates a box of tetrahedra.
#pragma once

#include <array>

#include "compare/problem/mesh.hpp"

namespace ogc::experiments {

/// Returns a box from corner `low` to corner `high` [m] with `count` ≥ 2 vertices along x, y and z. Each cell has six
/// tetrahedra around the diagonal from its lowest to its highest corner. All cells are cut in the same way, so that
/// faces of neighbouring cells match. Vertex (i, j, k) has index (i · count[1] + j) · count[2] + k. Colour (i + j + k)
/// mod 4 differs between all vertices of a tetrahedron.
compare::Mesh solid_box(const std::array<compare::Index, 3>& count, const compare::Vec3& low,
                        const compare::Vec3& high);

}  // namespace ogc::experiments
