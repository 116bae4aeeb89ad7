// The volumetric variant of §3.9, inside the body: the penetration depth of Chen, Diaz and Yuksel 2023, "Shortest Path
// to Boundary for Self-Intersecting Meshes", by its definition and by brute force over all boundary triangles, so that
// a fast version can be judged.
//
// A tetrahedral mesh is a complex M with a map to space. Where the map is locally injective, space may still be covered
// more than once: the body overlaps itself. A point of the body is then a point in space together with a *sheet*, one
// of its pre-images in M. A path in space is *valid* from a sheet if it is the image of a path in M that begins there.
// The depth of a point in a sheet is the length of the shortest valid path that ends on the boundary of M. That path is
// a segment (otherwise it could be cut short at a bend inside M), and its end is the point of some boundary triangle
// that is closest to its start (otherwise it could slide along that triangle). So the candidates are the closest points
// of all boundary triangles, and the depth is the smallest distance of those whose segment is valid. A segment is valid
// from a sheet if M can be traversed along it: from a tetrahedron that holds the start in that sheet, from tetrahedron
// to tetrahedron through shared triangles, edges or vertices in the order in which the segment meets them, to the
// tetrahedron of the boundary triangle. A point for which the closest point of a triangle is reached from the wrong
// side, the infeasible region of that paper, has no such way.
//
// All of it is decided in rational arithmetic, on the coordinates as given.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

using compare::Index;
using compare::Vec3f;

/// Four vertices; positive where the fourth lies on the side of the first three's normal (right hand).
using Tetrahedron = std::array<Index, 4>;

/// A triangle of only one tetrahedron, its normal outward.
struct BoundaryTriangle {
  compare::Triangle vertices{-1, -1, -1};  ///< counterclockwise as seen from outside
  Index tetrahedron = -1;                  ///< the tetrahedron whose face it is
};

/// The closest point of one boundary triangle to a point in a sheet.
struct BoundaryPath {
  Index triangle = -1;          ///< number in `boundary()`
  bool valid = false;           ///< whether the segment to it lies in M
  std::array<double, 3> end{};  ///< the closest point [m], each coordinate within 1 ulp
  double length = 0;            ///< its distance, rounded down [m]
  /// Adjacent doubles, or twice the same one, that enclose the exact square [m²].
  std::array<double, 2> squared_length{0, 0};
};

/// The depth of a point in a sheet.
struct BoundaryDepth {
  /// The shortest valid path; of several equally short ones that with the lowest triangle.
  BoundaryPath path;
  std::vector<Index> equally_near;  ///< all boundary triangles with a valid path exactly that short, ascending
  /// Boundary triangles strictly nearer than that without a valid path: those that Euclid's distance would have given.
  std::size_t refused = 0;
};

/// A body of tetrahedra. Views plain arrays, which must outlive it.
class TetVolume {
 public:
  /// Throws compare::InputError, with the element, where a tetrahedron has an index that is no vertex, is inverted or
  /// flat, where a triangle has more than two tetrahedra or two on the same side, where tetrahedra wind around an inner
  /// edge other than once, and where tetrahedra are joined by an inner vertex alone: the map is not locally injective
  /// there and a shortest path may bend. Inverted tetrahedra are refused, not handled.
  TetVolume(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra);

  /// Returns the boundary triangles, by tetrahedron, then by the corner that is left out.
  const std::vector<BoundaryTriangle>& boundary() const { return boundary_; }

  /// Returns whether the vertex is one of the tetrahedron's corners.
  bool has_vertex(Index tetrahedron, Index vertex) const;

  /// Returns the sheets at a point of space, each as its tetrahedra, ascending; a sheet has several where the point
  /// lies on a shared triangle, edge or vertex. Empty outside.
  std::vector<std::vector<Index>> sheets(const Vec3f& x) const;

  /// Returns the candidates of all boundary triangles, in their order, for x in the sheet of a tetrahedron that holds
  /// it. Throws compare::InputError where it does not hold x.
  std::vector<BoundaryPath> boundary_paths(const Vec3f& x, Index tetrahedron) const;

  /// Returns the depth d_p (zero on the boundary). §3.9's depth in the offset geometry is d_p + r. Throws like
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
