// What messages call the elements of a mesh: as its file counts them, with line and body where there are any, so that a
// user finds them there.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

struct Scene;

/// Where the elements of a mesh stand in the file that it was read from. Numbers "in the file" are from 0 here;
/// messages add `first`.
struct MeshSource {
  std::string file;             ///< where the elements stand
  Index first = 0;              ///< the number that the file gives its first vertex and face: 1 in OBJ
  bool shares_vertices = true;  ///< false: its faces have corners of their own (STL), and no vertex has a number
  std::vector<Index> vertices;  ///< number in the file, by vertex, ascending; empty: its own
  std::vector<Index>
      first_faces;  ///< number in the file of the first face that has it, by vertex; only without shared vertices
  std::vector<Index> faces;  ///< number in the file, by triangle: several of them may be of one face. Empty: its own
  std::vector<std::size_t> vertex_lines, face_lines,
      edge_lines;  ///< from 1, by number in the file; empty where it has no lines
  /// Of tetrahedra, by number in the mesh: the file's number, and the line from 1.
  std::vector<Index> tetrahedra{};
  std::vector<std::size_t> tetrahedron_lines{};
};

/// Of each body of a scene in turn; where it is null, or there are fewer, the mesh of the body comes from no file.
using MeshSources = std::vector<std::shared_ptr<const MeshSource>>;

/// Names by number in the mesh or scene. An element that no body covers has its number alone.
class ElementNames {
 public:
  ElementNames() = default;
  /// Of a mesh: "vertex 4 (line 4)", "face 1 (vertices 1, 2, 3; line 7)".
  explicit ElementNames(MeshSource source);
  /// Of a scene, body by body: "triangle 0 of body 'sheet' (vertices 0, 1, 2; 6 in the scene)", "face 1 of body 'sheet'
  /// (…; sheet.obj, line 7; …)".
  explicit ElementNames(const Scene& scene, const MeshSources& sources = {});

  std::string vertex(Index v) const;  ///< "vertex 3", with its line in the file
  /// "vertices 3, 4"; empty where the file gives vertices no numbers.
  std::string vertices(std::span<const Index> list) const;
  std::string triangle(Index t, const Triangle& corners) const;
  /// An edge has no number in any file: "edge (vertices 3, 4; lines 4, 5)".
  std::string edge(const Edge& ends) const;
  std::string loose_edge(Index e, const Edge& ends) const;
  /// "tetrahedron 7 (vertices 1, 2, 3, 4; line 40)".
  std::string tetrahedron(Index t, const Tetrahedron& corners) const;

 private:
  struct NamedBody {
    std::string name;                          ///< empty: a mesh that stands alone
    Index first_vertex = 0, last_vertex = -1;  ///< none where last is before first
    Index first_triangle = 0, first_edge = 0, first_tetrahedron = 0;
    std::shared_ptr<const MeshSource> source;
  };
  const NamedBody& body_at(Index vertex) const;
  const NamedBody& body_of_triangle(Index t) const;
  std::string name(const std::string& kind, const NamedBody& body, const std::vector<std::string>& details) const;
  std::vector<NamedBody> bodies_;  ///< by first vertex and first triangle
};

}  // namespace ogc::compare
