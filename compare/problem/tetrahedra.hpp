// Tetrahedra: which faces they have, which of these are the surface, and on which side their volume lies
// (method.md §8).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// Returns the triangle opposite corner k, (1, 2, 3), (0, 3, 2), (0, 1, 3) or (0, 2, 1): its normal points out of a
/// tetrahedron of positive volume.
Triangle opposite_face(const Tetrahedron& tetrahedron, std::size_t k);

/// A face of a tetrahedron. Equal faces stand next to each other in order.
struct TetrahedronFace {
  Triangle vertices{};                  ///< ascending
  Index tetrahedron = -1, corner = -1;  ///< the tetrahedron, and the corner opposite the face
  bool even = false;                    ///< whether an even permutation of `vertices` is the outward orientation
  friend auto operator<=>(const TetrahedronFace&, const TetrahedronFace&) = default;
};

/// Returns all faces of all tetrahedra in that order; corners of each tetrahedron are distinct.
std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra);

/// Returns the surface: faces of exactly one tetrahedron, oriented outward, numbered by tetrahedron, then by the corner
/// left out.
std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra);

/// Returns for each vertex its Topology::component, with components joined under their lowest number where a
/// tetrahedron connects them, or where one holds a cavity and the other the surface around it
/// (VolumeDepthIn::cavities).
std::vector<Index> joined_components(const Topology& topology, std::span<const Tetrahedron> tetrahedra,
                                     std::span<const Edge> cavities = {});

/// Returns the sign of det(b − a, c − a, d − a), without rounding: 1 where the volume is positive, 0 where the points
/// lie in a plane. Coordinates are numbers of single precision.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace ogc::compare
