// A file is a sequence of keywords, each followed by its contents. Line ends have no meaning between words.
#include "compare/files/meshes/medit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "compare/files/text_lines.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// A section of elements.
struct Section {
  std::string_view keyword;
  std::size_t corners;
  bool is_read;
};
constexpr std::array<Section, 7> sections{{{"Edges", 2, true},
                                           {"Triangles", 3, true},
                                           {"Quadrilaterals", 4, true},
                                           {"Tetrahedra", 4, true},
                                           {"Hexahedra", 8, false},
                                           {"Prisms", 6, false},
                                           {"Pyramids", 5, false}}};

class MeditParser {
 public:
  MeditParser(std::string_view text, const std::string& name) : lines_(text, name, {.comment = '#'}), name_(name) {
    mesh_.source.file = name;
    mesh_.source.first = 1;
  }

  PolygonMesh parse() {
    const std::string_view first = lines_.far_word();
    if (first != "MeshVersionFormatted")
      lines_.fail("'" + shown(first) + "' stands where 'MeshVersionFormatted' should; it is no Medit file in text");
    lines_.integer(lines_.expect_word("a version"), "a version");
    std::string_view keyword = lines_.expect_word("'Dimension' or a section");
    while (!keyword.empty() && keyword != "End") keyword = section(keyword);
    if (keyword.empty()) lines_.fail_truncated("another section or 'End'");
    return finish();
  }

 private:
  /// Reads one section; returns the next keyword, or an empty word at the end of the file.
  std::string_view section(std::string_view keyword) {
    if (std::isalpha(static_cast<unsigned char>(keyword.front())) == 0)
      lines_.fail("'" + shown(keyword) + "' stands where a keyword should: the count of the section before is wrong");
    const auto found = std::ranges::find(sections, keyword, &Section::keyword);
    if (keyword == "Dimension") {
      const std::int64_t dimension = lines_.integer(lines_.expect_word("the dimension"), "the dimension");
      if (dimension != 3) lines_.fail("dimension " + std::to_string(dimension) + " is not read, only 3");
    } else if (keyword == "Vertices") {
      vertices();
    } else if (found != sections.end()) {
      elements(*found);
    } else {
      return skip();
    }
    return lines_.far_word();
  }

  std::string_view skip() {
    std::string_view word = lines_.far_word();
    while (!word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) == 0) word = lines_.far_word();
    return word;
  }

  void vertices() {
    // A vertex takes at least 8 bytes: "0 0 0 0" and a blank.
    const std::size_t count = lines_.count(lines_.expect_word("the number of vertices"), "number of vertices", 8);
    for (std::size_t v = 1; v <= count; ++v) {
      const std::string what = "vertex " + std::to_string(v) + " of " + std::to_string(count);
      const std::string_view word = lines_.expect_word(what);
      mesh_.source.vertex_lines.push_back(lines_.number());
      const double x = lines_.coordinate(word), y = lines_.coordinate(lines_.expect_word(what));
      mesh_.positions.push_back({x, y, lines_.coordinate(lines_.expect_word(what))});
      lines_.expect_word("the reference of " + what);
    }
  }

  void elements(const Section& section) {
    const std::string kind(section.keyword);
    const std::size_t count = lines_.count(lines_.expect_word("the number of " + kind), "number of " + kind,
                                           2 * section.corners + 2);
    if (count > 0 && !section.is_read)
      lines_.fail(kind + " are not read; mesh the volume with tetrahedra of 4 vertices");
    for (std::size_t i = 1; i <= count; ++i) {
      const std::string what = std::to_string(i) + " of the " + std::to_string(count) + " " + kind;
      std::array<Index, 4> corners{};
      std::size_t line = 0;
      for (std::size_t k = 0; k < section.corners; ++k) {
        const std::int64_t v = lines_.integer(lines_.expect_word("entry " + what), "a vertex of entry " + what);
        if (k == 0) line = lines_.number();
        used_.push_back({v, lines_.number()});
        corners[k] = static_cast<Index>(std::clamp<std::int64_t>(v - 1, 0, std::numeric_limits<Index>::max()));
      }
      lines_.expect_word("the reference of entry " + what);
      add(section, corners, line);
    }
  }

  void add(const Section& section, const std::array<Index, 4>& c, std::size_t line) {
    if (section.keyword == "Tetrahedra") {
      mesh_.tetrahedra.push_back(c);
      mesh_.source.tetrahedra.push_back(static_cast<Index>(mesh_.source.tetrahedra.size()));
      mesh_.source.tetrahedron_lines.push_back(line);
    } else if (section.keyword == "Edges") {
      mesh_.loose_edges.push_back({std::min(c[0], c[1]), std::max(c[0], c[1])});
      mesh_.source.edge_lines.push_back(line);
    } else {
      mesh_.add_face(std::span(c).first(section.corners));
      mesh_.source.face_lines.push_back(line);
    }
  }

  /// Checks indices at the end, because elements may come before the vertices that they name.
  PolygonMesh finish() {
    for (const auto& [v, line] : used_)
      if (v < 1 || v > std::ssize(mesh_.positions))
        lines_.fail_at(line, "vertex " + std::to_string(v) + " does not exist; the file has " +
                                 std::to_string(mesh_.positions.size()) + ", numbered from 1");
    keep_solid(mesh_);
    if (mesh_.face_count() > 0 && !mesh_.loose_edges.empty()) {
      mesh_.notes.push_back(name_ + ": " + std::to_string(mesh_.loose_edges.size()) +
                            " edges were left out: Medit's are lines on the surface");
      mesh_.loose_edges.clear();
      mesh_.source.edge_lines.clear();
    }
    return std::move(mesh_);
  }

  struct Use {
    std::int64_t vertex;
    std::size_t line;
  };
  TextLines lines_;
  const std::string& name_;
  std::vector<Use> used_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_medit(std::string_view text, const std::string& name) { return MeditParser(text, name).parse(); }

}  // namespace ogc::compare
