#include "compare/files/meshes/vtk_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// A kind of cell with `corners` corners, or with at least that number if `or_more`.
struct Kind {
  int number;
  std::size_t corners;
  bool or_more;
  std::string_view name;
};
constexpr std::array<Kind, 10> kinds{{{1, 1, false, "vertex"},
                                      {2, 0, true, "list of vertices"},
                                      {3, 2, false, "line"},
                                      {vtk_poly_line, 2, true, "line of several vertices"},
                                      {5, 3, false, "triangle"},
                                      {vtk_strip, 3, true, "strip of triangles"},
                                      {vtk_polygon, 3, true, "polygon"},
                                      {8, 4, false, "pixel"},
                                      {9, 4, false, "quad"},
                                      {10, 4, false, "tetrahedron"}}};

/// Kinds of volume cells that cannot be read: all except tetrahedra of four vertices.
constexpr std::array<std::pair<int, std::string_view>, 8> unread{{{11, "a voxel"},
                                                                  {12, "a hexahedron"},
                                                                  {13, "a wedge"},
                                                                  {14, "a pyramid"},
                                                                  {24, "a tetrahedron of second order"},
                                                                  {25, "a hexahedron of second order"},
                                                                  {42, "a polyhedron"},
                                                                  {71, "a tetrahedron of higher order"}}};

}  // namespace

void VtkCells::fail(const std::string& what) const {
  throw InputError(name_ + ": cell " + std::to_string(cells_) + " " + what);
}

void VtkCells::add_line(Index a, Index b) { mesh_.loose_edges.push_back({std::min(a, b), std::max(a, b)}); }

void VtkCells::add(int number, std::span<const Index> c) {
  const auto kind = std::ranges::find(kinds, number, &Kind::number);
  if (kind == kinds.end()) {
    const auto known = std::ranges::find(unread, number, &std::pair<int, std::string_view>::first);
    fail("is " + (known == unread.end() ? "of VTK's kind " + std::to_string(number) : std::string(known->second)) +
         ", which is not read; mesh the volume with tetrahedra of 4 vertices");
  }
  if (kind->or_more ? c.size() < kind->corners : c.size() != kind->corners)
    fail("is a " + std::string(kind->name) + " of " + std::to_string(c.size()) + " corners; it has " +
         std::to_string(kind->corners) + (kind->or_more ? " or more" : ""));
  ++cells_;
  if (number <= 2) points_ += c.size();
  if (number == 3 || number == vtk_poly_line)
    for (std::size_t k = 1; k < c.size(); ++k) add_line(c[k - 1], c[k]);
  if (number == 5 || number == vtk_polygon || number == 9) mesh_.add_face(c);
  if (number == 8) mesh_.add_face(std::array{c[0], c[1], c[3], c[2]});
  if (number == vtk_strip)  // every second triangle is reversed
    for (std::size_t k = 2; k < c.size(); ++k) mesh_.add_face(std::array{c[k - 2], c[k - 1 + k % 2], c[k - k % 2]});
  if (number != 10) return;
  mesh_.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
  mesh_.source.tetrahedra.push_back(static_cast<Index>(cells_ - 1));
}

void VtkCells::finish() {
  if (points_ > 0) mesh_.notes.push_back(name_ + ": " + std::to_string(points_) + " single points were left out");
  keep_solid(mesh_);
}

int vtk_kind(double value) {
  return value >= 0 && value < 256 && value == std::floor(value) ? static_cast<int>(value) : -1;
}

void each_vtk_cell(const VtkCellLists& lists, const std::function<void(std::size_t, std::span<const Index>)>& use) {
  double begin = 0;
  std::vector<Index> cell;
  for (std::size_t i = 0; i < lists.ends.size(); ++i) {
    const std::string where = lists.where + " " + std::to_string(i) + ": ";
    const double end = lists.ends[i];
    if (!(end >= begin && end <= static_cast<double>(lists.corners.size()) && end == std::floor(end)))
      throw InputError(where + "its offset is out of order, or beyond its vertices");
    cell.clear();
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const double v = lists.corners[k];
      if (!(v >= 0 && v < static_cast<double>(lists.count) && v == std::floor(v)))
        throw InputError(where + "vertex " + shortest(v) + " does not exist; its piece has " +
                         std::to_string(lists.count) + ", numbered from 0");
      cell.push_back(static_cast<Index>(lists.first + static_cast<std::size_t>(v)));
    }
    use(i, cell);
    begin = end;
  }
}

void add_vtk_points(const std::vector<double>& values, const std::string& where, PolygonMesh& mesh) {
  if (values.size() % 3 != 0)
    throw InputError(where + ": Points: " + std::to_string(values.size()) + " numbers are no rows of three");
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const Vec3 p{values[i], values[i + 1], values[i + 2]};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(where + ": point " + std::to_string(i / 3) +
                       ": a coordinate is not finite; give three finite numbers [m]");
    mesh.positions.push_back(p);
  }
}

}  // namespace ogc::compare
