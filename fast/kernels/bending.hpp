// Discrete hinge: c/2 (θ − θ₀)², c = k_b 3‖ē‖²/(Ā₀ + Ā₁) (method.md §4.7), damping c k_d/(2h) (θ − θᵗ)², seen from one
// vertex. The block is Gauss–Newton's. With e = x1 − x0, a = o0 − x0, b = o1 − x0, n_a = e × a, n_b = b × e:
//
//          o0         θ = atan2(−‖e‖ n_a·b⊥, n_a·n_b): the sine as a volume, because the cross product of two nearly
//         /  \        equal normals cancels, and of b's part across e alone: along e the errors of two needles multiply
//       x0 ── x1      ∂θ/∂o0 = −‖e‖ n_a/‖n_a‖²,  ∂θ/∂o1 = −‖e‖ n_b/‖n_b‖²
//         \  /        ∂θ/∂x0 = −(1 − s_a) ∂θ/∂o0 − (1 − s_b) ∂θ/∂o1,  s_a = a·e/‖e‖² (where o0's foot lies on the
//          o1         edge); ∂θ/∂x1 with s instead of 1 − s
//
// Exchanging x0 with x1 and o0 with o1 at once keeps θ, so the two roles below serve all four vertices.
#pragma once

#include <cmath>

#include "fast/kernels/accumulator.hpp"
#include "fast/kernels/arctangent.hpp"
#include "fast/kernels/membrane.hpp"
#include "fast/kernels/qualifiers.hpp"
#include "fast/kernels/vector.hpp"

namespace ogc::fast {

struct HingeRest {
  int vertex[4] = {-1, -1, -1, -1};  ///< x0, x1, o0, o1
  int body = -1;
  float angle = 0;      ///< θ₀ [rad]
  float stiffness = 0;  ///< c [J]
};

/// Angle of a hinge and what its gradients need of the present shape.
template <class T>
struct HingeShapeOf {
  Vector<T> normal_a, normal_b;  ///< n_a, n_b
  T length_squared{};            ///< ‖e‖²
  T beyond_a{}, beyond_b{};      ///< (1 − s) ‖e‖²: how far the feet lie from x1, times ‖e‖
  T divisor_a{}, divisor_b{};    ///< ‖e‖ ‖n‖²
  T angle{};                     ///< θ
  /// false where a triangle or the edge collapsed: then nothing below ‖e‖² means anything
  Mask<T> defined{};
};
using HingeShape = HingeShapeOf<float>;

/// The cross product of two rounded differences has an error of up to 4 u ‖e‖‖a‖ (two differences, two products). A
/// triangle has collapsed where its doubled area is below eight times that: its normal is known to no better than an
/// eighth, and its square, by which gradients are divided, to no better than a quarter. The hinge then exerts no force,
/// and the membrane alone opens it again.
template <class T>
OGC_HD Mask<T> hinge_side_collapsed(const T& normal_squared, const T& length_squared, const T& side_squared) {
  constexpr float relative = 1024 * 0x1p-48f;  // (8 · 4 u)²
  return !(normal_squared > relative * length_squared * side_squared);
}

template <class T>
OGC_HD HingeShapeOf<T> hinge_shape(const Vector<T>& edge, const Vector<T>& a, const Vector<T>& b) {
  HingeShapeOf<T> shape;
  shape.normal_a = cross(edge, a);
  shape.normal_b = cross(b, edge);
  shape.length_squared = dot(edge, edge);
  const T squared_a = dot(shape.normal_a, shape.normal_a), squared_b = dot(shape.normal_b, shape.normal_b);
  shape.defined = !(hinge_side_collapsed(squared_a, shape.length_squared, dot(a, a)) ||
                    hinge_side_collapsed(squared_b, shape.length_squared, dot(b, b)));
  if (is_false(shape.defined)) return shape;
  const T length = root(shape.length_squared), along = dot(b, edge);
  const Vector<T> across = b - (along / shape.length_squared) * edge;
  shape.angle = arctangent2(-length * dot(shape.normal_a, across), dot(shape.normal_a, shape.normal_b));
  shape.beyond_a = shape.length_squared - dot(a, edge);
  shape.beyond_b = shape.length_squared - along;
  shape.divisor_a = length * squared_a;
  shape.divisor_b = length * squared_b;
  return shape;
}

/// ∂θ/∂o0 [1/m] if `opposite`, else ∂θ/∂x0. One formula with selected numerators: the lanes of a team hold both roles
/// at once.
template <class T>
OGC_HD Vector<T> hinge_gradient(const HingeShapeOf<T>& shape, const Mask<T>& opposite) {
  const T a = select(opposite, -shape.length_squared, shape.beyond_a), b = select(opposite, T{}, shape.beyond_b);
  return (a / shape.divisor_a) * shape.normal_a + (b / shape.divisor_b) * shape.normal_b;
}

template <class T>
struct HingeStencilOf {
  T stiffness, rest_angle;  ///< c [J], θ₀ [rad]
};
using HingeStencil = HingeStencilOf<float>;

/// Adds −∂/∂x of energy and damping and c (1 + k_d/h) ∇θ ∇θᵀ, for a vertex whose ∂θ/∂x is `gradient`. `angle_start` is
/// θᵗ; `damping` k_d/h.
template <class T>
OGC_HD void add_hinge(const HingeStencilOf<T>& stencil, float damping, const T& angle, const T& angle_start,
                      const Vector<T>& gradient, ForceAndBlockOf<T>& sum) {
  const T moment = stencil.stiffness * ((angle - stencil.rest_angle) + damping * (angle - angle_start));
  sum.add_force(-moment, gradient);
  sum.add_outer(stencil.stiffness * (1.0f + damping), gradient);
}

/// [J], in double: energies are only reported.
OGC_HD inline double hinge_energy(const HingeRest& rest, float angle) {
  const double change = static_cast<double>(angle) - rest.angle;
  return 0.5 * rest.stiffness * change * change;
}

}  // namespace ogc::fast
