// Computes the distance of two edges in rounded double, with a bound of its error, the slack. Exact signs find the
// faces that hold the closest points. Nearly parallel edges follow method.md §1.4. The distance is convex in both
// parameters, so the first-order conditions of a pair of faces decide whether these faces hold the closest points. No
// system is solved.
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

/// Names the faces of two edges that hold their closest points.
struct EdgePairFeatures {
  EdgeFeature first = EdgeFeature::interior, second = EdgeFeature::interior;
  bool nearly_parallel = false;  ///< set by is_overlapping_parallel; closest_edge_features leaves it false
};

/// Returns the smallest distance between an end of one edge and the other edge [m]. e and f are the edges, w is the
/// start of f minus the start of e.
OGC_HD inline double smallest_end_distance(const Real& w, const Real& e, const Real& f) {
  const double of_first = smaller(squared_to_segment(-w, f), squared_to_segment(e - w, f));
  return square_root(smaller(of_first, smaller(squared_to_segment(w, e), squared_to_segment(w + f, e))));
}

/// Returns the distance of the two closed edges, with its slack.
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

/// Returns the faces that hold the closest points, at any angle. If several pairs of faces are equally near (parallel
/// edges, or edges of zero length), returns the first of them.
OGC_HD inline EdgePairFeatures closest_edge_features(const Ends& p, const Ends& q) {
  // p_before[i][j]: end i of p does not project beyond end j of q; q_before: the same with p and q exchanged
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

/// Returns whether two edges are nearly parallel, and their projections onto the line of p overlap in more than a
/// point. p must be the lower-numbered edge.
OGC_HD inline bool is_overlapping_parallel(const Ends& p, const Ends& q) {
  if (exact_sign(NearlyParallel{p.a, p.b, q.a, q.b}) <= 0) return false;
  const bool reaches_a = exact_sign(End{q.a, p.a, p.b}) > 0 || exact_sign(End{q.b, p.a, p.b}) > 0;
  return reaches_a && (exact_sign(End{q.a, p.b, p.a}) > 0 || exact_sign(End{q.b, p.b, p.a}) > 0);
}

/// Returns whether the edges are nearer than r. `on` is the result of closest_edge_features, `d` the distance. If d is
/// within its slack of r, an exact predicate decides.
OGC_HD inline bool is_within(const Ends& p, const Ends& q, EdgePairFeatures on, const Distance& d, float r) {
  if (modulus(sub(d.value, static_cast<double>(r))) > d.slack) return d.value < static_cast<double>(r);
  const bool first_inside = on.first == EdgeFeature::interior, second_inside = on.second == EdgeFeature::interior;
  if (first_inside && second_inside) return exact_sign(PlaneReach{q.a, p.a, p.b, q.a, q.b, r}) < 0;
  if (first_inside) return exact_sign(LineReach{q[static_cast<int>(on.second)], p.a, p.b, r}) < 0;
  if (second_inside) return exact_sign(LineReach{p[static_cast<int>(on.first)], q.a, q.b, r}) < 0;
  return exact_sign(PointReach{p[static_cast<int>(on.first)], q[static_cast<int>(on.second)], r}) < 0;
}

/// Holds the parameters of two points on two edges, from 0 at the first end to 1 at the second.
struct EdgeParameters {
  double first = 0, second = 0;
};

/// Returns one end of the overlap of two nearly parallel edges, as parameters on p and on the line of q. This end is
/// q[end] or, if q[end] projects beyond p, the nearest end of p. The parameter on q is computed from q[end]. If it were
/// computed from an end of p, it would have the rounding error of p's length, which is 10⁷ times as large if p is 10⁷
/// times as long as q.
OGC_HD inline EdgeParameters overlap_end(const Ends& p, const Ends& q, int end) {
  const Real e = difference<Rounded>(p.b, p.a), f = difference<Rounded>(q.b, q.a), u = difference<Rounded>(q[end], p.a);
  const double along = dot(u, e).value, ee = squared(e), ff = squared(f);
  if (!(along > 0)) return {0, divide(dot(difference<Rounded>(p.a, q.a), f).value, ff)};
  if (!(along < ee)) return {1, divide(dot(difference<Rounded>(p.b, q.a), f).value, ff)};
  return {divide(along, ee), sub(end, divide(divide(dot(cross(e, u), cross(e, f)).value, ee), ff))};
}

/// Clamps s to [0, 1].
OGC_HD inline double clamped_parameter(double s) { return smaller(larger(s, 0.0), 1.0); }

/// Returns the parameter of the overlap's middle on the first edge, and of the middle's projection on the closed second
/// edge.
OGC_HD inline EdgeParameters overlap_parameters(const Ends& p, const Ends& q) {
  const EdgeParameters from = overlap_end(p, q, 0), to = overlap_end(p, q, 1);
  return {mul(0.5, add(from.first, to.first)), clamped_parameter(mul(0.5, add(from.second, to.second)))};
}

/// Returns the parameters of the points between which the force acts; `on` are the faces that hold these points. For
/// nearly parallel edges they are the middle of the overlap and its projection (method.md §1.4), not the closest
/// points.
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
