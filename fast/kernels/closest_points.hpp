// Computes the distance of two edges in rounded double, with a derived slack, and the faces that hold the closest
// points, by exact signs. Nearly parallel edges follow method.md §1.4. The distance is convex in both parameters, so a
// pair of faces is right if and only if its own first-order conditions hold: no system is solved.
#pragma once

#include "compare/stages/closest_points.hpp"
#include "fast/kernels/predicates.hpp"
#include "fast/kernels/segment.hpp"

namespace ogc::fast {

using compare::EdgeFeature;

/// Holds the two ends of an edge, the lower-numbered vertex first.
template <class T>
struct EndsOf {
  Vector<T> a, b;  ///< [m]

  OGC_HD const Vector<T>& operator[](int k) const { return k == 0 ? a : b; }
};
using Ends = EndsOf<float>;

/// The faces of two edges that hold their closest points.
struct EdgePairFeatures {
  EdgeFeature first = EdgeFeature::interior, second = EdgeFeature::interior;
  bool nearly_parallel = false;  ///< set by is_overlapping_parallel; closest_edge_features leaves it false
};

/// Returns the smallest distance of an end of one edge from the other edge [m]. e and f are the edges; w goes from the
/// start of e to the start of f.
OGC_HD inline double smallest_end_distance(const Real& w, const Real& e, const Real& f) {
  const double of_first = smaller(squared_to_segment(-w, f), squared_to_segment(e - w, f));
  return square_root(smaller(of_first, smaller(squared_to_segment(w, e), squared_to_segment(w + f, e))));
}

/// Returns the distance of the two closed edges.
///
/// Slack, with θ the angle and S = ‖w‖₁ + ‖e‖₁ + ‖f‖₁ ≥ ‖w‖: the normal's direction errs by 32 roundings of 1/θ, the
/// place of the foot by 32 roundings of S/θ². The foot's error changes the distance by θ times as much: under 2⁻⁴⁷ S/θ.
/// At θ < 2⁻²³ no points of two edges are nearer than an end by more than θ ‖shorter‖. Below θ = 2⁻⁸ the distance is
/// computed from a point of one edge to the other, never between the lines, because lines can meet beyond the ends of
/// the edges.
OGC_HD inline Distance edge_edge_distance(const Ends& p, const Ends& q) {
  const Real e = difference<Rounded>(p.b, p.a), f = difference<Rounded>(q.b, q.a), w = difference<Rounded>(q.a, p.a),
             n = cross(e, f);
  const double ee = squared(e), ff = squared(f), nn = squared(n), whole = mul(ee, ff);
  const double size = add(norm_1(w), add(norm_1(e), norm_1(f)));
  if (!(nn > mul(0x1p-46, whole))) {
    return {smallest_end_distance(w, e, f), add(mul(0x1p-46, size), mul(0x1p-23, square_root(smaller(ee, ff))))};
  }
  const bool skew = nn >= mul(0x1p-16, whole);
  const double slack = skew ? mul(0x1p-38, size) : mul(mul(0x1p-46, size), square_root(divide(whole, nn)));
  const double ef = dot(e, f).value, we = dot(w, e).value, wf = dot(w, f).value;
  const double s = sub(mul(we, ff), mul(ef, wf)), t = sub(mul(we, ef), mul(ee, wf));
  if (!(s > 0 && s < nn && t > 0 && t < nn)) return {smallest_end_distance(w, e, f), slack};
  if (skew) return {divide(modulus(dot(w, n).value), square_root(nn)), slack};
  const double of_point = square_root(squared_to_segment(Rounded{divide(s, nn)} * e - w, f));
  return {smaller(of_point, smallest_end_distance(w, e, f)), slack};
}

/// Returns the faces that hold the closest points, at any angle. Parallel or zero-length edges may have several equally
/// near pairs of faces: then the first in order.
OGC_HD inline EdgePairFeatures closest_edge_features(const Ends& p, const Ends& q) {
  // p_before[i][j]: end i of p lies before end j of q, seen along q; q_before: the same with p and q exchanged
  bool p_before[2][2], q_before[2][2];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      p_before[i][j] = exact_sign(End{p[i], q[j], q[1 - j]}) > 0;
      q_before[i][j] = exact_sign(End{q[i], p[j], p[1 - j]}) > 0;
    }
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (!p_before[i][j] && !q_before[j][i]) return {static_cast<EdgeFeature>(i), static_cast<EdgeFeature>(j), false};
    }
  }
  for (int i = 0; i < 2; ++i) {
    if (p_before[i][0] && p_before[i][1] && exact_sign(Receding{p[i], p[1 - i], q.a, q.b}) >= 0) {
      return {static_cast<EdgeFeature>(i), EdgeFeature::interior, false};
    }
    if (q_before[i][0] && q_before[i][1] && exact_sign(Receding{q[i], q[1 - i], p.a, p.b}) >= 0) {
      return {EdgeFeature::interior, static_cast<EdgeFeature>(i), false};
    }
  }
  return {};
}

