// The pairs of primitives that can meet, and those on which a barrier acts. One broad phase serves one whole motion:
// its boxes hold the whole way of each primitive, widened by d̂, so that the pairs found are those of a continuous
// detection and, filtered, those of every state on the way.
#pragma once

#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/mesh.hpp"
#include "reference/ipc/barrier.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// A vertex and a triangle, or two edges, the lower number first.
struct PrimitivePair {
  compare::ContactSides sides = compare::ContactSides::point_triangle;
  compare::Index first = -1, second = -1;
  friend auto operator<=>(const PrimitivePair&, const PrimitivePair&) = default;
};

/// The constant data of pairs. All of it must outlive the user.
struct PairMesh {
  const compare::Topology& topology;
  const compare::Exclusions& exclusions;          ///< pairs that are left out (compare::exclusions)
  const std::vector<float>& edge_length_squared;  ///< ‖ē‖² [m²]
};

/// Returns the vertices by place of the pair: vertex | triangle, or edge | edge.
std::array<compare::Index, 4> vertices_of(const compare::Topology& topology, const PrimitivePair& pair);
/// Returns the entries of `values` for four vertices.
std::array<Triple<double>, 4> corners_of(const std::array<compare::Index, 4>& vertex, const State& values);
/// Returns text such as "vertex 3 and triangle 7 (vertices 4, 5, 6)".
std::string describe(const compare::Topology& topology, const PrimitivePair& pair,
                     const compare::ElementNames& names = {});

/// Returns all pairs without a shared vertex, and not inside one rigid group, whose boxes come within `distance` [m] of
/// each other on the straight ways from `from` to `to`; each box holds its primitive's whole way. Ascending; threads
/// change nothing.
std::vector<PrimitivePair> near_pairs(const PairMesh& mesh, const State& from, const State& to, double distance);

/// Barriers at one state.
struct BarrierSet {
  /// Pairs with the same closest vertices and edges are merged into one term, with their number as its weight.
  std::vector<BarrierTerm> terms;
  std::vector<PrimitivePair> active;    ///< the pairs with 0 < gap < H, before merging
  std::vector<double> squared;          ///< their squared distances [m²]
  double smallest = 0;                  ///< smallest distance among them, or ξ + d̂ where there is none [m]
  PrimitivePair closest;                ///< the pair at this distance
  std::vector<PrimitivePair> touching;  ///< pairs without a gap, on which no barrier can act
};

/// Returns the barriers of `pairs` at x.
BarrierSet barriers_at(const PairMesh& mesh, const BarrierShape& shape, const std::vector<PrimitivePair>& pairs,
                       const State& x);

}  // namespace ogc::reference
