#include "compare/files/meshes/vtk_mesh.hpp"

#include <algorithm>

#include "compare/files/meshes/vtk_arrays.hpp"
#include "compare/files/meshes/vtk_cells.hpp"
#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

class PieceReader {
 public:
  PieceReader(const VtkDocument& document, const VtkPiece& piece, const std::string& name, PolygonMesh& mesh)
      : document_(document), piece_(piece), name_(name), mesh_(mesh), first_(mesh.positions.size()) {}

  void read(bool is_grid, VtkCells& cells) {
    const VtkArray* array = find("Points", "");
    if (array == nullptr) throw InputError(name_ + ": a piece has no points");
    add_vtk_points(values(*array), name_, mesh_);
    expect_count("NumberOfPoints", mesh_.positions.size() - first_, "points");
    if (is_grid) return grid_cells(cells);
    for (const auto& [section, kind] :
         {std::pair("Polys", vtk_polygon), std::pair("Strips", vtk_strip), std::pair("Lines", vtk_poly_line)}) {
      const VtkArray *corners = find(section, "connectivity"), *offsets = find(section, "offsets");
      if (corners == nullptr || offsets == nullptr) {
        expect_count("NumberOf" + std::string(section), 0, section);
        continue;
      }
      const VtkCellLists found = lists(section, *offsets, *corners);
      expect_count("NumberOf" + std::string(section), found.ends.size(), section);
      each_vtk_cell(found, [&, kind = kind](std::size_t, std::span<const Index> c) { cells.add(kind, c); });
    }
  }

 private:
  std::vector<double> values(const VtkArray& array) const { return read_vtk_array(document_, array, name_); }

  /// Throws InputError if the piece announces another number of elements than `count`, the number in its arrays.
  void expect_count(const std::string& attribute, std::size_t count, const char* what) const {
    const auto found = piece_.attributes.find(attribute);
    std::size_t announced = 0;
    if (found == piece_.attributes.end() || (parse_number(found->second, announced) && announced == count)) return;
    throw InputError(name_ + ": a piece announces '" + shown(found->second) + "' " + what + " and holds " +
                     std::to_string(count) + ": the file is truncated or damaged");
  }

  VtkCellLists lists(const std::string& section, const VtkArray& ends, const VtkArray& corners) const {
    return {name_ + ": " + section, values(ends), values(corners), first_, mesh_.positions.size() - first_};
  }

  void grid_cells(VtkCells& cells) {
    const VtkArray *corners = find("Cells", "connectivity"), *offsets = find("Cells", "offsets"),
                   *kinds = find("Cells", "types");
    if (corners == nullptr || offsets == nullptr || kinds == nullptr)
      throw InputError(name_ + ": a piece lacks connectivity, offsets or types of its cells");
    const VtkCellLists cell_lists = lists("Cells", *offsets, *corners);
    const std::vector<double> kind = values(*kinds);
    expect_count("NumberOfCells", cell_lists.ends.size(), "cells");
    if (kind.size() != cell_lists.ends.size())
      throw InputError(name_ + ": a piece has " + std::to_string(cell_lists.ends.size()) + " cells and " +
                       std::to_string(kind.size()) + " types of cells; the file is damaged");
    each_vtk_cell(cell_lists, [&](std::size_t i, std::span<const Index> c) { cells.add(vtk_kind(kind[i]), c); });
  }

  /// Returns the array called `array` in `section`, or the first array of the section if `array` is empty; null if
  /// there is none.
  const VtkArray* find(const std::string& section, const std::string& array) const {
    const auto found = std::ranges::find_if(piece_.arrays, [&](const VtkArray& candidate) {
      if (candidate.section != section) return false;
      const auto its_name = candidate.attributes.find("Name");
      return array.empty() || (its_name != candidate.attributes.end() && its_name->second == array);
    });
    return found == piece_.arrays.end() ? nullptr : &*found;
  }

  const VtkDocument& document_;
  const VtkPiece& piece_;
  const std::string& name_;
  PolygonMesh& mesh_;
  std::size_t first_;  ///< first vertex of this piece
};

}  // namespace

PolygonMesh parse_vtk_xml_mesh(std::string_view bytes, const std::string& name) {
  const VtkDocument document = parse_vtk_xml(bytes, name);
  const auto found = document.file.find("type");
  const std::string type = found == document.file.end() ? "" : found->second;
  if (type != "PolyData" && type != "UnstructuredGrid")
    throw InputError(name + ": is a VTK file of type '" + type +
                     "'; write it as PolyData (ParaView: Extract Surface), or tetrahedra as UnstructuredGrid");
  PolygonMesh mesh;
  mesh.source.file = name;
  VtkCells cells(mesh, mesh.source.file);
  for (const VtkPiece& piece : document.pieces)
    PieceReader(document, piece, name, mesh).read(type == "UnstructuredGrid", cells);
  if (mesh.positions.empty()) throw InputError(name + ": has no points");
  cells.finish();
  return mesh;
}

}  // namespace ogc::compare
