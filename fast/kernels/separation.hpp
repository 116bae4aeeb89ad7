// Computes lower bounds of distances in single precision. For most pairs of a search they prove that the pair is too
// far apart, so that its distance in double is not needed.
//
// For any direction d, the gap between the projections of two convex sets on d is at most their distance. It is equal
// to the distance if d joins the closest points. So d may be rough: an error of d only makes the bound lower, never
// wrong. Only the projections on d contribute errors: the difference of two points, a product, two sums, and two more
// sums where three projections are added. Together they err by 6 · 2⁻²⁴ ‖d‖₂ S, with S the sum of the 1-norms of the
// differences.
#pragma once

#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/closest_points.hpp"

namespace ogc::fast {

/// Returns a/b with a larger rounding error. The quotient only affects the direction d, which may be rough (see the
/// head of this file).
OGC_HD inline float rough_quotient(float a, float b) {
#if defined(__CUDA_ARCH__)
  return __fdividef(a, b);
#else
  return a / b;
#endif
}

/// Returns 1/√a with a relative error of at most 4 · 2⁻²⁴.
OGC_HD inline float rough_inverse_root(float a) {
#if defined(__CUDA_ARCH__)
  return rsqrtf(a);
#else
  return 1.0F / std::sqrt(a);
#endif
}

/// Returns ‖a‖₁.
template <class T>
OGC_HD T norm_1(const Vector<T>& a) {
  return absolute(a.x) + absolute(a.y) + absolute(a.z);
}

/// Clamps s to [0, 1].
template <class T>
OGC_HD T clamped(const T& s) {
  return smaller(larger(s, T{}), T{1.0F});
}

/// Returns the lower bound of the distance. `gap` is the gap of the projections on d, times ‖d‖; `dd` is d·d; `error`
/// is the error of `gap`, divided by ‖d‖ [m]. The factor covers the root and the products, which err by 8 · 2⁻²⁴.
/// Returns 0, which proves nothing, if d·d may have lost bits to underflow.
template <class T>
OGC_HD T separation(const T& gap, const T& dd, const T& error) {
  return select(dd > 0x1p-100F, gap * rough_inverse_root(dd) * (1 - 0x1p-20F) - error, T{});
}

/// Returns a lower bound of `edge_edge_distance(p, q).below()`, possibly negative or NaN. With u = 2⁻²⁴ the projections
/// err by 6 u S (see the head of this file). `below()` may be less than the exact distance by two slacks and one
/// rounding, at most 2 u S each. This is 12 u S in all; the code uses 16 u S.
template <class T>
OGC_HD T separation(const EndsOf<T>& p, const EndsOf<T>& q) {
  const Vector<T> e = p.b - p.a, f = q.b - q.a, w = q.a - p.a;
  const T ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), we = dot(w, e), wf = dot(w, f);
  const T s = clamped(rough_quotient(we * ff - ef * wf, ee * ff - ef * ef));
  const T t = clamped(rough_quotient(s * ef - wf, ff));
  const Vector<T> d = w + t * f - clamped(rough_quotient(we + t * ef, ee)) * e;
  const T gap = dot(d, w) + smaller(dot(d, f), T{}) - larger(dot(d, e), T{});
  return separation<T>(gap, dot(d, d), 0x1p-20F * (norm_1(w) + norm_1(e) + norm_1(f)));
}

/// Returns a lower bound of `point_triangle_distance(x, corners).below()`, from two directions: the normal, and the
/// direction to the nearest point of the outline. The projected vectors are x − corner; S' is the sum of their 1-norms.
/// In point_triangle_distance, S ≤ 3 S' and the slack is at most 2 u S, u = 2⁻²⁴. Two slacks and the errors of the
/// projections are together below 20 u S'. The code uses 32 u S'.
template <class T>
OGC_HD T separation(const Vector<T>& x, const CornersOf<T>& t) {
  const Vector<T> u = x - t.a, v = x - t.b, w = x - t.c, e = t.b - t.a, f = t.c - t.b, g = t.a - t.c, n = cross(e, f);
  const auto from_edge = [](const Vector<T>& from, const Vector<T>& edge) {
    return from - clamped(rough_quotient(dot(from, edge), dot(edge, edge))) * edge;
  };
  const Vector<T> d_e = from_edge(u, e), d_f = from_edge(v, f), d_g = from_edge(w, g);
  Vector<T> d = d_e;
  d = select(dot(d_f, d_f) < dot(d, d), d_f, d);
  d = select(dot(d_g, d_g) < dot(d, d), d_g, d);
  const T error = 0x1p-19F * (norm_1(u) + norm_1(v) + norm_1(w));
  const T outline = separation<T>(smaller(smaller(dot(d, u), dot(d, v)), dot(d, w)), dot(d, d), error);
  const T low = smaller(smaller(dot(n, u), dot(n, v)), dot(n, w)),
          high = larger(larger(dot(n, u), dot(n, v)), dot(n, w));
  return larger(outline, separation<T>(larger(low, -high), dot(n, n), error));
}

/// Returns whether the distance certainly exceeds a search's limit. `separation` is a lower bound of the distance,
/// `limit` a gap_limit [m²].
OGC_HD inline bool is_beyond(float separation, float limit) {
  return separation > 0 && separation * separation > limit;
}

}  // namespace ogc::fast
