// Reads cells of VTK's files. VTK's XML format and its older format use the same numbers for kinds of cells.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Converts the cells of a file to tetrahedra, faces and loose edges of a mesh. VTK's numbers give the cells' kinds.
class VtkCells {
 public:
  /// Makes an object that adds cells to `mesh`. `name` is the file's name, for errors and notes. Both must outlive this
  /// object.
  VtkCells(PolygonMesh& mesh, const std::string& name) : mesh_(mesh), name_(name) {}

  /// Adds a cell, whose corners are vertices of the mesh. Throws InputError that names the cell if this kind of cell
  /// cannot be read (hexahedra, wedges, pyramids, cells of higher order), or if this kind has another number of
  /// corners.
  void add(int kind, std::span<const Index> corners);
  /// Leaves out, with a note, single points and, if there are tetrahedra, all other cells.
  void finish();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void add_line(Index a, Index b);

  PolygonMesh& mesh_;
  const std::string& name_;
  std::size_t cells_ = 0, points_ = 0;
};

/// VTK's numbers for kinds of cells that PolyData lists.
inline constexpr int vtk_poly_line = 4, vtk_strip = 6, vtk_polygon = 7;

/// Converts `value`, a number of an array, to a kind of cell; returns −1 if it is no whole number from 0 to 255.
int vtk_kind(double value);

/// Holds the corners of all cells of a piece in one list, cell after cell. Corners count from 0 in the piece, whose
/// vertices begin at `first` in the mesh.
struct VtkCellLists {
  std::string where;            ///< begins the errors: file and section
  std::vector<double> ends;     ///< by cell: index in `corners` after its last corner
  std::vector<double> corners;  ///< of all cells
  std::size_t first = 0;        ///< first vertex of the piece
  std::size_t count = 0;        ///< number of vertices of the piece
};

/// Calls use(index of the cell, its corners as vertices of the mesh) for each cell. Throws InputError that names the
/// cell: an end that is less than the previous end or exceeds the number of corners, a corner that is no vertex of the
/// piece.
void each_vtk_cell(const VtkCellLists& lists, const std::function<void(std::size_t, std::span<const Index>)>& use);

/// Appends points to the mesh, three numbers each. Throws InputError that begins with `where` if the numbers are no
/// rows of three, or one of them is not finite.
void add_vtk_points(const std::vector<double>& values, const std::string& where, PolygonMesh& mesh);

}  // namespace ogc::compare