/// Returns whether nearly parallel edges have projections that overlap in more than a point. They are projected onto
/// the line of p, the lower-numbered edge.
OGC_HD inline bool is_overlapping_parallel(const Ends& p, const Ends& q) {
  if (exact_sign(NearlyParallel{p.a, p.b, q.a, q.b}) <= 0) return false;
  const bool reaches_a = exact_sign(End{q.a, p.a, p.b}) > 0 || exact_sign(End{q.b, p.a, p.b}) > 0;
  return reaches_a && (exact_sign(End{q.a, p.b, p.a}) > 0 || exact_sign(End{q.b, p.b, p.a}) > 0);
}

/// Returns whether the edges are nearer than r, given the faces `on` of closest_edge_features; decides exactly if the
/// slack does not.
OGC_HD inline bool is_within(const Ends& p, const Ends& q, EdgePairFeatures on, const Distance& d, float r) {
  if (modulus(sub(d.value, static_cast<double>(r))) > d.slack) return d.value < static_cast<double>(r);
  const bool first_inside = on.first == EdgeFeature::interior, second_inside = on.second == EdgeFeature::interior;
  if (first_inside && second_inside) return exact_sign(PlaneReach{q.a, p.a, p.b, q.a, q.b, r}) < 0;
  if (first_inside) return exact_sign(LineReach{q[static_cast<int>(on.second)], p.a, p.b, r}) < 0;
  if (second_inside) return exact_sign(LineReach{p[static_cast<int>(on.first)], q.a, q.b, r}) < 0;
  return exact_sign(PointReach{p[static_cast<int>(on.first)], q[static_cast<int>(on.second)], r}) < 0;
}

/// Parameters of the contact points on the two edges, from 0 at the first end to 1 at the second.
struct EdgeParameters {
  double first = 0, second = 0;
};

/// Returns one end of the overlap of two nearly parallel edges, on p and projected on the line of q: q's end or, if
/// that lies beyond p, p's. At q's end the parameter of q is measured from that end. Measured from p's end, a
/// difference would be rounded at the size of p: 10⁷ roundings of an edge that is 10⁻⁷ as long.
OGC_HD inline EdgeParameters overlap_end(const Ends& p, const Ends& q, int end) {
  const Real e = difference<Rounded>(p.b, p.a), f = difference<Rounded>(q.b, q.a), u = difference<Rounded>(q[end], p.a);
  const double along = dot(u, e).value, ee = squared(e), ff = squared(f);
  if (!(along > 0)) return {0, divide(dot(difference<Rounded>(p.a, q.a), f).value, ff)};
  if (!(along < ee)) return {1, divide(dot(difference<Rounded>(p.b, q.a), f).value, ff)};
  return {divide(along, ee), sub(end, divide(divide(dot(cross(e, u), cross(e, f)).value, ee), ff))};
}

/// Clamps s to [0, 1].
OGC_HD inline double clamped_parameter(double s) { return smaller(larger(s, 0.0), 1.0); }

/// Returns the middle of the overlap on the first edge, and its projection on the closed second edge.
OGC_HD inline EdgeParameters overlap_parameters(const Ends& p, const Ends& q) {
  const EdgeParameters from = overlap_end(p, q, 0), to = overlap_end(p, q, 1);
  return {mul(0.5, add(from.first, to.first)), clamped_parameter(mul(0.5, add(from.second, to.second)))};
}

/// Returns the points between which the force acts, given the faces that hold them. For nearly parallel edges these are
/// the middle of the overlap and its projection (method.md §1.4), not the closest points.
OGC_HD inline EdgeParameters contact_parameters(const Ends& p, const Ends& q, EdgePairFeatures on) {
  if (on.nearly_parallel) return overlap_parameters(p, q);
  const Real e = difference<Rounded>(p.b, p.a), f = difference<Rounded>(q.b, q.a), w = difference<Rounded>(q.a, p.a);
  const double at_first = on.first == EdgeFeature::end_1 ? 1 : 0, at_second = on.second == EdgeFeature::end_1 ? 1 : 0;
  if (on.first != EdgeFeature::interior && on.second != EdgeFeature::interior) return {at_first, at_second};
  if (on.first != EdgeFeature::interior) return {at_first, segment_parameter(Rounded{at_first} * e - w, f)};
  if (on.second != EdgeFeature::interior) return {segment_parameter(w + Rounded{at_second} * f, e), at_second};
  const Real n = cross(e, f);
  const double nn = squared(n);
  return {clamped_parameter(divide(dot(cross(w, f), n).value, nn)),
          clamped_parameter(divide(dot(cross(w, e), n).value, nn))};
}

/// Returns the distance of the points at these parameters [m].
OGC_HD inline double points_distance(const Ends& p, const Ends& q, EdgeParameters at) {
  const Real e = difference<Rounded>(p.b, p.a), f = difference<Rounded>(q.b, q.a), w = difference<Rounded>(q.a, p.a);
  return square_root(squared(w + Rounded{at.second} * f - Rounded{at.first} * e));
}

}  // namespace ogc::fast
