// Defines what all bending models share: a hinge's rest data, its angle θ and the gradients of θ. With e = x1 − x0, a =
// o0 − x0, b = o1 − x0, n_a = e × a, n_b = b × e, and b⊥ the part of b perpendicular to e:
//
//          o0         θ = atan2(−‖e‖ n_a·b⊥, n_a·n_b). The first argument is a volume: the cross product of two nearly
//         /  \        equal normals would cancel. It uses b⊥ instead of b, because for two needles the errors of b
//       x0 ── x1      along e would be large
//         \  /        ∂θ/∂o0 = −‖e‖ n_a/‖n_a‖²,  ∂θ/∂o1 = −‖e‖ n_b/‖n_b‖²
//          o1         ∂θ/∂x0 = −(1 − s_a) ∂θ/∂o0 − (1 − s_b) ∂θ/∂o1, with s_a = a·e/‖e‖², s_b = b·e/‖e‖²;
//                     ∂θ/∂x1 has s instead of 1 − s
//
// If x0 is exchanged with x1 and o0 with o1, θ does not change. So two formulas serve all four vertices: one for an end
// of the edge, one for an opposite vertex.
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/arctangent.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/models/material.hpp"

namespace ogc::fast {

/// A hinge at rest.
struct HingeRest {
  int vertex[4] = {-1, -1, -1, -1};  ///< x0, x1, o0, o1
  int body = -1;
  float angle = 0;      ///< θ₀ [rad]
  float stiffness = 0;  ///< c [J]
};

/// Weights w of the isometric model [1/m]; the weight of x0 is minus their sum.
struct HingeWeights {
  float weight[3] = {};  ///< of x1, o0, o1
};

/// Holds the angle of a hinge and the quantities of the present shape that its gradients need.
template <class T>
struct HingeShapeOf {
  Vector<T> normal_a, normal_b;  ///< n_a, n_b
  T length_squared{};            ///< ‖e‖²
  T beyond_a{}, beyond_b{};      ///< (1 − s) ‖e‖²: distance of the feet from x1 along the edge, times ‖e‖
  T divisor_a{}, divisor_b{};    ///< ‖e‖ ‖n‖²
  T angle{};                     ///< θ
  /// false if a triangle or the edge has collapsed: then the members after length_squared are undefined
  Mask<T> defined{};
};
using HingeShape = HingeShapeOf<float>;

/// Returns whether a triangle of the hinge has collapsed. The cross product of two rounded differences has an error of
/// up to 4 u ‖e‖‖a‖, u = 2⁻²⁴ (two differences, two products). A triangle counts as collapsed if its doubled area is
/// below eight times this error. Its normal might otherwise err by more than an eighth, and the normal's square, a
/// divisor of gradients, by more than a quarter. A collapsed hinge exerts no force; the membrane opens it again.
template <class T>
OGC_HD Mask<T> hinge_side_collapsed(const T& normal_squared, const T& length_squared, const T& side_squared) {
  constexpr float relative = 1024 * 0x1p-48f;  // (8 · 4 u)²
  return !(normal_squared > relative * length_squared * side_squared);
}

/// Returns the shape of a hinge with these e, a and b.
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

/// Returns ∂θ/∂o0 [1/m] if `opposite`, else ∂θ/∂x0. One formula with selected numerators computes both gradients,
/// because threads of one warp may need different ones.
template <class T>
OGC_HD Vector<T> hinge_gradient(const HingeShapeOf<T>& shape, const Mask<T>& opposite) {
  const T a = select(opposite, -shape.length_squared, shape.beyond_a), b = select(opposite, T{}, shape.beyond_b);
  return (a / shape.divisor_a) * shape.normal_a + (b / shape.divisor_b) * shape.normal_b;
}

/// Returns the shape of a hinge as one of its vertices, at `own`, sees it. An end of the edge counts as x0, and `p`
/// holds x1, o0, o1. An opposite vertex counts as o0, and `p` holds x0, x1, o1.
template <class T>
OGC_HD HingeShapeOf<T> hinge_shape_seen(const Mask<T>& opposite, const Vector<T>* p, const Vector<T>& own) {
  const Vector<T> base = select(opposite, p[0], own), end = select(opposite, p[1], p[0]),
                  side = select(opposite, own, p[1]);
  return hinge_shape(end - base, side - base, p[2] - base);
}

/// Holds a hinge's constants in the discrete model.
template <class T>
struct HingeStencilOf {
  T stiffness, rest_angle;  ///< c [J], θ₀ [rad]
};
using HingeStencil = HingeStencilOf<float>;

/// Holds a hinge's weights in the isometric model [1/m]: `own` is the weight of the vertex that sees the hinge, `other`
/// has the weights of the other vertices in the order of HingeIncidence::index.
struct IsometricStencil {
  float own = 0, other[3] = {};
};

/// Holds the values of a hinge that the discrete model reads for one vertex.
template <class N>
struct HingeReadsOf {
  HingeStencilOf<N> stencil;  ///< c and θ₀
  Mask<N> opposite;           ///< whether the vertex is an opposite one
  Vector<N> p[3];             ///< positions of the other vertices, as in hinge_shape_seen [m]
  N angle_start{};            ///< θᵗ [rad]; 0 without damping
};

/// Holds the values of a hinge that any bending model may read.
struct HingeSeen : HingeReadsOf<float> {
  Vec own;                     ///< position of the vertex that is updated [m]
  IsometricStencil isometric;  ///< read by the isometric model
};

}  // namespace ogc::fast
