// Decides membership in the blocks of Eq. 8, 9 and 15, apart from the distance, with the polynomials that also decide
// the closest face, for all faces around. Also rejects pairs of edges that single precision proves to be in no block.
#pragma once

#include "fast/kernels/predicates.hpp"
#include "fast/kernels/separation.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// Returns whether x is in U_v apart from its distance (Eq. 8; Eq. 15 for a point that is a vertex): beyond v along
/// every edge at v.
OGC_HD inline bool in_vertex_block(const Vec& x, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(End{x, positions[v], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// Returns whether x is in U_e apart from its distance, given that it lies between the two end planes (Eq. 9): on the
/// far side of every triangle at e.
OGC_HD inline bool in_edge_block(const Vec& x, int e, const SurfaceView& surface, PaddedVecs positions) {
  const EdgeEnds& ends = surface.edges[e];
  const Rows& rows = surface.opposites;
  for (int k = rows.offsets[e]; k < rows.offsets[e + 1]; ++k) {
    if (exact_sign(Side{x, positions[ends.a], positions[ends.b], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// Returns whether the point of edge `other` nearest to v, inside that edge, lies in U_v (Eq. 15) apart from its
/// distance.
OGC_HD inline bool in_vertex_block(const EdgeEnds& other, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(Receding{positions[v], positions[rows.items[k]], positions[other.a], positions[other.b]}) < 0)
      return false;
  }
  return true;
}

// Pairs of edges that single precision proves to be no contact, however near they are. If edges are shorter than r that
// is nearly every pair within r: within a rod the next edges but one, between two crossing rods all pairs but the
// nearest.
//
// Let v be an end of an edge, v + g its other end, c the point of the other edge nearest to v, and d = c − v. The
// distance of two points, one of each edge, is convex. At (v, c) no move of c lessens it; if d·g < 0, no move of v does
// either, and each lengthens it: v is the only closest point of its edge. So a contact of the two edges would be one of
// v, and c would lie in the block of v. It does not if d·(w − v) > 0 for a neighbour w of v: with c inside its edge
// this is Receding < 0, with c at its end it is End > 0 (predicates.hpp), and in_vertex_block refuses both. Nearly
// parallel edges that overlap are contacts elsewhere, too (method.md §1.4): they are never rejected.
//
// Rounding: let u = 2⁻²⁴, F the edge of c, and S the sum of the 1-norms of F and of the vector from v to the start of
// F. A difference errs by u of itself, a dot product by 6 u of the product of the lengths; so the parameter of c times
// ‖F‖ errs by 16 u S, d by 24 u S, d·g by 32 u S ‖g‖₁. The code takes 64 u S ‖g‖₁, plus more than all that underflow
// may lose.

/// More than underflow takes from a sum of products of two lengths, if squared edges are above 2⁻¹⁰⁰ [m²].
inline constexpr float lost_to_underflow = 0x1p-120F;

/// Returns whether `product`, ±d·g, is positive for certain; d errs by at most `error` [m].
OGC_HD inline bool is_surely_above_0(float product, const Vec& g, float error) {
  return product > error * norm_1(g) + lost_to_underflow;
}

/// Returns whether no contact of v with the edge `other` is possible because the distance from it falls from v to a
/// neighbour, and v is nearer to it than all other points of the edge from v to `inner`.
OGC_HD inline bool is_passed_over(int v, int inner, const EdgeEnds& other, const SurfaceView& surface, PaddedVecs x) {
  const Vec at = x[v], f = x[other.b] - x[other.a], from = x[other.a] - at;
  const float ff = dot(f, f);
  if (!(ff > 0x1p-100F && ff < 0x1p100F)) return false;
  const Vec d = from + clamped(rough_quotient(-dot(from, f), ff)) * f;
  const float error = 0x1p-18F * (norm_1(from) + norm_1(f));
  const Vec inwards = x[inner] - at;
  if (!is_surely_above_0(-dot(d, inwards), inwards, error)) return false;
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    const Vec g = x[rows.items[k]] - at;
    if (is_surely_above_0(dot(d, g), g, error)) return true;
  }
  return false;
}

/// Returns whether two edges without a common vertex are no contact for certain; p is the lower-numbered one. False
/// decides nothing.
OGC_HD inline bool is_surely_no_contact(const EdgeEnds& p, const EdgeEnds& q, const SurfaceView& surface,
                                        PaddedVecs x) {
  const Vec a = x[p.a], e = x[p.b] - a, f = x[q.b] - x[q.a], w = x[q.a] - a;
  const float ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), we = dot(w, e), wf = dot(w, f);
  // ‖e × f‖² here errs by less than 2⁻¹⁸ ‖e‖² ‖f‖²; above 2⁻¹³ of it no edges are nearly parallel.
  const float nn = ee * ff - ef * ef;
  const bool is_skew = nn > larger(0x1p-13F * (ee * ff), 0x1p-100F);
  const float error = 0x1p-18F * (norm_1(w) + norm_1(e) + norm_1(f)) * norm_1(e) + lost_to_underflow;
  const bool is_beside = larger(we, we + ef) < -error || smaller(we, we + ef) > ee + error;
  if (!is_skew && !is_beside) return false;
  // A rough guess of the closest points suffices: is_passed_over refuses a wrong end.
  float s = clamped(is_skew ? rough_quotient(we * ff - ef * wf, nn) : rough_quotient(we, ee));
  const float t = clamped(rough_quotient(s * ef - wf, ff));
  s = clamped(rough_quotient(we + t * ef, ee));
  for (int side = 0; side < 2; ++side) {
    const float place = side == 0 ? s : t;
    const EdgeEnds own = side == 0 ? p : q, other = side == 0 ? q : p;
    const bool is_at_end = place == 0 || place == 1;
    if (is_at_end && is_passed_over(place == 0 ? own.a : own.b, place == 0 ? own.b : own.a, other, surface, x))
      return true;
  }
  return false;
}

}  // namespace ogc::fast
