// A small mesh under construction, in units of about one edge length, and its way to a case: jitter, symmetry, scale,
// radii.
#pragma once

#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

/// Meshes are added one after another; numbers of vertices continue.
struct MeshBuilder {
  std::vector<Vec3> points;                    ///< in edge lengths
  std::vector<Triangle> triangles;             ///< by numbers of points
  std::vector<Edge> loose_edges;               ///< edges of no triangle
  std::vector<Index> groups;                   ///< as in Exclusions; filled with -1 where it is short
  std::vector<std::array<Index, 2>> excluded;  ///< pairs of vertices, as in Exclusions

  Index add(const Vec3& point);  ///< the number of the new vertex
  /// (nx + 1) × (ny + 1) vertices at origin + i u + j v, two triangles a cell.
  void grid(int nx, int ny, const Vec3& origin, const Vec3& u, const Vec3& v);
  /// `count` triangles about a centre at `centre`, closed to a disk or open, rim at distance 1, raised by `rise` (a
  /// cone).
  void fan(int count, const Vec3& centre, bool closed, double rise);
  /// A polyline of loose edges from `start`, in `count` steps.
  void strand(int count, const Vec3& start, const Vec3& step);
  /// Adds another mesh, shifted.
  void append(const MeshBuilder& part, const Vec3& shift);
  /// Copies all that there is, shifted.
  void repeat(const Vec3& shift) { append(MeshBuilder(*this), shift); }
  /// Puts the vertices from `first` on into a group.
  void group(Index first, Index number);
};

/// What a family asks of `finish`.
struct MeshPlan {
  double jitter = 0;          ///< largest shift of each coordinate, in edge lengths
  double contact_radius = 0;  ///< r in edge lengths; 0: random, 10^−2 … 10^0.4
};

/// Jitter, one symmetry of the cube (with a rotation in half of the plans that have jitter, in all fine ones), a scale
/// of 1, 2^±10, 2^±18 or 1000, and r_q = r × 1 … 4.
MeshCase finish(Random& random, MeshBuilder builder, const MeshPlan& plan);

/// A zigzag strip of `count` triangles in the plane z = 0, count + 2 vertices, edges of about 1.
Mesh triangle_strip(int count);

/// A curve of loose edges for a rod (compare/judge/cases/rods/). In edge lengths, about the origin, in the plane z = 0
/// but for `jitter`.
struct RodPlan {
  int segments = 4;     ///< of the curve
  bool closed = false;  ///< a ring; of 3 segments at least
  int branches = 0;     ///< short chains that leave vertices of the curve
  double bend = 0.3;    ///< angle between segments [rad]
  double jitter = 0.1;  ///< of each coordinate
};

/// A curve of a random kind.
RodPlan some_rod(Random& random);

/// Its vertices in order of the curve, then those of branches; each edge runs its way or the other.
Mesh rod_mesh(Random& random, const RodPlan& plan);

/// Makes a body of such a mesh a rod, with stiffness k_s of about `stretch` [N], bending about as stiff at segments of
/// that length [m], and ρ so that a vertex weighs about `mass` [kg].
void make_rod(Random& random, Body& body, double stretch, double length, double mass);

}  // namespace ogc::compare
