// Checks that a body of tetrahedra has straight shortest paths, and finds its boundary, for tet_volume.cpp.
#pragma once

#include "reference/definitions/tet_volume.hpp"

namespace ogc::reference {

/// Throws compare::InputError for an index that is no vertex, an inverted or a flat tetrahedron.
void check_shape(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra);

/// Returns the boundary, in the order of TetVolume::boundary. Throws compare::InputError where the map is not locally
/// injective away from it. `tetrahedra_of` lists the tetrahedra at each vertex; shapes must have been checked.
std::vector<BoundaryTriangle> checked_boundary(std::span<const Vec3f> positions,
                                               std::span<const Tetrahedron> tetrahedra,
                                               std::span<const std::vector<Index>> tetrahedra_of);

}  // namespace ogc::reference
