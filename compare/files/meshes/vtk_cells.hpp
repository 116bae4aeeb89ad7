// Cells of VTK's files: its XML and its older format number their kinds in the same way.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Cells of a file, by VTK's numbers for their kinds, made into a mesh's tetrahedra, faces and loose edges.
class VtkCells {
 public:
  /// `name` is the file's, for errors and words. Both must outlive it.
  VtkCells(PolygonMesh& mesh, const std::string& name) : mesh_(mesh), name_(name) {}

  /// One more cell, whose corners are vertices of the mesh. Throws InputError that names it where its kind is not read
  /// (hexahedra, wedges, pyramids, cells of higher order) or has another number of corners.
  void add(int kind, std::span<const Index> corners);
  /// Leaves out what is no part of a solid where there are tetrahedra, and single points always, with a word.
  void finish();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void add_line(Index a, Index b);

  PolygonMesh& mesh_;
  const std::string& name_;
  std::size_t cells_ = 0, points_ = 0;
};

/// VTK's numbers for the kinds of cells that its lists of PolyData hold.
inline constexpr int vtk_poly_line = 4, vtk_strip = 6, vtk_polygon = 7;

/// A number of an array as the number of a kind; −1, which is none, where it can't be one.
int vtk_kind(double value);

/// Lists of corners, one after the other, by their ends: a cell's corners count from 0 in its piece, whose vertices are
/// the mesh's from `first` on.
struct VtkCellLists {
  std::string where;            ///< begins the errors: file and section
  std::vector<double> ends;     ///< by cell
  std::vector<double> corners;  ///< of all cells
  std::size_t first = 0;        ///< vertex of the piece
  std::size_t count = 0;        ///< vertices of the piece
};

/// Calls use(number of the cell, its corners as the mesh counts) for each. Throws InputError that names the cell: an
/// end out of order or beyond the corners, a corner that is no vertex of the piece.
void each_vtk_cell(const VtkCellLists& lists, const std::function<void(std::size_t, std::span<const Index>)>& use);

/// Appends points to the mesh; each is three of the numbers. Throws InputError that begins with `where` if the numbers
/// are no rows of three, or one of them is not finite.
void add_vtk_points(const std::vector<double>& values, const std::string& where, PolygonMesh& mesh);

}  // namespace ogc::compare
