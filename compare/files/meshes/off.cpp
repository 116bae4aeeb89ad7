#include "compare/files/meshes/off.hpp"

#include <algorithm>

#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// Fewest bytes of a vertex ("0 0 0" and a line end) and of a face ("1 0" and a line end).
constexpr std::size_t least_vertex = 6, least_face = 4;

class OffParser {
 public:
  OffParser(std::string_view text, const std::string& name) : lines_(text, name, {.comment = '#'}), name_(name) {
    mesh_.source.file = name;
  }

  PolygonMesh parse() {
    header();
    // The counts are checked against the file's size, and memory grows line by line.
    for (std::size_t v = 0; v < vertices_; ++v) {
      lines_.expect_filled("vertex " + std::to_string(v) + " of " + std::to_string(vertices_));
      const double x = lines_.coordinate(), y = lines_.coordinate(), z = lines_.coordinate();
      mesh_.positions.push_back({x, y, z});
      mesh_.source.vertex_lines.push_back(lines_.number());
    }
    for (std::size_t f = 0; f < faces_; ++f) {
      lines_.expect_filled("face " + std::to_string(f) + " of " + std::to_string(faces_));
      face(f);
    }
    if (lines_.next_filled())
      lines_.fail("stands behind the last of the " + std::to_string(faces_) +
                  " faces that are announced; mend the counts at the top, or remove what follows");
    if (points_ > 0)
      mesh_.notes.push_back(name_ + ": " + std::to_string(points_) +
                            " of the faces are single points and were left out");
    return std::move(mesh_);
  }

 private:
  /// Reads the word that ends in OFF, if there is one, and the counts. Some programs leave the word out.
  void header() {
    lines_.expect_filled("OFF");
    std::string_view word = lines_.word();
    if (word.ends_with("OFF")) {
      const std::string_view kind = word.substr(0, word.size() - 3);
      if (kind.find_first_of("4n") != std::string_view::npos)
        lines_.fail("'" + shown(word) + "' has vertices of another dimension than three; write it as OFF");
      if (kind.find_first_not_of("STCN") != std::string_view::npos)
        lines_.fail("'" + shown(word) + "' is no kind of OFF that is read; write it as OFF");
      word = lines_.word();
      if (word == "BINARY") lines_.fail("the file is binary: write it as text");
      if (word.empty()) {
        lines_.expect_filled("the numbers of vertices and faces");
        word = lines_.word();
      }
    }
    double ignored = 0;
    if (!parse_number(word, ignored))
      lines_.fail("'" + shown(word) + "' is no number of vertices; an OFF file begins with OFF and its counts");
    vertices_ = lines_.count(word, "number of vertices", least_vertex);
    faces_ = lines_.count(lines_.word(), "number of faces", least_face);
  }

  void face(std::size_t f) {
    const std::size_t corners = lines_.count(lines_.word(), "number of corners of face " + std::to_string(f));
    face_.clear();
    for (std::size_t k = 0; k < corners; ++k) {
      const std::string_view word = lines_.word();
      std::int64_t v = 0;
      if (!parse_number(word, v))
        lines_.integer(
            word, "corner " + std::to_string(k) + " of " + std::to_string(corners) + " of face " + std::to_string(f));
      if (v < 0 || v >= std::ssize(mesh_.positions))
        lines_.fail("face " + std::to_string(f) + ": vertex " + std::to_string(v) + " does not exist; the file has " +
                    std::to_string(mesh_.positions.size()) + ", numbered from 0");
      face_.push_back(static_cast<Index>(v));
    }
    if (corners < 2) {
      ++points_;
    } else if (corners == 2) {
      mesh_.loose_edges.push_back({std::min(face_[0], face_[1]), std::max(face_[0], face_[1])});
      mesh_.source.edge_lines.push_back(lines_.number());
    } else {
      mesh_.add_face(face_);
      mesh_.source.face_lines.push_back(lines_.number());
    }
  }

  TextLines lines_;
  const std::string& name_;
  std::size_t vertices_ = 0, faces_ = 0, points_ = 0;
  std::vector<Index> face_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_off(std::string_view text, const std::string& name) { return OffParser(text, name).parse(); }

}  // namespace ogc::compare
