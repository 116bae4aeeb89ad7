// Writes VTK's XML PolyData, with the arrays appended as raw bytes: no text to parse, no digits lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/record/run_folder.hpp"

namespace ogc::compare {

/// Returns the bytes of a .vtp file: points, loose edges as lines, triangles as polygons; point data velocity, bound,
/// body. An `origin` that is not 0 is added to the points, which are in double then.
std::string vtp_bytes(const Mesh& mesh, std::span<const Index> bodies, const Frame& frame, const Vec3& origin = {});

/// A part of a mesh, with the numbers of its elements in the whole mesh.
struct LabelledMesh {
  Mesh mesh;                          ///< its polygons as triangles
  std::vector<Index> vertex_numbers;  ///< number of each vertex
  std::vector<Index> cell_numbers;    ///< numbers of loose edges, then of triangles
  std::vector<Index> cell_counts;     ///< in the same order: number of intersections that name it
};

/// Returns the bytes of its .vtp file: points in double, loose edges as lines, triangles; point data `vertex`, cell
/// data `number`, `intersections`.
std::string vtp_bytes(const LabelledMesh& part);

/// Returns the text of a .pvd index of (time [s], file relative to the index).
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace ogc::compare
