// Decides signs of polynomials in the coordinates exactly. A polynomial is a functor over a number type. Up to degree
// 4, `exact_sign` first evaluates it in single precision (Single), which decides nearly all generic input. Then it
// evaluates in double, together with the sum of the moduli of the terms (Filtered). If the value may be a rounding
// error, it evaluates in double-double (Wide). Only Single is inlined: the other code rarely runs, and would cost
// registers and instruction cache.
//
// Double suffices for nearly all predicates, because it holds the difference of two single-precision coordinates of
// similar size exactly. A predicate of degree 2 or 4 then only has a few roundings of 2⁻⁵³. Double-double has 106 bits.
// There a value below 2⁻⁹⁸ of its terms counts as zero, so that exact degeneracies (lattices, coplanar layers,
// collinear triangles) are recognised.
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A double whose operations are never contracted, so that each is rounded once.
struct Rounded {
  double value = 0;

  /// Make the two inputs of polynomials. `difference` returns the difference of two coordinates, rounded once; `exact`
  /// returns a constant.
  OGC_HD static Rounded difference(float a, float b) { return {sub(static_cast<double>(a), static_cast<double>(b))}; }
  OGC_HD static Rounded exact(double a) { return {a}; }
  friend OGC_HD Rounded operator+(Rounded a, Rounded b) { return {add(a.value, b.value)}; }
  friend OGC_HD Rounded operator-(Rounded a, Rounded b) { return {sub(a.value, b.value)}; }
  friend OGC_HD Rounded operator-(Rounded a) { return {-a.value}; }
  friend OGC_HD Rounded operator*(Rounded a, Rounded b) { return {mul(a.value, b.value)}; }
  friend OGC_HD Rounded operator/(Rounded a, Rounded b) { return {divide(a.value, b.value)}; }
};

/// Holds a sign, and whether rounding errors can change it.
struct Sign {
  int value = 0;  ///< −1, 0 or 1
  bool certain = true;
};

/// Returns −1, 0 or 1; 0 for NaN.
OGC_HD inline int sign_of(double a) { return (a > 0) - (a < 0); }

/// Holds a value in single precision and the sum of the moduli of its terms, for polynomials of degree ≤ 4. If the
/// compiler contracts operations, it only omits roundings, so a sign that is certain (Sign::certain) stays right.
struct Single {
  float value = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of value

  /// Returns the difference of two floats; its relative error is at most u = 2⁻²⁴. Its scale is at least 2⁻³⁰, so a
  /// polynomial of degree 4 has a scale of at least 2⁻¹²⁰. A product that underflows errs by 2⁻¹⁵⁰, far less than u
  /// times this scale.
  OGC_HD static Single difference(float a, float b) {
    const float d = a - b;
    return {d, larger(fabsf(d), 0x1p-30F)};
  }
  /// Returns `a`, which must fit into 24 bits.
  OGC_HD static Single exact(double a) { return {static_cast<float>(a), static_cast<float>(modulus(a))}; }
  friend OGC_HD Single operator+(Single a, Single b) { return {a.value + b.value, a.scale + b.scale}; }
  friend OGC_HD Single operator-(Single a, Single b) { return {a.value - b.value, a.scale + b.scale}; }
  friend OGC_HD Single operator*(Single a, Single b) { return {a.value * b.value, a.scale * b.scale}; }

  /// Returns the sign. It is certain if |value| exceeds 2⁻¹⁸ of the scale: 2²⁹ times the limit of Filtered::sign,
  /// because roundings are 2⁻²⁴ instead of 2⁻⁵³. After an overflow no sign is certain, because no value exceeds an
  /// infinite scale.
  OGC_HD Sign sign() const { return {(value > 0) - (value < 0), fabsf(value) > scale * 0x1p-18F}; }
};

/// Holds a value in double and the sum of the moduli of its terms.
struct Filtered {
  double value = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of value

