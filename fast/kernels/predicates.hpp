// Defines the polynomials whose signs bound the blocks (Eq. 8–10, 14, 15) and decide `d < r`. Each boundary has one
// polynomial, used both to find the closest face and to test blocks, so no point falls between two faces (method.md
// §3.1). The degrees are at most 6: for lengths between 2⁻⁴⁰ m and 2⁴⁰ m nothing overflows or underflows.
#pragma once

#include "fast/kernels/arithmetic/exact_sign.hpp"

namespace ogc::fast {

/// Returns (u·w)(e·e) − (u·e)(w·e): the product of the parts of u and w perpendicular to e, times ‖e‖².
template <class N>
OGC_HD N perpendicular_product(const Vector<N>& u, const Vector<N>& w, const Vector<N>& e) {
  return dot(u, w) * dot(e, e) - dot(u, e) * dot(w, e);
}

/// Returns (u·w)(e·e) − (u·e)(w·e) from cross products, in which the parts along e cancel term by term. The formula
/// with dot products would lose all digits, even in double-double, if the parts across e were 2⁻¹⁰⁰ of the parts along
/// e. Small coordinates beside an edge on an axis cause this.
OGC_HD inline Wide perpendicular_product(const Vector<Wide>& u, const Vector<Wide>& w, const Vector<Wide>& e) {
  return dot(cross(u, e), cross(w, e));
}

/// Holds the points of a predicate. value() is positive if the projection of x on the line ab lies on b's side of a, so
/// that x is not beyond the end a. It is never positive for an edge of zero length.
struct End {
  /// (x − a)·(b − a) [m²].
  static constexpr int degree = 2;
  Vec x, a, b;
  template <class N>
  OGC_HD N value() const {
    return dot(difference<N>(x, a), difference<N>(b, a));
  }
};

/// Holds the points of a predicate. value() is positive if x lies on c's side of the edge ab, seen in the plane of abc.
/// It is 0 for every x if the triangle has no area.
struct Side {
  /// ((x − a) × (b − a))·((c − a) × (b − a)) [m⁴].
  static constexpr int degree = 4;
  Vec x, a, b, c;
  template <class N>
  OGC_HD N value() const {
    return perpendicular_product(difference<N>(x, a), difference<N>(c, a), difference<N>(b, a));
  }
};

/// Holds the points of a predicate. value() is negative if the distance to the line ab falls from v towards w. Let c be
/// the point of the edge ab closest to v. If c is in the interior of ab, this is the condition of Eq. 15: c lies in U_v
/// if and only if value() ≥ 0 for all neighbours w of v.
struct Receding {
  /// ((v − a) × (b − a))·((w − v) × (b − a)) [m⁴].
  static constexpr int degree = 4;
  Vec v, w, a, b;
  template <class N>
  OGC_HD N value() const {
    return perpendicular_product(difference<N>(v, a), difference<N>(w, v), difference<N>(b, a));
  }
};

/// Holds the points of a predicate. value() is positive if the edges e and f are nearly parallel: ‖e×f‖² < 10⁻⁶ ‖e‖²
/// ‖f‖² (method.md §1.4). It is never positive for an edge of zero length.
struct NearlyParallel {
  /// ‖e‖² ‖f‖² − 10⁶ ‖e × f‖² [m⁴], e = b − a, f = d − c.
  static constexpr int degree = 4;
  Vec a, b, c, d;
  template <class N>
  OGC_HD N value() const {
    const Vector<N> e = difference<N>(b, a), f = difference<N>(d, c), n = cross(e, f);
    return dot(e, e) * dot(f, f) - N::exact(1e6) * dot(n, n);
  }
};

/// Holds the points of a predicate. value() is negative if x is nearer than r to the point a.
struct PointReach {
  /// ‖x − a‖² − r² [m²].
  static constexpr int degree = 2;
  Vec x, a;
  float r;
  template <class N>
  OGC_HD N value() const {
    const Vector<N> u = difference<N>(x, a);
    return dot(u, u) - N::exact(r) * N::exact(r);
  }
};

/// Holds the points of a predicate. value() is negative if x is nearer than r to the line ab.
struct LineReach {
  /// ‖(x − a) × e‖² − r² ‖e‖² [m⁴], e = b − a.
  static constexpr int degree = 4;
  Vec x, a, b;
  float r;
  template <class N>
  OGC_HD N value() const {
    const Vector<N> u = difference<N>(x, a), e = difference<N>(b, a);
    return perpendicular_product(u, u, e) - N::exact(r) * N::exact(r) * dot(e, e);
  }
};

/// Holds the points of a predicate. value() is negative if x is nearer than r to the plane through a that b − a and d −
/// c span. With c = a this is the plane of a triangle. With x = c, the distance of x from the plane is the distance of
/// the lines ab and cd.
struct PlaneReach {
  /// ((x − a)·n)² − r² ‖n‖² [m⁶], n = (b − a) × (d − c).
  static constexpr int degree = 6;
  Vec x, a, b, c, d;
  float r;
  template <class N>
  OGC_HD N value() const {
    const Vector<N> n = cross(difference<N>(b, a), difference<N>(d, c));
    const N height = dot(difference<N>(x, a), n);
    return height * height - N::exact(r) * N::exact(r) * dot(n, n);
  }
};

}  // namespace ogc::fast
