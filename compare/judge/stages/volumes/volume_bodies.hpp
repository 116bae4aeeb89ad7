// Makes volumes and points near them in a canonical frame, and turns them into cases of volume_depth.
#pragma once

#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare::volume_bodies {

constexpr int points_a_volume = 24;

inline Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double inner(const Vec3& a, const Vec3& b);
Vec3 outer(const Vec3& a, const Vec3& b);
double norm(const Vec3& a);
/// Returns a/‖a‖; (0, 0, 1) if ‖a‖ is 0.
Vec3 unit(const Vec3& a);

/// A volume in its canonical frame, of a size of about 1. Triangles are counterclockwise as seen from outside.
struct VolumeBody {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  std::vector<Tetrahedron> tetrahedra{};  ///< tetrahedra, whose boundary is among the triangles
  std::vector<Edge> cavities{};           ///< pairs of vertices, as in VolumeDepthIn

  void append(const VolumeBody& other, double scale, const Vec3& shift);
  /// Appends another body inside out, as a cavity of the component that contains vertex `owner`.
  void append_void(VolumeBody other, double scale, Index owner);
  Vec3 normal(Index t) const;
  /// Returns the triangles at a vertex.
  std::vector<Index> around(Index vertex) const;
  /// Returns the other triangle at the edge from corner k of t; t if there is none.
  Index across(Index t, std::size_t k) const;
};

/// A place for points: a foot on the surface, and the outward direction at the foot.
struct Place {
  Vec3 foot, outward;
  double edge = 1;  ///< about the length of an edge at the foot
};

/// Returns a place in the interior of a triangle.
Place over_triangle(Random& random, const VolumeBody& body);
/// Returns a place at an edge. Its direction is between the normals of both triangles, or one rung from one of them.
Place over_edge(Random& random, const VolumeBody& body);
/// Returns a place at a vertex. Its direction is in the cone of the triangles' normals, or one rung from one of them.
Place over_vertex(Random& random, const VolumeBody& body);
Place any_place(Random& random, const VolumeBody& body);

using Points = std::vector<Vec3>;

/// Applies a symmetry of the cube to body and points, rotates them in half of the cases, and scales them. Triangles
/// stay counterclockwise and volumes positive. Triangles are shuffled, because answers must not depend on their order.
/// own[i] is the index of the vertex at point i, or −1; `own` is empty if no point is a vertex.
VolumeDepthCase placed(Random& random, VolumeBody body, Points points, double radius, bool may_turn, double scale,
                       std::vector<Index> own = {});

double some_scale(Random& random);
double some_radius(Random& random);

/// Checks whether a triangle's height is at least 2⁻²⁰ of its longest side. Below that, single precision cannot
/// determine foot and normal.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ogc::compare::volume_bodies
