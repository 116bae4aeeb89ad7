// Membership in the blocks of Eq. 8, 9 and 15, beyond the distance: the same polynomials that tell the closest face,
// for all faces around.
#pragma once

#include "fast/kernels/predicates.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// x in U_v apart from its distance (Eq. 8; Eq. 15 for a point that is a vertex): beyond v along every edge at v.
OGC_HD inline bool in_vertex_block(const Vec& x, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(End{x, positions[v], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// x in U_e apart from its distance, given that it lies between the two end planes (Eq. 9): on the far side of every
/// triangle at e.
OGC_HD inline bool in_edge_block(const Vec& x, int e, const SurfaceView& surface, PaddedVecs positions) {
  const EdgeEnds& ends = surface.edges[e];
  const Rows& rows = surface.opposites;
  for (int k = rows.offsets[e]; k < rows.offsets[e + 1]; ++k) {
    if (exact_sign(Side{x, positions[ends.a], positions[ends.b], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// The point of edge `other` nearest to v, inside that edge, lies in U_v (Eq. 15) apart from its distance.
OGC_HD inline bool in_vertex_block(const EdgeEnds& other, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(Receding{positions[v], positions[rows.items[k]], positions[other.a], positions[other.b]}) < 0)
      return false;
  }
  return true;
}

}  // namespace ogc::fast
