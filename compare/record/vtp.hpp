// Writes VTK's XML PolyData. Arrays are appended as raw bytes, so readers parse no text and no digits are lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/record/run_folder.hpp"

namespace ogc::compare {

/// Returns the bytes of a .vtp file: points, loose edges as lines, triangles as polygons; point data velocity, bound,
/// body. If `origin` is not 0, it is added to the points, which are then in double.
std::string vtp_bytes(const Mesh& mesh, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

/// A part of a mesh, with the numbers of its elements in the whole mesh.
struct LabelledMesh {
  Mesh mesh;                          ///< positions, triangles and loose edges of the part
  std::vector<Index> vertex_numbers;  ///< number of each vertex
  std::vector<Index> cell_numbers;    ///< numbers of loose edges, then of triangles
  std::vector<Index> cell_counts;     ///< number of intersections that contain the cell, in the same order
};

/// Returns the bytes of the part's .vtp file: points in double, loose edges as lines, triangles; point data `vertex`,
/// cell data `number`, `intersections`.
std::string vtp_bytes(const LabelledMesh& part);

/// Returns the text of a .pvd file, which lists each file with its time. `files` has times [s] and paths relative to
/// the .pvd file.
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace ogc::compare
