// Decides signs of polynomials in the coordinates exactly. A polynomial is a functor over a number type. `exact_sign`
// evaluates it in double beside the sum of the moduli of its terms (Filtered), and only if the rounding errors could
// reach the value, a second time in double-double (Wide). Polynomials of degree up to 4 are first tried in single
// precision (Single), which decides nearly all of generic input. The rest is out of line, so that code that nearly
// never runs takes neither registers nor room in the instruction cache from code that always does.
//
// Why double at all: the difference of two single-precision coordinates of similar size is exact in it, so a predicate
// of degree 2 or 4 loses nothing but a few roundings of 2⁻⁵³, and doubtful cases are rare enough to be paid for.
// Double-double carries 106 bits; a value under 2⁻⁹⁸ of its terms there counts as zero, so exact degeneracies
// (lattices, coplanar layers, collinear triangles) are recognised.
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A double whose operations are each rounded by themselves.
struct Rounded {
  double value = 0;

  /// Returns the difference of two coordinates, rounded once; `exact` returns a constant. Polynomials are built of
  /// both.
  OGC_HD static Rounded difference(float a, float b) { return {sub(static_cast<double>(a), static_cast<double>(b))}; }
  OGC_HD static Rounded exact(double a) { return {a}; }
  friend OGC_HD Rounded operator+(Rounded a, Rounded b) { return {add(a.value, b.value)}; }
  friend OGC_HD Rounded operator-(Rounded a, Rounded b) { return {sub(a.value, b.value)}; }
  friend OGC_HD Rounded operator-(Rounded a) { return {-a.value}; }
  friend OGC_HD Rounded operator*(Rounded a, Rounded b) { return {mul(a.value, b.value)}; }
  friend OGC_HD Rounded operator/(Rounded a, Rounded b) { return {divide(a.value, b.value)}; }
};

/// Holds a sign, and whether rounding errors cannot have changed it.
struct Sign {
  int value = 0;  ///< −1, 0 or 1
  bool certain = true;
};

/// Returns −1, 0 or 1; 0 for NaN.
OGC_HD inline int sign_of(double a) { return (a > 0) - (a < 0); }

/// Evaluates in single precision: the value and the sum of the moduli of its terms, for degrees up to 4. How its
/// operations are contracted changes no sign that it is certain of, as contraction only leaves roundings out.
struct Single {
  float value = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of value

  /// Returns a difference of floats, which has one relative error of u = 2⁻²⁴, however small it is. Its modulus counts
  /// as 2⁻³⁰ at least: then no scale of degree 4 is below 2⁻¹²⁰, and what products of values lose by underflow, 2⁻¹⁵⁰
  /// each, is nothing beside u · scale.
  OGC_HD static Single difference(float a, float b) {
    const float d = a - b;
    return {d, larger(fabsf(d), 0x1p-30F)};
  }
  /// Returns `a`, which has 24 bits.
  OGC_HD static Single exact(double a) { return {static_cast<float>(a), static_cast<float>(modulus(a))}; }
  friend OGC_HD Single operator+(Single a, Single b) { return {a.value + b.value, a.scale + b.scale}; }
  friend OGC_HD Single operator-(Single a, Single b) { return {a.value - b.value, a.scale + b.scale}; }
  friend OGC_HD Single operator*(Single a, Single b) { return {a.value * b.value, a.scale * b.scale}; }

  /// Returns the sign as Filtered::sign does, with u = 2⁻²⁴. If something overflowed nothing is certain: an infinite
  /// scale is above all values.
  OGC_HD Sign sign() const { return {(value > 0) - (value < 0), fabsf(value) > scale * 0x1p-18F}; }
};

/// Holds a rounded double with the sum of the moduli of its terms.
struct Filtered {
  double value = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of value

  /// Returns a difference: exact if neither coordinate is 2²⁸ times the other, otherwise rounded once.
  OGC_HD static Filtered difference(float a, float b) {
    const double d = sub(static_cast<double>(a), static_cast<double>(b));
    return {d, modulus(d)};
  }
  /// Returns `a` without an error.
  OGC_HD static Filtered exact(double a) { return {a, modulus(a)}; }
  friend OGC_HD Filtered operator+(Filtered a, Filtered b) { return {add(a.value, b.value), add(a.scale, b.scale)}; }
  friend OGC_HD Filtered operator-(Filtered a, Filtered b) { return {sub(a.value, b.value), add(a.scale, b.scale)}; }
  friend OGC_HD Filtered operator*(Filtered a, Filtered b) { return {mul(a.value, b.value), mul(a.scale, b.scale)}; }

  /// Returns the sign. Each term of a polynomial of degree d with nested sums passes at most d differences, d − 1
  /// products and, by degree, 2, 5, 8 … sums: under 32 roundings of 2⁻⁵³ up to degree 6. The scale, rounded the same
  /// way, is short of the exact one by no more. 2⁻⁴⁷ is twice their sum.
  OGC_HD Sign sign() const { return {sign_of(value), modulus(value) > mul(scale, 0x1p-47)}; }
};

/// Holds an unevaluated sum high + low of two doubles (|low| ≤ ulp(high)/2) with the sum of the moduli of its terms.
struct Wide {
  double high = 0, low = 0, scale = 0;  ///< scale: Σ of the moduli of the terms of high + low

  /// Returns a difference or a constant without an error: two doubles hold the difference of any two floats.
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

  /// Returns the sign. One operation errs by at most 2⁻¹⁰³ of its result, 32 of them by 2⁻⁹⁸.
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

/// Returns p − q without a loss that matters: exact in double if the coordinates are of similar size, exact in Wide
/// always.
template <class N>
OGC_HD Vector<N> difference(const Vec& p, const Vec& q) {
  return {N::difference(p.x, q.x), N::difference(p.y, q.y), N::difference(p.z, q.z)};
}

/// Decides the sign beyond single precision. The polynomial is passed by value: a reference would force the coordinates
/// into memory.
template <class Polynomial>
OGC_HD OGC_OUT_OF_LINE int exact_sign_in_double(Polynomial polynomial) {
  const Sign quick = polynomial.template value<Filtered>().sign();
  return quick.certain ? quick.value : polynomial.template value<Wide>().sign().value;
}

/// Returns the exact sign of polynomial.value<N>(). `Polynomial::degree` is the degree of its terms.
template <class Polynomial>
OGC_HD int exact_sign(const Polynomial& polynomial) {
  if constexpr (Polynomial::degree <= 4) {
    const Sign quick = polynomial.template value<Single>().sign();
    if (quick.certain) return quick.value;
  }
  return exact_sign_in_double(polynomial);
}

}  // namespace ogc::fast
