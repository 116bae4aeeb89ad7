// VTK's XML PolyData, with the arrays appended as raw bytes: no text to parse, no digits lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/record/run_folder.hpp"

namespace ogc::compare {

/// The bytes of a .vtp file: points, loose edges as lines, triangles as polygons; point data velocity, bound, body. An
/// `origin` that is not 0 is added to the points, which are in double then.
std::string vtp_bytes(const Mesh& mesh, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

/// A part of a mesh, with numbers that say what it is a part of.
struct LabelledMesh {
  Mesh mesh;                          ///< its polygons as triangles
  std::vector<Index> vertex_numbers;  ///< by vertex
  std::vector<Index> cell_numbers;    ///< by loose edge, then by triangle
  std::vector<Index> cell_counts;     ///< likewise: how many intersections it is named in
};

/// The bytes of its .vtp file: points in double, loose edges as lines, triangles; point data `vertex`, cell data
/// `number`, `intersections`.
std::string vtp_bytes(const LabelledMesh& part);

/// The text of a .pvd index of (time [s], file relative to the index).
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace ogc::compare
