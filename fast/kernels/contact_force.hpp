// Computes a contact between two sides, the closed faces of a record (fast/contact_view.hpp), at the positions that a
// vertex update reads. Closest points are computed in single precision from relative coordinates; they give weights,
// normal and distance. A vertex has the force −g' w n and the block g'' w² n nᵀ (method.md §4.2; §7.4 for w²).
//
//   kind              vertices of the first | second side, by index in ContactIncidence (slot)
//   point_point       0 | 2
//   point_segment     0 | 2 3
//   segment_segment   0 1 | 2 3
//   point_triangle    0 | 1 2 3
//
// There is no segment_point, because a record's first face never has the higher dimension
// (compare/stages/detect_edge_edge.hpp). The weights add up to 0, so action equals reaction. Σ w_i x_i is the vector d
// n from the closest point of the second side to the closest point of the first. Vertices that a kind does not have
// repeat vertex 0 with weight 0, so that formulas need no branch.
#pragma once

#include <cmath>
#include <cstdint>

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/models/activation.hpp"

namespace ogc::fast {

/// Names the kinds of faces between which a contact acts; the head of this file lists the vertices of each kind.
enum class ContactKind : std::uint8_t { point_point, point_segment, segment_segment, point_triangle };

/// Holds the constants of contacts between two bodies (method.md §4.5).
struct ContactMaterial {
  float stiffness = 0, friction = 0;  ///< k_c [N/m], μ [1]
};

/// Returns the parameter in [0, 1] of the point of a segment that is closest to a given point; 0 if the segment has no
/// length. `along` is the segment, `from_start` the point minus the segment's start.
OGC_HD inline float closest_on_segment(const Vec& along, const Vec& from_start) {
  const float length_squared = dot(along, along), t = dot(along, from_start);
  if (!(t > 0)) return 0.0f;
  return t < length_squared ? t / length_squared : 1.0f;
}

/// Returns t clamped to [0, 1]; 0 for NaN.
template <class T>
OGC_HD T clamp_unit(const T& t) {
  return select(t > T(0.0f), select(t < T(1.0f), t, T(1.0f)), T(0.0f));
}

/// Barycentric weights of the point of the closed triangle (a, b, c) closest to p.
template <class T>
struct TriangleWeightsOf {
  T a{}, b{}, c{};  ///< ≥ 0; their sum is 1 up to rounding
};
using TriangleWeights = TriangleWeightsOf<float>;

/// Holds two edges of the triangle (x[1], x[2], x[3]), the vector from x[1] to the point x[0], and the weights of the
/// point's projection.
template <class T>
struct PointAndTriangle {
  Vector<T> ab, ac, ap;
  T area, a, b, c;  ///< ‖normal‖², and the weights of the projection onto the plane, times ‖normal‖²

  OGC_HD explicit PointAndTriangle(const Vector<T>* x) : ab(x[2] - x[1]), ac(x[3] - x[1]), ap(x[0] - x[1]) {
    const Vector<T> normal = cross(ab, ac);
    area = dot(normal, normal);
    b = dot(cross(ap, ac), normal), c = dot(cross(ab, ap), normal), a = area - b - c;
  }
  /// Returns whether the point projects into the interior; weights() is only valid then.
  OGC_HD Mask<T> is_inside() const { return a > T(0.0f) && b > T(0.0f) && c > T(0.0f); }
  OGC_HD TriangleWeightsOf<T> weights() const { return {a / area, b / area, c / area}; }
};

namespace detail {

/// Return the weights of the point at parameter t of an edge.
OGC_HD inline TriangleWeights on_bc(float t) { return {0.0f, 1.0f - t, t}; }
OGC_HD inline TriangleWeights on_ac(float t) { return {1.0f - t, 0.0f, t}; }
OGC_HD inline TriangleWeights on_ab(float t) { return {1.0f - t, t, 0.0f}; }

}  // namespace detail

/// Returns the weights of the point of the triangle (x[1], x[2], x[3]) closest to x[0]. They are never NaN. If the sine
/// of the angle at x[1] is below 2⁻²⁰, which is 16 times the unit roundoff, the signs of weights are unreliable. Then
/// the longest edge replaces the triangle.
///
/// A point that does not project into the interior lies beyond one edge or two. Beyond one edge, the closest point is
/// on this edge. Beyond two edges, it is on the edge whose point closest to x[0] is not the common corner of the two
/// edges. Signs decide this, not distances: far above a corner the distances to both edges agree in all digits,
/// although their closest points differ.
OGC_HD inline TriangleWeights closest_on_triangle(const Vec* x) {
  const PointAndTriangle<float> at(x);
  if (at.is_inside()) return at.weights();
  const Vec &ab = at.ab, &ac = at.ac, &ap = at.ap;
  const float area = at.area, a = at.a, b = at.b, c = at.c;
  const Vec bc = x[3] - x[2], bp = x[0] - x[2];
  const float ab_squared = dot(ab, ab), ac_squared = dot(ac, ac);
  if (!(area > 0x1p-40f * ab_squared * ac_squared)) {
    const float bc_squared = dot(bc, bc);
    if (bc_squared >= ab_squared && bc_squared >= ac_squared) return detail::on_bc(closest_on_segment(bc, bp));
    return ab_squared >= ac_squared ? detail::on_ab(closest_on_segment(ab, ap))
                                    : detail::on_ac(closest_on_segment(ac, ap));
  }
  if (!(c > 0)) {
    const float t = closest_on_segment(ab, ap);
    const bool common = t > 0 ? t == 1.0f && !(a > 0) : !(b > 0);
    if (!common) return detail::on_ab(t);
  }
  if (!(a > 0)) {
    const float t = closest_on_segment(bc, bp);
    if (t < 1.0f || b > 0) return detail::on_bc(t);
  }
  return detail::on_ac(closest_on_segment(ac, ap));
}

/// Parameters in [0, 1] of the closest points of two closed segments.
template <class T>
struct SegmentParametersOf {
  T first{}, second{};
};
using SegmentParameters = SegmentParametersOf<float>;

/// Holds two segments, start + s·first and start + between + t·second, and their products.
template <class T>
struct TwoSegments {
  Vector<T> first, second, between;
  T aa, bb, ab, sine, to_start;  ///< first², second², first · second, ‖first × second‖², first · between

