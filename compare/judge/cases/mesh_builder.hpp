// Builds a small mesh in units of about one edge length, and turns it into a case by jitter, symmetry, scale and radii.
#pragma once

#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

/// Adds meshes one after another; numbers of vertices continue.
struct MeshBuilder {
  std::vector<Vec3> points;                    ///< in edge lengths
  std::vector<Triangle> triangles;             ///< by numbers of points
  std::vector<Edge> loose_edges;               ///< edges without a triangle
  std::vector<Index> groups;                   ///< as in Exclusions; filled with -1 where it is short
  std::vector<std::array<Index, 2>> excluded;  ///< pairs of vertices, as in Exclusions

  Index add(const Vec3& point);  ///< Returns the number of the new vertex.
  /// Adds (nx + 1) × (ny + 1) vertices at origin + i u + j v, with two triangles a cell.
  void grid(int nx, int ny, const Vec3& origin, const Vec3& u, const Vec3& v);
  /// Adds `count` triangles about a vertex at `centre`, closed to a disk or open, with the rim at distance 1 and
  /// lowered by `rise` (a cone).
  void fan(int count, const Vec3& centre, bool closed, double rise);
  /// Adds a polyline of loose edges from `start`, in `count` steps.
  void strand(int count, const Vec3& start, const Vec3& step);
  /// Adds another mesh, shifted.
  void append(const MeshBuilder& part, const Vec3& shift);
  /// Adds a shifted copy of the whole mesh.
  void repeat(const Vec3& shift) { append(MeshBuilder(*this), shift); }
  /// Puts the vertices from `first` on into a group.
  void group(Index first, Index number);
};

/// What a family of meshes tells `finish`.
struct MeshPlan {
  double jitter = 0;          ///< largest shift of each coordinate, in edge lengths
  double contact_radius = 0;  ///< r in edge lengths; 0: random, 10^−2 … 10^0.4
};

/// Turns the mesh into a case: applies jitter, one symmetry of the cube (with a rotation in half of the plans that have
/// jitter, in all fine ones), a scale of 1, 2^±10, 2¹⁴, 2⁻¹⁸ or 1000, and r_q = r × 1 … 4.
MeshCase finish(Random& random, MeshBuilder builder, const MeshPlan& plan);

/// Returns a zigzag strip of `count` triangles in the plane z = 0, with count + 2 vertices and edges of about 1.
Mesh triangle_strip(int count);

/// A curve of loose edges for a rod (compare/judge/cases/rods/), in edge lengths, about the origin, in the plane z = 0
/// except for `jitter`.
struct RodPlan {
  int segments = 4;     ///< number along the curve
  bool closed = false;  ///< a ring of at least 3 segments
  int branches = 0;     ///< number of short chains that leave vertices of the curve
  double bend = 0.3;    ///< angle between segments [rad]
  double jitter = 0.1;  ///< largest shift of each coordinate
};

/// Returns a curve of a random kind.
RodPlan some_rod(Random& random);

/// Returns the curve's vertices in order, then those of branches; each edge runs in one direction or the other.
Mesh rod_mesh(Random& random, const RodPlan& plan);

/// Makes a body of a rod_mesh a rod with stiffness k_s of about `stretch` [N], bending about as stiff at segments of
/// that length [m], and ρ so that a vertex weighs about `mass` [kg].
void make_rod(Random& random, Body& body, double stretch, double length, double mass);

}  // namespace ogc::compare
