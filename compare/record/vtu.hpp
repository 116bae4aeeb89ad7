// VTK's XML UnstructuredGrid, for scenes with solids: what a surface file leaves out are the tetrahedra.
#pragma once

#include <span>
#include <string>

#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// The bytes of a .vtu file: points, in double and with `origin` added where that is not 0; tetrahedra, then the
/// triangles of bodies without tetrahedra, then loose edges as cells. Point data velocity [m/s], bound [m], body; cell
/// data J [1], the ratio of a tetrahedron's volume to that at rest, not above 0 where it is flat or inverted, and not a
/// number of other cells.
std::string vtu_bytes(const Scene& scene, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

}  // namespace ogc::compare