  OGC_HD TwoSegments(const Vector<T>& along_first, const Vector<T>& along_second, const Vector<T>& apart)
      : first(along_first),
        second(along_second),
        between(apart),
        aa(dot(first, first)),
        bb(dot(second, second)),
        ab(dot(first, second)) {
    const Vector<T> normal = cross(first, second);
    sine = dot(normal, normal), to_start = dot(first, between);
  }
  /// Returns whether the segments are nearly parallel: ‖first × second‖² < 10⁻⁶ ‖first‖² ‖second‖².
  OGC_HD Mask<T> is_parallel() const { return sine < 1e-6f * aa * bb; }
  /// Returns whether `parameters` is valid: both segments have a length, and they are not nearly parallel.
  OGC_HD Mask<T> is_usual() const { return aa > T(0.0f) && bb > T(0.0f) && !is_parallel(); }
  OGC_HD SegmentParametersOf<T> parameters() const { return beside(on_first()); }
  /// Returns the parameter of the point of the first line closest to the second line, clamped to the first segment.
  OGC_HD T on_first() const { return clamp_unit(dot(cross(between, second), cross(first, second)) / sine); }
  /// Returns `s` and t, the parameter of the point of the second segment closest to the first segment's point at `s`.
  /// If t is an end, `s` is replaced by the parameter of the first segment's point closest to this end.
  OGC_HD SegmentParametersOf<T> beside(const T& s) const {
    const T t = (s * ab - dot(second, between)) / bb;
    const Mask<T> is_inside = t > T(0.0f) && t < T(1.0f);
    const T end = select(t > T(0.0f), T(1.0f), T(0.0f));
    return {choose(
                is_inside, [&] { return s; }, [&] { return clamp_unit((to_start + end * ab) / aa); }),
            select(is_inside, t, end)};
  }
};

/// Returns the parameters of the closest points of two segments, which may have length zero. If the segments are nearly
/// parallel and overlap in more than a point, returns the middle of the overlap on the first segment and its projection
/// on the second (method.md §1.4). For this the first segment must be the lower-numbered edge.
OGC_HD inline SegmentParameters closest_on_segments(const TwoSegments<float>& at) {
  if (!(at.aa > 0)) return {0.0f, closest_on_segment(at.second, Vec{} - at.between)};
  if (!(at.bb > 0)) return {closest_on_segment(at.first, at.between), 0.0f};
  float s = 0;
  if (at.is_parallel()) {
    const float p = at.to_start / at.aa, q = (at.to_start + at.ab) / at.aa;
    const float low = clamp_unit(p < q ? p : q), high = clamp_unit(p < q ? q : p);
    s = 0.5f * (low + high);
    if (high > low) return {s, closest_on_segment(at.second, s * at.first - at.between)};
  } else {
    s = at.on_first();
  }
  return at.beside(s);
}

/// Holds the weights w of the closest points by vertex of the contact [1]; 0 for a vertex that the kind does not have.
template <class T>
struct ContactWeightsOf {
  T slot[4] = {};  ///< w; their sum is 0 up to rounding

