// Names the elements of a mesh in messages by the numbers, lines and bodies of its file, so that a user finds them
// there.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

struct Scene;

/// Holds where the elements of a mesh are in the file that it was read from. A "number in the file" counts from 0 here;
/// messages add `first`.
struct MeshSource {
  std::string file;             ///< path of the file
  Index first = 0;              ///< the number that the file gives its first vertex and face: 1 in OBJ
  bool shares_vertices = true;  ///< false: each face has its own corners (STL), and vertices have no numbers
  std::vector<Index> vertices;  ///< by vertex: number in the file, ascending; if empty, the number in the mesh
  /// by vertex: number in the file of the first face that has the vertex; only if !shares_vertices
  std::vector<Index> first_faces;
  /// by triangle: number in the file; all triangles of one polygon have the same. If empty, the number in the mesh
  std::vector<Index> faces;
  std::vector<std::size_t> vertex_lines, face_lines,
      edge_lines;  ///< from 1, by number in the file; empty in files without lines
  /// by tetrahedron: number in the file, and line (from 1)
  std::vector<Index> tetrahedra{};
  std::vector<std::size_t> tetrahedron_lines{};
};

/// One source for each body of a scene; null or missing if the body's mesh comes from no file.
using MeshSources = std::vector<std::shared_ptr<const MeshSource>>;

/// Names elements by their number in the mesh or scene. An element that belongs to no body is named by its number
/// alone.
class ElementNames {
 public:
  ElementNames() = default;
  /// Names the elements of a mesh: "vertex 4 (line 4)", "face 1 (vertices 1, 2, 3; line 7)".
  explicit ElementNames(MeshSource source);
  /// Names the elements of a scene by body: "triangle 0 of body 'sheet' (vertices 0, 1, 2; 6 in the scene)", "face 1 of
  /// body 'sheet' (…; sheet.obj, line 7; …)".
  explicit ElementNames(const Scene& scene, const MeshSources& sources = {});

  std::string vertex(Index v) const;  ///< "vertex 3", with its line in the file
  /// Returns "vertices 3, 4"; empty if the file numbers no vertices.
  std::string vertices(std::span<const Index> list) const;
  std::string triangle(Index t, const Triangle& corners) const;
  /// Returns "edge (vertices 3, 4; lines 4, 5)", since no file numbers edges.
  std::string edge(const Edge& ends) const;
  std::string loose_edge(Index e, const Edge& ends) const;
  /// Returns "tetrahedron 7 (vertices 1, 2, 3, 4; line 40)".
  std::string tetrahedron(Index t, const Tetrahedron& corners) const;

 private:
  struct NamedBody {
    std::string name;                          ///< empty for a mesh outside of a scene
    Index first_vertex = 0, last_vertex = -1;  ///< no vertices if last < first
    Index first_triangle = 0, first_edge = 0, first_tetrahedron = 0;
    std::shared_ptr<const MeshSource> source;
  };
  const NamedBody& body_at(Index vertex) const;
  const NamedBody& body_of_triangle(Index t) const;
  std::string name(const std::string& kind, const NamedBody& body, const std::vector<std::string>& details) const;
  std::vector<NamedBody> bodies_;  ///< ascending by first vertex and by first triangle
};

}  // namespace ogc::compare
