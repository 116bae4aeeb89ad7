// A face may name vertices that come later. So indices are checked after the whole file is read, and each face stores
// its line number for error messages.
#include "compare/files/meshes/obj.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<std::string_view, 13> skipped{"vn",     "vt",     "vp",     "p",      "o",  "g",  "s",
                                                   "usemtl", "mtllib", "usemap", "maplib", "mg", "lod"};

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name)
      : lines_(text, name, {.comment = '#', .backslash_joins = true}) {
    mesh_.source.file = name;
    mesh_.source.first = 1;
  }

  PolygonMesh parse() {
    while (lines_.next()) {
      line_ = lines_.number();
      statement();
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) check(mesh_.face(f), mesh_.source.face_lines[f]);
    for (std::size_t e = 0; e < mesh_.loose_edges.size(); ++e) check(mesh_.loose_edges[e], mesh_.source.edge_lines[e]);
    return std::move(mesh_);
  }

 private:
  void statement() {
    const std::string_view keyword = lines_.word();
    if (keyword.empty() || std::find(skipped.begin(), skipped.end(), keyword) != skipped.end()) return;
    if (keyword == "v") {
      vertex();
    } else if (keyword == "f") {
      face();
    } else if (keyword == "l") {
      polyline();
    } else {
      lines_.fail("'" + shown(keyword) + "' is not supported; keep v, f and l lines");
    }
  }

  void vertex() {
    const double x = lines_.coordinate(), y = lines_.coordinate(), z = lines_.coordinate();
    mesh_.positions.push_back({x, y, z});
    mesh_.source.vertex_lines.push_back(line_);
  }

  /// Returns the index of the corner's vertex, counted from 0. Vertices may follow later, so the upper limit is checked
  /// after the whole file is read.
  Index corner(std::string_view word) const {
    std::int64_t i = 0;
    if (!parse_number(word.substr(0, word.find('/')), i) || i == 0) {
      lines_.fail("'" + shown(word) + "' is no vertex; count from 1, or backwards from -1");
    }
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    if (i < -count || i > std::numeric_limits<Index>::max())
      lines_.fail("vertex " + std::to_string(i) + " does not exist");
    return static_cast<Index>(i < 0 ? count + i : i - 1);
  }

  void face() {
    face_.clear();
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) face_.push_back(corner(word));
    if (face_.size() < 3) lines_.fail("a face has three corners or more");
    mesh_.add_face(face_);
    mesh_.source.face_lines.push_back(line_);
  }

  void polyline() {
    const std::string_view first = lines_.word(), second = lines_.word();
    if (second.empty()) lines_.fail("a line has at least two vertices");
    Index from = corner(first);
    for (std::string_view word = second; !word.empty(); word = lines_.word()) {
      const Index to = corner(word);
      mesh_.loose_edges.push_back({std::min(from, to), std::max(from, to)});
      mesh_.source.edge_lines.push_back(line_);
      from = to;
    }
  }

  void check(std::span<const Index> face, std::size_t line) const {
    const std::size_t count = mesh_.positions.size();
    for (const Index v : face) {
      if (static_cast<std::size_t>(v) < count) continue;
      lines_.fail_at(line,
                     "vertex " + std::to_string(v + 1) + " does not exist; the file has " + std::to_string(count));
    }
  }

  TextLines lines_;
  std::size_t line_ = 0;  ///< first line of the statement
  PolygonMesh mesh_;
  std::vector<Index> face_;
};

}  // namespace

PolygonMesh parse_obj(std::string_view text, const std::string& name) { return ObjParser(text, name).parse(); }

std::string print_obj(const Mesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.positions) text += "v " + shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z) + '\n';
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  for (const auto& [a, b] : mesh.loose_edges) text += "l " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + '\n';
  return text;
}

}  // namespace ogc::compare
