// Line by line; a face may name vertices that come later, so indices are checked at the end, and each face remembers its line.
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

constexpr std::array<std::string_view, 12> skipped{"vn", "vt", "vp", "o", "g", "s", "usemtl", "mtllib", "usemap", "maplib", "mg", "lod"};

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r\f\v";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  Mesh parse() {
    while (!rest_.empty()) {
      ++line_;
      std::string_view line = rest_.substr(0, rest_.find('\n'));
      rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
      statement(line.substr(0, line.find('#')));
    }
    check(mesh_.triangles, triangle_lines_);
    check(mesh_.loose_edges, edge_lines_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const { throw InputError(name_ + ": line " + std::to_string(line) + ": " + what); }

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
  }

  // Zero-based; not yet checked against the number of vertices.
  Index corner(std::string_view word) const {
    std::int64_t i = 0;
    if (!parse_number(word.substr(0, word.find('/')), i) || i == 0) {
      fail(line_, "'" + std::string(word) + "' is no vertex; count from 1, or backwards from -1");
    }
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    if (i < -count || i > std::numeric_limits<Index>::max()) fail(line_, "vertex " + std::to_string(i) + " does not exist");
    return static_cast<Index>(i < 0 ? count + i : i - 1);
  }

  void face(std::string_view line) {
    Triangle corners{};
    for (Index& c : corners) {
      const std::string_view word = next_word(line);
      if (word.empty()) fail(line_, "a face has three corners");
      c = corner(word);
    }
    if (!next_word(line).empty()) fail(line_, "a face has more than three corners; triangulate the mesh");
    mesh_.triangles.push_back(corners);
    triangle_lines_.push_back(line_);
  }

  void polyline(std::string_view line) {
    const std::string_view first = next_word(line), second = next_word(line);
    if (second.empty()) fail(line_, "a line has at least two vertices");
    Index from = corner(first);
    for (std::string_view word = second; !word.empty(); word = next_word(line)) {
      const Index to = corner(word);
      mesh_.loose_edges.push_back({std::min(from, to), std::max(from, to)});
      edge_lines_.push_back(line_);
      from = to;
    }
  }

  template <std::size_t corners>
  void check(const std::vector<std::array<Index, corners>>& faces, const std::vector<std::size_t>& lines) const {
    const std::size_t count = mesh_.positions.size();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const Index v : faces[i]) {
        if (static_cast<std::size_t>(v) < count) continue;
        fail(lines[i], "vertex " + std::to_string(v + 1) + " does not exist; the file has " + std::to_string(count));
      }
    }
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
  Mesh mesh_;
  std::vector<std::size_t> triangle_lines_, edge_lines_;
};

}  // namespace

Mesh parse_obj(std::string_view text, const std::string& name) { return ObjParser(text, name).parse(); }

std::string print_obj(const Mesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.positions) text += "v " + shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z) + '\n';
  for (const auto& [a, b, c] : mesh.triangles) text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  for (const auto& [a, b] : mesh.loose_edges) text += "l " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + '\n';
  return text;
}

}  // namespace ogc::compare
