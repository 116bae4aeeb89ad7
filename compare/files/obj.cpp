// Line by line; a face may name vertices that come later, so indices are checked at the end, and each face remembers
// its line.
#include "compare/files/obj.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<std::string_view, 13> skipped{"vn",     "vt",     "vp",     "p",      "o",  "g",  "s",
                                                   "usemtl", "mtllib", "usemap", "maplib", "mg", "lod"};

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r\f\v";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name) : rest_(text), name_(name) {
    mesh_.source.file = name;
    mesh_.source.first = 1;
  }

  PolygonMesh parse() {
    while (!rest_.empty()) {
      ++line_;
      std::string_view line = rest_.substr(0, rest_.find('\n'));
      rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
      statement(line.substr(0, line.find('#')));
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) check(mesh_.face(f), mesh_.source.face_lines[f]);
    for (std::size_t e = 0; e < mesh_.loose_edges.size(); ++e) check(mesh_.loose_edges[e], mesh_.source.edge_lines[e]);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line) + ": " + what);
  }

  void statement(std::string_view line) {
    const std::string_view keyword = next_word(line);
    if (keyword.empty() || std::find(skipped.begin(), skipped.end(), keyword) != skipped.end()) return;
    if (keyword == "v") {
      vertex(line);
    } else if (keyword == "f") {
      face(line);
    } else if (keyword == "l") {
      polyline(line);
    } else {
      fail(line_, "'" + std::string(keyword) + "' is not supported; keep v, f and l lines");
    }
  }

  void vertex(std::string_view line) {
    std::array<double, 3> x{};
    for (double& coordinate : x) {
      const std::string_view word = next_word(line);
      if (!parse_number(word, coordinate) || !std::isfinite(coordinate)) {
        fail(line_, "'" + std::string(word) + "' is no finite coordinate; give three numbers [m]");
      }
    }
    mesh_.positions.push_back({x[0], x[1], x[2]});
    mesh_.source.vertex_lines.push_back(line_);
  }

  // Zero-based; not yet checked against the number of vertices.
  Index corner(std::string_view word) const {
    std::int64_t i = 0;
    if (!parse_number(word.substr(0, word.find('/')), i) || i == 0) {
      fail(line_, "'" + std::string(word) + "' is no vertex; count from 1, or backwards from -1");
    }
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    if (i < -count || i > std::numeric_limits<Index>::max())
      fail(line_, "vertex " + std::to_string(i) + " does not exist");
    return static_cast<Index>(i < 0 ? count + i : i - 1);
  }

  void face(std::string_view line) {
    face_.clear();
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) face_.push_back(corner(word));
    if (face_.size() < 3) fail(line_, "a face has three corners or more");
    mesh_.add_face(face_);
    mesh_.source.face_lines.push_back(line_);
  }

  void polyline(std::string_view line) {
    const std::string_view first = next_word(line), second = next_word(line);
    if (second.empty()) fail(line_, "a line has at least two vertices");
    Index from = corner(first);
    for (std::string_view word = second; !word.empty(); word = next_word(line)) {
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
      fail(line, "vertex " + std::to_string(v + 1) + " does not exist; the file has " + std::to_string(count));
    }
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
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
