// Defines what a formula needs of its number type beyond + − × ÷. So a formula is written once, for one float and for
// several side by side (fast/cpu/pack.hpp).
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Names the result type of a comparison of two numbers.
template <class T>
struct MaskOf {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

/// Returns a if the condition holds, else b.
OGC_HD inline float select(bool condition, float a, float b) { return condition ? a : b; }
/// Returns a if the condition holds, else b, component by component.
template <class T, class M>
OGC_HD Vector<T> select(const M& condition, const Vector<T>& a, const Vector<T>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
/// Returns a() if the condition holds, else b(). A single number computes one of them; several side by side compute
/// both.
template <class A, class B>
OGC_HD float choose(bool condition, const A& a, const B& b) {
  return condition ? a() : b();
}
OGC_HD inline float absolute(float a) { return fabsf(a); }
OGC_HD inline float root(float a) { return sqrtf(a); }
/// Returns whether the condition holds for no number, so that a formula may end early.
OGC_HD inline bool is_false(bool condition) { return !condition; }

}  // namespace ogc::fast
