// Finds the faces of tetrahedra, the faces that form the surface, and the side on which the volume lies (method.md §8).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// Returns the triangle opposite corner k: (1, 2, 3), (0, 3, 2), (0, 1, 3) or (0, 2, 1). Its normal points out of a
/// tetrahedron of positive volume.
Triangle opposite_face(const Tetrahedron& tetrahedron, std::size_t k);

/// A face of a tetrahedron. The order puts equal faces next to each other.
struct TetrahedronFace {
  Triangle vertices{};                  ///< ascending
  Index tetrahedron = -1, corner = -1;  ///< the tetrahedron, and the corner opposite the face
  bool even = false;                    ///< whether an even permutation of `vertices` is the outward orientation
  friend auto operator<=>(const TetrahedronFace&, const TetrahedronFace&) = default;
};

/// Returns all faces of all tetrahedra, sorted. The corners of each tetrahedron must be distinct.
std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra);

/// Returns the surface: the faces of exactly one tetrahedron, oriented outward, ordered by tetrahedron, then by
/// opposite corner.
std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra);

/// Returns the joined component of each vertex. Two components (Topology::component) are joined if a tetrahedron
/// connects them, and a cavity is joined with the surface around it (VolumeDepthIn::cavities). The lowest number of the
/// joined components names them.
std::vector<Index> joined_components(const Topology& topology, std::span<const Tetrahedron> tetrahedra,
                                     std::span<const Edge> cavities = {});

/// Returns the sign of det(b − a, c − a, d − a), decided exactly: 1 for a positive volume, 0 for points in a plane.
/// Coordinates must be numbers of single precision.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace ogc::compare
