// Holds a mesh as its file gives it: faces of any number of corners, unused vertices, and one vertex for each corner if
// faces share none. make_mesh makes a mesh of triangles from it, with a sentence for each change; options may forbid
// changes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// A mesh of polygons. All indices are valid; positions are finite. `triangles` is empty, because the polygons replace
/// them.
struct PolygonMesh : Mesh {
  std::vector<Index> corners;        ///< corners of all faces, face after face
  std::vector<Index> face_ends{};    ///< by face: index in `corners` after its last corner
  MeshSource source;                 ///< places of its elements in the file
  std::vector<std::string> notes{};  ///< contents of the file that the mesh lacks

  std::size_t face_count() const { return face_ends.size(); }  ///< number of polygons
  /// Returns the corners of polygon f, in its order.
  std::span<const Index> face(std::size_t f) const {
    const auto begin = static_cast<std::size_t>(f == 0 ? 0 : face_ends[f - 1]);
    return std::span(corners).subspan(begin, static_cast<std::size_t>(face_ends[f]) - begin);
  }
  void add_face(std::span<const Index> face);  ///< adds a polygon
};

/// Selects the allowed changes. A change that is not allowed is an error, whose message names the option of `ogc` that
/// allows it.
struct MeshOptions {
  bool triangulate = true;  ///< cut faces of four corners and more (compare/files/meshes/triangulate.hpp)
  bool drop_unused = true;  ///< leave out vertices that belong to no face and no edge
  bool weld = false;  ///< merge vertices with exactly equal coordinates; formats without shared vertices (STL, glTF)
                      ///< are always welded
  /// keep unused vertices and do not check positions, because another file gives the vertices and positions
  bool keep_unused = false;
  bool strict = false;  ///< refuse collapsed, zero-area and repeated faces, and inverted tetrahedra
  /// also leave out triangles that have no area once dust is 0 and coordinates are rounded to single precision, as
  /// stages see them
  bool rounded = false;
  /// make positions relative to a point near them if they are far from 0 compared with their extent
  /// (compare::local_origin)
  bool local = false;
  friend bool operator==(const MeshOptions&, const MeshOptions&) = default;
};

/// Holds a mesh, the places of its elements in the file, and a sentence for each change made while reading. The
/// triangles of a mesh of tetrahedra are their boundary.
struct LoadedMesh {
  Mesh mesh;                       ///< of triangles
  MeshSource source;               ///< places of its elements in the file
  std::vector<std::string> notes;  ///< changes that were made, for the user
  Vec3 origin{};                   ///< point that positions are relative to, in the file's coordinates [m]
};

/// Leaves out faces and loose edges, with a note, if the mesh has tetrahedra, because the tetrahedra determine the
/// solid's surface.
void keep_solid(PolygonMesh& mesh);

/// Makes a mesh of triangles. Leaves out, with a note, faces that name fewer than three different vertices or have no
/// area (decided exactly), faces with the same vertices as an earlier face, in any order, and vertices that are then
/// unused. If all tetrahedra are inverted, exchanges two vertices of each. Throws InputError that names the first face
/// or vertex that the options do not allow, or a face that can't be cut.
LoadedMesh make_mesh(PolygonMesh polygons, const MeshOptions& options = {});

}  // namespace ogc::compare