  /// Returns w of vertex k by selection: an index would move the array from registers to memory.
  OGC_HD T of(int k) const {
    const T low = k == 0 ? slot[0] : slot[1], high = k == 2 ? slot[2] : slot[3];
    return k < 2 ? low : high;
  }
};
using ContactWeights = ContactWeightsOf<float>;

/// Return the weights w by vertex of a contact: of two segments, or of a point and a triangle.
template <class T>
OGC_HD ContactWeightsOf<T> weights_of(const SegmentParametersOf<T>& at) {
  return {{1.0f - at.first, at.first, at.second - 1.0f, -at.second}};
}
template <class T>
OGC_HD ContactWeightsOf<T> weights_of(const TriangleWeightsOf<T>& at) {
  return {{T(1.0f), -at.a, -at.b, -at.c}};
}

/// Names the kinds of pairs that may generate a contact. A kernel that is compiled for one kind omits the formulas of
/// the other kind.
enum class PairKind { any, vertex_facet, edge_edge };

/// Returns the weights of the closest points of a contact; `x` are the positions of its four vertices, in the order
/// given at the head of this file.
template <PairKind pairs = PairKind::any>
OGC_HD ContactWeights contact_weights(ContactKind kind, const Vec* x) {
  if (kind == ContactKind::point_point) return {{1, 0, -1, 0}};
  if (kind == ContactKind::point_segment) {
    const float t = closest_on_segment(x[3] - x[2], x[0] - x[2]);
    return {{1, 0, t - 1, -t}};
  }
  if (pairs == PairKind::edge_edge || (pairs == PairKind::any && kind == ContactKind::segment_segment)) {
    return weights_of(closest_on_segments({x[1] - x[0], x[3] - x[2], x[2] - x[0]}));
  }
  return weights_of(closest_on_triangle(x));
}

/// Returns Σ w_i x_i, computed from differences to x[0].
template <class T>
OGC_HD Vector<T> weighted_sum(const ContactWeightsOf<T>& weights, const Vector<T>* x) {
  return weights.slot[1] * (x[1] - x[0]) + weights.slot[2] * (x[2] - x[0]) + weights.slot[3] * (x[3] - x[0]);
}

/// Holds the normal and the distance of the closest points; `acts`: 0 < d < r. If the squared distance is not a normal
/// number, the points coincide in single precision. Then there is no normal and no force. The bounds of the vertices,
/// which are then about 0, prevent an intersection.
template <class T>
struct ContactShapeOf {
  Vector<T> normal;  ///< n, a unit vector from the second side's closest point to the first side's
  T distance{};      ///< d [m]
  Mask<T> acts{};
};
using ContactShape = ContactShapeOf<float>;

/// Returns the normal and the distance, given Σ w_i x_i.
template <class T>
OGC_HD ContactShapeOf<T> contact_shape(const Vector<T>& separation, float contact_radius) {
  const T squared = dot(separation, separation);
  const Mask<T> is_apart = T(0x1p-126f) <= squared;
  if (is_false(is_apart)) return {};
  const T length = root(squared), distance = select(is_apart, length, T(0.0f));
  return {(1.0f / length) * separation, distance, is_apart && distance < T(contact_radius)};
}

/// Returns the distance at which slope and curvature are evaluated: d, clamped to 2⁻²³ r … r. At 2⁻²³ r the logarithmic
/// branch of `ogc` has g'' = k_c r²/(4 d²) = 2⁴⁴ k_c (ipc_log 2⁴⁶ k_c), far above every other block and far below
/// overflow. Beyond r there is no force, but the block keeps the curvature at r: without it, an update that begins
/// beyond r ends far too deep, and sweeps cycle (method.md §4.2).
template <class T>
OGC_HD T activation_distance(const T& distance, float contact_radius) {
  const float least = 0x1p-23f * contact_radius;
  return select(distance < contact_radius, select(distance > least, distance, T{least}), T{contact_radius});
}

/// Adds to `sum` the force and block of a vertex with weight w; `majorant` replaces w² in the block (method.md §7.4).
/// Returns the normal force λ = −g' ≥ 0 [N].
template <class Activation, class T>
OGC_HD T add_contact(const Activation& activation, const ContactShapeOf<T>& shape, const T& weight, const T& majorant,
                     float contact_radius, const T& stiffness, ForceAndBlockOf<T>& sum) {
  const T distance = activation_distance(shape.distance, contact_radius);
  const ActivationSlopeOf<T> at = activation.slope_within(distance, contact_radius, stiffness);
  sum.add_force(-at.slope * weight, shape.normal);
  sum.add_outer(at.curvature * majorant, shape.normal);
  return -at.slope;
}

/// Returns the mollifier e_k of two edges (method.md §4.3). With ε = 10⁻³ times the product of their squared rest
/// lengths and q = ‖first × second‖²/ε, it is q(2 − q) for q < 1, else 1.
OGC_HD inline float mollifier(const Vec& first, const Vec& second, float rest_squared_first,
                              float rest_squared_second) {
  const Vec normal = cross(first, second);
  const float sine = dot(normal, normal), limit = 1e-3f * rest_squared_first * rest_squared_second;
  if (!(sine < limit)) return 1.0f;
  const float q = sine / limit;
  return q * (2.0f - q);
}

/// Returns, for nearly parallel edges, the length of their overlap along the first edge divided by the length of the
/// shorter edge. `to_start` and `to_end` are the ends of the second edge minus the start of the first.
OGC_HD inline float overlap_share(const Vec& first, const Vec& second, const Vec& to_start, const Vec& to_end) {
  const float aa = dot(first, first), bb = dot(second, second);
  const float start = clamp_unit(dot(first, to_start) / aa), end = clamp_unit(dot(first, to_end) / aa);
  const float share = start < end ? end - start : start - end;
  return bb < aa ? share * sqrtf(aa / bb) : share;
}

}  // namespace ogc::fast
