// Implements the volumetric variant of §3.9 inside a body: the penetration depth of Chen, Diaz and Yuksel 2023,
// "Shortest Path to Boundary for Self-Intersecting Meshes". Follows the definition by brute force over all boundary
// triangles, so that a fast version can be judged.
//
// A tetrahedral mesh is a complex M with a map to space. The map may be locally injective and still cover a point of
// space more than once: the body overlaps itself. Each pre-image of a point in M is a *sheet*. A path in space is
// *valid* from a sheet if it is the image of a path in M that begins there. The depth of a point in a sheet is the
// length of the shortest valid path to the boundary of M. That path is a segment (otherwise a bend inside M could be
// cut short). It ends at the point of some boundary triangle that is closest to its start (otherwise the end could
// slide along that triangle). So the depth is the smallest distance to closest points of boundary triangles whose
// segments are valid. A segment is valid if M can be traversed along it: from a tetrahedron that holds the start in the
// sheet, through shared triangles, edges or vertices in the order of the segment, to the tetrahedron of the boundary
// triangle. If the segment reaches a triangle from the wrong side (that paper's infeasible region), it is not valid.
//
// All decisions are in rational arithmetic on the given coordinates.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Index;
using compare::Vec3f;

/// Four vertices; the volume is positive if the fourth lies on the side of the normal of the first three (right hand).
using Tetrahedron = std::array<Index, 4>;

/// A triangle of only one tetrahedron; its normal points outward.
struct BoundaryTriangle {
  compare::Triangle vertices{-1, -1, -1};  ///< counterclockwise as seen from outside
  Index tetrahedron = -1;                  ///< the tetrahedron whose face it is
};

/// The path from a point in a sheet to the closest point of one boundary triangle.
struct BoundaryPath {
  Index triangle = -1;          ///< index in `boundary()`
  bool valid = false;           ///< whether the segment to `end` lies in M
  std::array<double, 3> end{};  ///< the closest point [m], each coordinate within 1 ulp
  double length = 0;            ///< the path's length, rounded down [m]
  /// two adjacent doubles that enclose the exact squared length [m²]; both are the square if it is a double
  std::array<double, 2> squared_length{0, 0};
};

/// The depth of a point in a sheet.
struct BoundaryDepth {
  /// the shortest valid path; of equally short paths, the path to the triangle with the lowest index
  BoundaryPath path;
  std::vector<Index> equally_near;  ///< all boundary triangles with a valid path of exactly this length, ascending
  /// Number of strictly nearer boundary triangles without a valid path. If it is not 0, the Euclidean distance to the
  /// boundary ends at one of them.
  std::size_t refused = 0;
};

/// A body of tetrahedra. Holds views of arrays that must outlive it.
class TetVolume {
 public:
  /// Throws compare::InputError, naming the element, if a shortest path may bend or the map is not locally injective.
  /// Errors are
  ///
  ///   - an index that is no vertex, and an inverted or flat tetrahedron,
  ///   - a triangle with more than two tetrahedra, or with two on the same side of it,
  ///   - an inner edge around which tetrahedra do not wind once, and tetrahedra that only an inner vertex joins.
  TetVolume(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra);

  /// Returns the boundary triangles, ordered by tetrahedron, then by the corner opposite to them.
  const std::vector<BoundaryTriangle>& boundary() const { return boundary_; }

  /// Returns whether the vertex is one of the tetrahedron's corners.
  bool has_vertex(Index tetrahedron, Index vertex) const;

  /// Returns the sheets at a point of space, each as the ascending indices of its tetrahedra; empty outside. A sheet
  /// has several tetrahedra if the point lies on a shared triangle, edge or vertex.
  std::vector<std::vector<Index>> sheets(const Vec3f& x) const;

  /// Returns the paths from x to all boundary triangles, in the order of the triangles. x lies in the sheet of
  /// `tetrahedron`. Throws compare::InputError if the tetrahedron does not hold x.
  std::vector<BoundaryPath> boundary_paths(const Vec3f& x, Index tetrahedron) const;

  /// Returns the depth d_p (zero on the boundary). In the offset geometry of §3.9, the depth is d_p + r. Throws like
  /// `boundary_paths`.
  BoundaryDepth shortest_path_to_boundary(const Vec3f& x, Index tetrahedron) const;

 private:
  struct Candidate;
  std::vector<Candidate> candidates(const Vec3f& x, Index tetrahedron) const;
  BoundaryPath path(Index triangle, const Candidate& candidate, bool valid) const;
  std::span<const Vec3f> positions_;
  std::span<const Tetrahedron> tetrahedra_;
  std::vector<BoundaryTriangle> boundary_;
  std::vector<std::vector<Index>> tetrahedra_of_;  ///< by vertex, ascending
};

}  // namespace ogc::reference
