// Writes VTK's XML UnstructuredGrid, for scenes with solids: it holds the tetrahedra that a surface file leaves out.
#pragma once

#include <span>
#include <string>

#include "compare/problem/scene.hpp"
#include "compare/record/frame_file.hpp"

namespace ogc::compare {

/// Returns the bytes of a .vtu file: points, in double and with `origin` added if that is not 0; tetrahedra, then the
/// triangles of bodies without tetrahedra, then loose edges as cells. Point data velocity [m/s], bound [m], body; cell
/// data J [1], the ratio of a tetrahedron's volume to its volume at rest, not above 0 if it is flat or inverted, and
/// not-a-number for other cells.
std::string vtu_bytes(const Scene& scene, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

}  // namespace ogc::compare
