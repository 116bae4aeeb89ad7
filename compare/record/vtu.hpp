// Writes VTK's XML UnstructuredGrid for scenes with solids, because a file of surfaces leaves out tetrahedra.
#pragma once

#include <span>
#include <string>

#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// Returns the bytes of a .vtu file. Points are in double with `origin` added if it is not 0. Cells are tetrahedra,
/// then the triangles of bodies without tetrahedra, then loose edges. Point data are velocity [m/s], bound [m] and
/// body. Cell data are J [1], the ratio of a tetrahedron's volume to its volume at rest: at most 0 if it is flat or
/// inverted, and not-a-number for other cells.
std::string vtu_bytes(const Scene& scene, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

}  // namespace ogc::compare
