// Decides whether a point meets the conditions of a block of Eq. 8, 9 or 15, except the condition on its distance. The
// same polynomials decide the closest face, so that both decisions agree. The file also rejects pairs of edges for
// which single precision proves that they are no contact.
#pragma once

#include "fast/kernels/predicates.hpp"
#include "fast/kernels/separation.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// Returns whether x meets the conditions of U_v, except the condition on the distance: x projects beyond v on every
/// edge at v (Eq. 8; Eq. 15 if x is a vertex).
OGC_HD inline bool in_vertex_block(const Vec& x, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(End{x, positions[v], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// Returns whether x meets the conditions of U_e (Eq. 9), except the condition on the distance: for every triangle at
/// e, x lies on the outer side of e. Precondition: x projects into the interior of e.
OGC_HD inline bool in_edge_block(const Vec& x, int e, const SurfaceView& surface, PaddedVecs positions) {
  const EdgeEnds& ends = surface.edges[e];
  const Rows& rows = surface.opposites;
  for (int k = rows.offsets[e]; k < rows.offsets[e + 1]; ++k) {
    if (exact_sign(Side{x, positions[ends.a], positions[ends.b], positions[rows.items[k]]}) > 0) return false;
  }
  return true;
}

/// Returns whether the point of edge `other` nearest to v meets the conditions of U_v (Eq. 15); the distance is not
/// tested. Precondition: this point is in the interior of the edge.
OGC_HD inline bool in_vertex_block(const EdgeEnds& other, int v, const SurfaceView& surface, PaddedVecs positions) {
  const Rows& rows = surface.neighbours;
  for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
    if (exact_sign(Receding{positions[v], positions[rows.items[k]], positions[other.a], positions[other.b]}) < 0)
      return false;
  }
  return true;
}

// The functions below reject pairs of edges that may be near but certainly are no contact: single precision proves
// this. If edges are shorter than r, nearly every pair within r is rejected: in a rod, each edge with its second
// neighbour; between two crossing rods, all pairs but the nearest.
//
// Let v be an end of an edge, v + g its other end, c the point of the other edge nearest to v, and d = c − v. The
// distance between a point of one edge and a point of the other is convex. Moving c along its edge never reduces it.
// If d·g < 0, moving v along its edge increases it, so v is the only closest point of its edge. A contact of the two
// edges would then be a contact of v, which requires that c is in the block of v. But c is not in this block if d·(w −
// v) > 0 for a neighbour w of v: if c is inside its edge, Receding is < 0, and if c is an end, End is > 0
// (predicates.hpp), so in_vertex_block returns false. Nearly parallel edges that overlap may have contacts elsewhere
// (method.md §1.4), so they are never rejected.
//
// Rounding: let u = 2⁻²⁴, F the edge of c, and S the sum of the 1-norms of F and of the vector from v to the start of
// F. A difference errs by u of itself, a dot product by 6 u of the product of the lengths. So the parameter of c times
// ‖F‖ errs by 16 u S, d by 24 u S, d·g by 32 u S ‖g‖₁. The code uses 64 u S ‖g‖₁, plus a limit of the error that
// underflow causes.

/// Exceeds the error that underflow causes in a sum of products of two lengths [m²], if squared edges exceed 2⁻¹⁰⁰ m².
inline constexpr float lost_to_underflow = 0x1p-120F;

/// Returns whether `product`, which is d·g or −d·g, is certainly positive; d errs by at most `error` [m].
OGC_HD inline bool is_surely_above_0(float product, const Vec& g, float error) {
  return product > error * norm_1(g) + lost_to_underflow;
}

/// Returns whether v certainly has no contact with the edge `other`: the distance to `other` certainly grows from v
/// towards `inner`, the other end of v's edge, and certainly falls from v towards some neighbour of v.
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

/// Returns whether two edges without a common vertex certainly have no contact; p is the lower-numbered one. If the
/// result is false, it is not known whether they have a contact.
OGC_HD inline bool is_surely_no_contact(const EdgeEnds& p, const EdgeEnds& q, const SurfaceView& surface,
                                        PaddedVecs x) {
  const Vec a = x[p.a], e = x[p.b] - a, f = x[q.b] - x[q.a], w = x[q.a] - a;
  const float ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), we = dot(w, e), wf = dot(w, f);
  // `nn` approximates ‖e × f‖² with an error below 2⁻¹⁸ ‖e‖² ‖f‖². Nearly parallel edges have ‖e × f‖² < 10⁻⁶ ‖e‖²
  // ‖f‖², so nn > 2⁻¹³ ‖e‖² ‖f‖² proves that the edges are not nearly parallel.
  const float nn = ee * ff - ef * ef;
  const bool is_skew = nn > larger(0x1p-13F * (ee * ff), 0x1p-100F);
  const float error = 0x1p-18F * (norm_1(w) + norm_1(e) + norm_1(f)) * norm_1(e) + lost_to_underflow;
  const bool is_beside = larger(we, we + ef) < -error || smaller(we, we + ef) > ee + error;
  if (!is_skew && !is_beside) return false;
  // Approximates the parameters s and t of the closest points. They only choose the ends that is_passed_over tests, and
  // is_passed_over returns false for a wrong end.
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
