// Tetrahedra: which faces they have, which of these are the surface, and on which side their volume lies
// (method.md §8).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// The triangle opposite corner k, (1, 2, 3), (0, 3, 2), (0, 1, 3) or (0, 2, 1): its normal points out of a tetrahedron
/// of positive volume.
Triangle opposite_face(const Tetrahedron& tetrahedron, std::size_t k);

/// A face of a tetrahedron. `vertices` ascending; `even`: an even permutation of them is the outward orientation.
/// Equal faces stand next to each other in order.
struct TetrahedronFace {
  Triangle vertices{};                  ///< ascending
  Index tetrahedron = -1, corner = -1;  ///< whose face it is, and the corner opposite it
  bool even = false;                    ///< see above
  friend auto operator<=>(const TetrahedronFace&, const TetrahedronFace&) = default;
};

/// All faces of all tetrahedra in that order; corners of each tetrahedron are distinct.
std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra);

/// The surface: faces of exactly one tetrahedron, oriented outward, numbered by tetrahedron, then by the corner left
/// out.
std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra);

/// By vertex: Topology::component, those that tetrahedra connect, or a cavity's vertex and one of the surface around it
/// (VolumeDepthIn::cavities), joined under the lowest of their numbers.
std::vector<Index> joined_components(const Topology& topology, std::span<const Tetrahedron> tetrahedra,
                                     std::span<const Edge> cavities = {});

/// The sign of det(b − a, c − a, d − a), without rounding: 1 where the volume is positive, 0 where the points lie in a
/// plane. Coordinates are numbers of single precision.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace ogc::compare
