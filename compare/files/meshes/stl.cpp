#include "compare/files/meshes/stl.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "compare/files/byte_cursor.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::size_t header_size = 84, facet_size = 50;  ///< in a binary file [bytes]

PolygonMesh empty_mesh(const std::string& name) {
  PolygonMesh mesh;
  mesh.source.file = name;
  mesh.source.shares_vertices = false;
  return mesh;
}

void add_facet(const std::vector<Vec3>& corners, PolygonMesh& mesh) {
  std::vector<Index> face;
  for (const Vec3& corner : corners) {
    face.push_back(static_cast<Index>(mesh.positions.size()));
    mesh.positions.push_back(corner);
  }
  mesh.add_face(face);
}

std::string lower(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

class TextParser {
 public:
  TextParser(std::string_view text, const std::string& name) : lines_(text, name), mesh_(empty_mesh(name)) {}

  PolygonMesh parse() {
    for (std::string_view word = lines_.far_word(); !word.empty(); word = lines_.far_word()) {
      expect(word, "solid");
      solid();
    }
    return std::move(mesh_);
  }

 private:
  /// Reads a solid to its end. The solid's name is the rest of the first line.
  void solid() {
    const std::size_t begin = lines_.number();
    if (!lines_.next_filled()) cut("the solid of line " + std::to_string(begin));
    while (true) {
      const std::string_view word = lines_.far_word();
      if (word.empty()) cut("the solid of line " + std::to_string(begin));
      if (const std::string keyword = lower(word); keyword == "endsolid") break;
      expect(word, "facet");
      facet();
    }
    for (std::string_view rest = lines_.word(); !rest.empty(); rest = lines_.word()) {}
  }

  void facet() {
    const std::size_t begin = lines_.number();
    expect(next_of_facet(begin), "normal");
    for (int k = 0; k < 3; ++k) next_of_facet(begin);  // normals are often no numbers, and are not needed
    expect(next_of_facet(begin), "outer");
    expect(next_of_facet(begin), "loop");
    std::vector<Vec3> corners;
    std::string_view word = next_of_facet(begin);
    for (; lower(word) == "vertex"; word = next_of_facet(begin)) {
      const double x = lines_.coordinate(next_of_facet(begin)), y = lines_.coordinate(next_of_facet(begin));
      corners.push_back({x, y, lines_.coordinate(next_of_facet(begin))});
    }
    expect(word, "endloop");
    expect(next_of_facet(begin), "endfacet");
    if (corners.size() < 3)
      lines_.fail(name_of_facet(begin) + " has " + std::to_string(corners.size()) +
                  " vertices; a facet has three: remove or mend it");
    add_facet(corners, mesh_);
    mesh_.source.face_lines.push_back(begin);
  }

  std::string name_of_facet(std::size_t line) const {
    return "facet " + std::to_string(mesh_.face_count()) + " (line " + std::to_string(line) + ")";
  }

  std::string_view next_of_facet(std::size_t begin) {
    const std::string_view word = lines_.far_word();
    if (word.empty()) cut(name_of_facet(begin));
    return word;
  }

  [[noreturn]] void cut(const std::string& within) const {
    lines_.fail("the file ends here, within " + within + ": it is truncated; write it again");
  }

  void expect(std::string_view word, const char* keyword) const {
    if (lower(word) != keyword)
      lines_.fail("'" + shown(word) + "' stands where '" + keyword + "' should; it is no STL file, or it is damaged");
  }

  TextLines lines_;
  PolygonMesh mesh_;
};

PolygonMesh parse_binary(std::string_view bytes, const std::string& name) {
  ByteCursor cursor(bytes, name, std::endian::little);
  cursor.skip(header_size - 4);
  const auto facets = cursor.number<std::uint32_t>("the number of facets");
  const std::string announced = std::to_string(facets) + " facets that its header announces";
  if (const std::size_t whole = cursor.left() / facet_size; whole < facets)
    throw InputError(name + ": ends within facet " + std::to_string(whole) + " of the " + announced + ", at byte " +
                     std::to_string(bytes.size()) + ": the file is truncated; write it again");
  if (const std::size_t more = cursor.left() - facet_size * facets; more > 0)
    throw InputError(name + ": " + std::to_string(more) + " bytes follow the " + announced +
                     ": header and data disagree, so the file is damaged; write it again");
  PolygonMesh mesh = empty_mesh(name);
  for (std::size_t f = 0; f < facets; ++f) {
    cursor.skip(12);  // the normal
    std::vector<Vec3> corners(3);
    for (Vec3& p : corners) {
      for (double* x : {&p.x, &p.y, &p.z}) *x = cursor.number<float>("a coordinate");
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(name + ": facet " + std::to_string(f) +
                         ": a coordinate is not finite; give three finite numbers [m]");
    }
    cursor.skip(2);  // attributes
    add_facet(corners, mesh);
  }
  return mesh;
}

bool is_binary(std::string_view bytes) {
  if (bytes.size() >= header_size) {
    const auto facets = number_at<std::uint32_t>(bytes.data() + header_size - 4, std::endian::little);
    if (bytes.size() - header_size == facet_size * std::size_t{facets}) return true;
  }
  if (lower(next_word(bytes)) != "solid") return true;
  const auto is_of_no_text = [](unsigned char c) { return c < '\t'; };
  return std::ranges::any_of(bytes.substr(0, 1000), is_of_no_text);
}

}  // namespace

PolygonMesh parse_stl(std::string_view bytes, const std::string& name) {
  return is_binary(bytes) ? parse_binary(bytes, name) : TextParser(bytes, name).parse();
}

}  // namespace ogc::compare
