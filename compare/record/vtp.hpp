// VTK's XML PolyData, with the arrays appended as raw bytes: no text to parse, no digits lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/record/run_folder.hpp"

namespace ogc::compare {

/// The bytes of a .vtp file: points, loose edges as lines, triangles as polygons; point data velocity, bound, body.
std::string vtp_bytes(const Mesh& mesh, std::span<const Index> bodies, const Frame& frame);

/// The text of a .pvd index of (time [s], file relative to the index).
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace ogc::compare
