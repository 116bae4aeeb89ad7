// Stage bound: the conservative bound of each vertex from the smallest distances (Eq. 21, 23, 25).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Input of the stage: smallest distances of all faces of a mesh. It holds views; their owner must outlive the call.
struct BoundIn {
  const Topology* topology = nullptr;                               ///< of the mesh
  std::span<const float> d_min_vertex, d_min_edge, d_min_triangle;  ///< [m], by vertex, edge, triangle
  float bounds_relaxation = 0.45f;                                  ///< γ_p
};

/// The answer.
struct BoundOut {
  /// b_v [m], by vertex; never above γ_p · min(…). The largest finite number for a vertex inside a solid
  /// (Topology::on_surface), which needs no bound.
  std::vector<float> bound;
};

/// The exact bound: the largest single-precision number that is not above the real product.
struct BoundTruth {
  BoundOut exact;  ///< rounded down
};

/// Largest amount by which a right bound may be too small, in units of u · b, u = 2⁻²⁴. A bound that is too large is
/// always wrong. A product rounded down errs by 2 u, and a kernel may round to nearest and then step down once more (2
/// u).
inline constexpr double bound_below_tolerance = 4;

}  // namespace ogc::compare
