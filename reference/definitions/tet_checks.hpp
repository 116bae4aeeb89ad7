// Checks that shortest paths in a body of tetrahedra are straight, and finds the body's boundary, for tet_volume.cpp.
#pragma once

#include "reference/definitions/tet_volume.hpp"

namespace ogc::reference {

/// Throws compare::InputError for an index that is no vertex, and for an inverted or a flat tetrahedron.
void check_shape(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra);

/// Returns the boundary, in the order of TetVolume::boundary. Throws compare::InputError if the map from the mesh to
/// space (tet_volume.hpp) is not locally injective inside the body. `tetrahedra_of` lists the tetrahedra at each
/// vertex. check_shape must have succeeded.
std::vector<BoundaryTriangle> checked_boundary(std::span<const Vec3f> positions,
                                               std::span<const Tetrahedron> tetrahedra,
                                               std::span<const std::vector<Index>> tetrahedra_of);

}  // namespace ogc::reference