  /// Returns a difference: exact if neither coordinate is 2²⁸ times the other, otherwise rounded once.
  OGC_HD static Filtered difference(float a, float b) {
    const double d = sub(static_cast<double>(a), static_cast<double>(b));
    return {d, modulus(d)};
  }
  OGC_HD static Filtered exact(double a) { return {a, modulus(a)}; }
  friend OGC_HD Filtered operator+(Filtered a, Filtered b) { return {add(a.value, b.value), add(a.scale, b.scale)}; }
  friend OGC_HD Filtered operator-(Filtered a, Filtered b) { return {sub(a.value, b.value), add(a.scale, b.scale)}; }
  friend OGC_HD Filtered operator*(Filtered a, Filtered b) { return {mul(a.value, b.value), mul(a.scale, b.scale)}; }

  /// Returns the sign, which is certain if |value| exceeds 2⁻⁴⁷ of the scale. A term of a polynomial of degree d ≤ 6
  /// has at most d differences, d − 1 products and 8 sums (2 for degree 2, 5 for degree 4). These are under 32
  /// roundings of 2⁻⁵³. The scale has as many roundings, so 2⁻⁴⁷ exceeds the errors of value and scale together.
  OGC_HD Sign sign() const { return {sign_of(value), modulus(value) > mul(scale, 0x1p-47)}; }
};

/// Holds an unevaluated sum high + low of two doubles, |low| ≤ ulp(high)/2, and the sum of the moduli of its terms.
struct Wide {
  double high = 0, low = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of high + low

  /// `difference` returns the difference of two coordinates, `exact` a constant. Both are exact, because two doubles
  /// hold the difference of any two floats.
  OGC_HD static Wide difference(float a, float b) { return sum_of(static_cast<double>(a), -static_cast<double>(b)); }
  OGC_HD static Wide exact(double a) { return {a, 0, modulus(a)}; }
  friend OGC_HD Wide operator+(const Wide& a, const Wide& b) {
    const Wide s = sum_of(a.high, b.high), t = sum_of(a.low, b.low);
    const Wide u = normalised(s.high, add(s.low, t.high), 0);
    return normalised(u.high, add(u.low, t.low), add(a.scale, b.scale));
  }
  friend OGC_HD Wide operator-(const Wide& a, const Wide& b) { return a + Wide{-b.high, -b.low, b.scale}; }
  friend OGC_HD Wide operator*(const Wide& a, const Wide& b) {
    const double p = mul(a.high, b.high), rest = fused(a.high, b.high, -p);
    return normalised(p, add(rest, add(mul(a.high, b.low), mul(a.low, b.high))), mul(a.scale, b.scale));
  }

  /// Returns the sign. Each operation errs by at most 2⁻¹⁰³ of its result, so 32 operations err by at most 2⁻⁹⁸ of the
  /// scale.
  OGC_HD Sign sign() const { return {modulus(high) <= mul(scale, 0x1p-98) ? 0 : sign_of(high), true}; }

 private:
  OGC_HD static Wide sum_of(double a, double b) {
    const double s = add(a, b), part = sub(s, a);
    return {s, add(sub(a, sub(s, part)), sub(b, part)), modulus(s)};
  }
  OGC_HD static Wide normalised(double high, double low, double scale) {
    const double s = add(high, low);
    return {s, sub(low, sub(s, high)), scale};
  }
};

/// Returns p − q. It is exact in Wide, and in double if the coordinates are of similar size.
template <class N>
OGC_HD Vector<N> difference(const Vec& p, const Vec& q) {
  return {N::difference(p.x, q.x), N::difference(p.y, q.y), N::difference(p.z, q.z)};
}

/// Decides the sign in double and, if necessary, double-double. The polynomial is passed by value: a reference would
/// force the coordinates into memory.
template <class Polynomial>
OGC_HD OGC_OUT_OF_LINE int exact_sign_in_double(Polynomial polynomial) {
  const Sign quick = polynomial.template value<Filtered>().sign();
  return quick.certain ? quick.value : polynomial.template value<Wide>().sign().value;
}

/// Returns the exact sign of polynomial.value<N>(). `Polynomial::degree` is the polynomial's degree in the coordinates.
template <class Polynomial>
OGC_HD int exact_sign(const Polynomial& polynomial) {
  if constexpr (Polynomial::degree <= 4) {
    const Sign quick = polynomial.template value<Single>().sign();
    if (quick.certain) return quick.value;
  }
  return exact_sign_in_double(polynomial);
}

}  // namespace ogc::fast
