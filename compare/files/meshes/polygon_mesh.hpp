// A mesh as its file gives it: faces of any number of corners, vertices that nothing uses, corners that each face
// repeats. make_mesh turns it into a mesh of triangles, with a sentence for each change; options refuse changes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// All indices are valid; positions are finite.
struct PolygonMesh {
  std::vector<Vec3> positions;            ///< [m]
  std::vector<Index> corners;             ///< of all faces, one after the other, each in its own order
  std::vector<Index> face_ends{};         ///< by face: end of its corners
  std::vector<Edge> loose_edges;          ///< edges of no face
  std::vector<Tetrahedron> tetrahedra{};  ///< by numbers of vertices
  MeshSource source;  ///< file, first number, lines; the numbers of vertices and faces are still the file's
  std::vector<std::string> notes{};  ///< what the file has and the mesh has not

  std::size_t face_count() const { return face_ends.size(); }  ///< number of polygons
  /// The corners of polygon f, in its order.
  std::span<const Index> face(std::size_t f) const {
    const auto begin = static_cast<std::size_t>(f == 0 ? 0 : face_ends[f - 1]);
    return std::span(corners).subspan(begin, static_cast<std::size_t>(face_ends[f]) - begin);
  }
  void add_face(std::span<const Index> face);  ///< one more polygon
};

/// What may be changed. What may not be is refused, and the message names the option of `ogc` that allows it.
struct MeshOptions {
  bool triangulate = true;  ///< cut faces of four corners and more (compare/files/meshes/triangulate.hpp)
  bool drop_unused = true;  ///< leave out vertices that belong to no face and no edge
  bool weld = false;  ///< merge vertices with exactly equal coordinates; formats without shared vertices (STL, glTF)
                      ///< are always welded
  /// neither leave them out nor refuse them, and ask nothing of positions: where another file counts the vertices of
  /// this one, and has the positions
  bool keep_unused = false;
  bool strict = false;  ///< refuse what is no face (collapsed, without area, there twice) and inverted tetrahedra
  /// what has no area once dust is 0 and coordinates are rounded to single precision is left out, too: as stages see it
  bool rounded = false;
  /// positions that lie far from 0 for their size are taken relative to a point near them (compare::local_origin)
  bool local = false;
  friend bool operator==(const MeshOptions&, const MeshOptions&) = default;
};

/// A mesh, where its elements stand in the file, and a sentence for each thing that was taken otherwise than it stands
/// there. Of tetrahedra the triangles are the boundary.
struct LoadedMesh {
  Mesh mesh;                       ///< of triangles
  MeshSource source;               ///< where its elements come from
  std::vector<std::string> notes;  ///< what was changed on the way, for the user
  Vec3 origin{};                   ///< what positions are relative to, in the file's coordinates [m]
};

/// Where there are tetrahedra, leaves faces and loose edges out, with a word: the surface of a solid follows from them.
void keep_solid(PolygonMesh& mesh);

/// Left out, with a word: faces that name less than three different vertices or have no area (decided exactly), all but
/// the first of those with the same vertices, whichever way round, and vertices that nothing uses then. Tetrahedra that
/// are inverted, all of them, are turned. Throws InputError that names the first face or vertex that the options do not
/// take, and faces that can't be cut.
LoadedMesh make_mesh(PolygonMesh polygons, const MeshOptions& options = {});

}  // namespace ogc::compare
