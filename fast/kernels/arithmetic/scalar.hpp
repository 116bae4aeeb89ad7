// Defines the functions of a number type that formulas use besides + − × ÷. So a formula is written once, for one float
// and for several numbers side by side (fast/cpu/pack.hpp).
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Names the type of a comparison's result.
template <class T>
struct MaskOf {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

/// Returns a if the condition holds, else b.
OGC_HD inline float select(bool condition, float a, float b) { return condition ? a : b; }
/// Returns a if the condition holds, else b; the condition selects each component separately.
template <class T, class M>
OGC_HD Vector<T> select(const M& condition, const Vector<T>& a, const Vector<T>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
/// Returns a() if the condition holds, else b(). The overload for several numbers side by side calls both functions.
template <class A, class B>
OGC_HD float choose(bool condition, const A& a, const B& b) {
  return condition ? a() : b();
}
OGC_HD inline float absolute(float a) { return fabsf(a); }
OGC_HD inline float root(float a) { return sqrtf(a); }
/// Returns whether the condition is false for all numbers, so that a formula may return early.
OGC_HD inline bool is_false(bool condition) { return !condition; }

}  // namespace ogc::fast
