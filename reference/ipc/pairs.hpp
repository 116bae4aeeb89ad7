// Finds the pairs of primitives that can meet, and the pairs with a barrier. One broad phase serves a whole motion: its
// boxes hold the whole motion of each primitive, widened by d̂. So its pairs contain all pairs that continuous
// detection tests, and all pairs with a barrier at any state of the motion.
#pragma once

#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/mesh.hpp"
#include "reference/ipc/barrier.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// A vertex and a triangle, or two edges, the lower index first.
struct PrimitivePair {
  compare::ContactSides sides = compare::ContactSides::point_triangle;
  compare::Index first = -1, second = -1;
  friend auto operator<=>(const PrimitivePair&, const PrimitivePair&) = default;
};

/// Holds views of the constant data of pairs. The owners of the data must outlive this.
struct PairMesh {
  const compare::Topology& topology;
  const compare::Exclusions& exclusions;          ///< pairs that are left out (compare::exclusions)
  const std::vector<float>& edge_length_squared;  ///< ‖ē‖² [m²]
};

/// Returns the vertices of the pair: the vertex and the triangle's corners, or the ends of both edges.
std::array<compare::Index, 4> vertices_of(const compare::Topology& topology, const PrimitivePair& pair);
/// Returns the entries of `values` for four vertices.
std::array<Triple<double>, 4> corners_of(const std::array<compare::Index, 4>& vertex, const State& values);
/// Returns text such as "vertex 3 and triangle 7 (vertices 4, 5, 6)".
std::string describe(const compare::Topology& topology, const PrimitivePair& pair,
                     const compare::ElementNames& names = {});

/// Returns all pairs whose boxes come within `distance` [m] of each other, ascending. A box holds the primitive's
/// straight motion from `from` to `to`. Pairs that share a vertex or are excluded are left out. The result does not
/// depend on the number of threads.
std::vector<PrimitivePair> near_pairs(const PairMesh& mesh, const State& from, const State& to, double distance);

/// Barriers at one state.
struct BarrierSet {
  /// pairs with the same closest vertices and edges share one term, whose weight is the number of these pairs
  std::vector<BarrierTerm> terms;
  std::vector<PrimitivePair> active;    ///< pairs with 0 < gap < H (BarrierShape), before merging
  std::vector<double> squared;          ///< squared distances of the active pairs [m²]
  double smallest = 0;                  ///< smallest distance of active pairs, or ξ + d̂ if there is none [m]
  PrimitivePair closest;                ///< the pair at the smallest distance
  std::vector<PrimitivePair> touching;  ///< pairs with a gap ≤ 0, for which no barrier is defined
};

/// Returns the barriers of `pairs` at x.
BarrierSet barriers_at(const PairMesh& mesh, const BarrierShape& shape, const std::vector<PrimitivePair>& pairs,
                       const State& x);

}  // namespace ogc::reference
