#include "compare/files/meshes/vtp_parse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/files/meshes/vtk_arrays.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

class PieceReader {
 public:
  PieceReader(const VtkDocument& document, const VtkPiece& piece, const std::string& name, PolygonMesh& mesh)
      : document_(document), piece_(piece), name_(name), mesh_(mesh), first_(mesh.positions.size()) {}

  void read() {
    points();
    cells("Polys", [&](std::size_t i, const std::vector<Index>& corners) {
      if (corners.size() < 3)
        fail("polygon", i, "has " + std::to_string(corners.size()) + " corners; a face has three or more");
      mesh_.add_face(corners);
    });
    // Every second triangle of a strip is turned round.
    cells("Strips", [&](std::size_t, const std::vector<Index>& strip) {
      for (std::size_t k = 2; k < strip.size(); ++k)
        mesh_.add_face(std::array{strip[k - 2], strip[k - 1 + k % 2], strip[k - k % 2]});
    });
    cells("Lines", [&](std::size_t, const std::vector<Index>& line) {
      for (std::size_t k = 1; k < line.size(); ++k)
        mesh_.loose_edges.push_back({std::min(line[k - 1], line[k]), std::max(line[k - 1], line[k])});
    });
  }

 private:
  [[noreturn]] void fail(const char* kind, std::size_t i, const std::string& what) const {
    throw InputError(name_ + ": " + kind + " " + std::to_string(i) + ": " + what);
  }

  /// The array of that section; by name where one is given. Null where there is none.
  const VtkArray* find(const std::string& section, const std::string& array) const {
    const auto found = std::ranges::find_if(piece_.arrays, [&](const VtkArray& candidate) {
      if (candidate.section != section) return false;
      const auto its_name = candidate.attributes.find("Name");
      return array.empty() || (its_name != candidate.attributes.end() && its_name->second == array);
    });
    return found == piece_.arrays.end() ? nullptr : &*found;
  }

  void points() {
    const VtkArray* array = find("Points", "");
    if (array == nullptr) throw InputError(name_ + ": a piece has no points");
    const std::vector<double> values = read_vtk_array(document_, *array, name_);
    if (values.size() % 3 != 0)
      throw InputError(name_ + ": Points: " + std::to_string(values.size()) + " numbers are no rows of three");
    for (std::size_t i = 0; i < values.size(); i += 3) {
      if (!std::isfinite(values[i]) || !std::isfinite(values[i + 1]) || !std::isfinite(values[i + 2]))
        fail("point", i / 3, "a coordinate is not finite; give three finite numbers [m]");
      mesh_.positions.push_back({values[i], values[i + 1], values[i + 2]});
    }
  }

  template <class Use>
  void cells(const std::string& section, Use use) {
    const VtkArray *corners = find(section, "connectivity"), *offsets = find(section, "offsets");
    if (corners == nullptr || offsets == nullptr) return;
    const std::vector<double> connectivity = read_vtk_array(document_, *corners, name_);
    const std::vector<double> ends = read_vtk_array(document_, *offsets, name_);
    double begin = 0;
    std::vector<Index> cell;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (!(ends[i] >= begin && ends[i] <= static_cast<double>(connectivity.size())))
        fail(section.c_str(), i, "its offset is out of order, or beyond its vertices");
      cell.clear();
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(ends[i]); ++k)
        cell.push_back(vertex(section, i, connectivity[k]));
      use(i, cell);
      begin = ends[i];
    }
  }

  Index vertex(const std::string& section, std::size_t i, double value) const {
    const double count = static_cast<double>(mesh_.positions.size() - first_);
    if (!(value >= 0 && value < count && value == std::floor(value)))
      fail(section.c_str(), i,
           "vertex " + shortest(value) + " does not exist; its piece has " + shortest(count) + ", numbered from 0");
    return static_cast<Index>(first_ + static_cast<std::size_t>(value));
  }

  const VtkDocument& document_;
  const VtkPiece& piece_;
  const std::string& name_;
  PolygonMesh& mesh_;
  std::size_t first_;  ///< vertex of this piece
};

}  // namespace

PolygonMesh parse_vtp(std::string_view bytes, const std::string& name) {
  const VtkDocument document = parse_vtk_xml(bytes, name);
  if (const auto type = document.file.find("type"); type == document.file.end() || type->second != "PolyData")
    throw InputError(name + ": is a VTK file of type '" + (type == document.file.end() ? "" : type->second) +
                     "'; write it as PolyData (ParaView: Extract Surface)");
  PolygonMesh mesh;
  mesh.source.file = name;
  for (const VtkPiece& piece : document.pieces) PieceReader(document, piece, name, mesh).read();
  if (mesh.positions.empty()) throw InputError(name + ": has no points");
  return mesh;
}

}  // namespace ogc::compare
