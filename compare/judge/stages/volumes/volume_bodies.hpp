// Volumes and the points before them in a canonical frame, and the way from there to a case of volume_depth.
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
/// (0, 0, 1) for a vector without length.
Vec3 unit(const Vec3& a);

/// A volume in its canonical frame, about as large as 1, its triangles counterclockwise as seen from outside.
struct VolumeBody {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  std::vector<Tetrahedron> tetrahedra{};  ///< the triangles of those are their boundary
  std::vector<Edge> cavities{};           ///< as in VolumeDepthIn

  void append(const VolumeBody& other, double scale, const Vec3& shift);
  /// The other one turned inside out, as a cavity of the component that this vertex belongs to.
  void append_void(VolumeBody other, double scale, Index owner);
  Vec3 normal(Index t) const;
  /// Triangles at a vertex.
  std::vector<Index> around(Index vertex) const;
  /// The other triangle at the edge from corner k of t; t where there is none.
  Index across(Index t, std::size_t k) const;
};

/// Where a point stands: at a foot, and outward from there.
struct Place {
  Vec3 foot, outward;
  double edge = 1;  ///< about the length of an edge there
};

/// Over the interior of a triangle.
Place over_triangle(Random& random, const VolumeBody& body);
/// At an edge, between the normals of its triangles or a rung off one of them.
Place over_edge(Random& random, const VolumeBody& body);
/// At a vertex, within the cone of its triangles' normals or a rung off one of them.
Place over_vertex(Random& random, const VolumeBody& body);
Place any_place(Random& random, const VolumeBody& body);

using Points = std::vector<Vec3>;

/// Turned by a symmetry of the cube, in half of the cases rotated, and scaled; triangles stay counterclockwise and
/// volumes positive. Numbers mean nothing: triangles are shuffled. `own`: by point, the vertex that it is or −1; empty:
/// none is any.
VolumeDepthCase placed(Random& random, VolumeBody body, Points points, double radius, bool may_turn, double scale,
                       std::vector<Index> own = {});

double some_scale(Random& random);
double some_radius(Random& random);

/// Whether a triangle has an area: none lower than 2⁻²⁰ of its longest side is legal, whose foot and normal single
/// precision does not know.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ogc::compare::volume_bodies
