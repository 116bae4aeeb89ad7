// Builds a small mesh whose edges are about 1 long, and turns it into a case by jitter, symmetry, scale and radii.
#pragma once

#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

/// Collects parts of a mesh; vertices are numbered in the order in which they are added.
struct MeshBuilder {
  std::vector<Vec3> points;         ///< in edge lengths
  std::vector<Triangle> triangles;  ///< by indices of points
  std::vector<Edge> loose_edges;
  std::vector<Index> groups;                   ///< as in Exclusions; if short, finish fills it with −1
  std::vector<std::array<Index, 2>> excluded;  ///< pairs of vertices, as in Exclusions

  Index add(const Vec3& point);  ///< Returns the index of the new vertex.
  /// Adds (nx + 1) × (ny + 1) vertices at origin + i u + j v, with two triangles per cell.
  void grid(int nx, int ny, const Vec3& origin, const Vec3& u, const Vec3& v);
  /// Adds `count` triangles about a vertex at `centre`: a whole disk if `closed`, otherwise an open fan. The outer
  /// vertices are at distance 1 from the axis and lower than `centre` by `rise` (a cone).
  void fan(int count, const Vec3& centre, bool closed, double rise);
  /// Adds a polyline of `count` loose edges that begins at `start`.
  void strand(int count, const Vec3& start, const Vec3& step);
  /// Adds another mesh, shifted.
  void append(const MeshBuilder& part, const Vec3& shift);
  /// Adds a shifted copy of the whole mesh.
  void repeat(const Vec3& shift) { append(MeshBuilder(*this), shift); }
  /// Puts all vertices from index `first` on into a group.
  void group(Index first, Index number);
};

/// Parameters of `finish`.
struct MeshPlan {
  double jitter = 0;          ///< largest shift of each coordinate, in edge lengths
  double contact_radius = 0;  ///< r in edge lengths; 0: random in 10^−2 … 10^0.4
};

/// Turns the mesh into a case: applies jitter, one symmetry of the cube, a scale of 1, 2^±10, 2¹⁴, 2⁻¹⁸ or 1000, and
/// r_q = r × 1 … 4. A mesh with jitter is also rotated: every time if the case is fine, otherwise in half of the cases.
MeshCase finish(Random& random, MeshBuilder builder, const MeshPlan& plan);

/// Returns a zigzag strip of `count` triangles in the plane z = 0, with count + 2 vertices and edges of about 1.
Mesh triangle_strip(int count);

/// A curve of loose edges about the origin, from which a rod is made (compare/judge/cases/rods/). Lengths are in edge
/// lengths. The curve is planar (z = 0) except for `jitter`.
struct RodPlan {
  int segments = 4;     ///< along the curve
  bool closed = false;  ///< true: a ring of at least 3 segments
  int branches = 0;     ///< number of short chains that begin at vertices of the curve
  double bend = 0.3;    ///< angle between segments [rad]
  double jitter = 0.1;  ///< largest shift of each coordinate
};

/// Returns a curve of a random kind.
RodPlan some_rod(Random& random);

/// Returns the curve as a mesh: first the vertices along the curve, then the vertices of branches. The direction of
/// each edge is random.
Mesh rod_mesh(Random& random, const RodPlan& plan);

/// Turns a body made by rod_mesh into a rod. Its stretch stiffness k_s is about `stretch` [N]. For segments of length
/// `length` [m] bending is about as stiff as stretch. The density gives each vertex a mass of about `mass` [kg].
void make_rod(Random& random, Body& body, double stretch, double length, double mass);

}  // namespace ogc::compare
