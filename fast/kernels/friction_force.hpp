// Adds the friction of one contact on one vertex: IPC's lagged potential with f₁, stabilised as in Vertex Block Descent
// (method.md §4.4). The derivatives treat λ, n and the weights, taken at the positions that the update reads, as
// constants.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Returns f₁(y)/y [1/m] for the slip y and ε = ε_v h [m]: (2 − y/ε)/ε for y < ε, else 1/y.
template <class T>
OGC_HD T friction_slope_over_slip(const T& slip, float limit) {
  return choose(
      slip < T(limit), [&] { return (2.0f - slip / limit) / limit; }, [&] { return 1.0f / slip; });
}

/// Adds the force −μ λ f₁/‖u‖ w u and the block μ λ f₁/‖u‖ w² (I − n nᵀ), with `majorant` in place of w². u is the
/// slip, the tangential part of `moved` = Σ w_i (x_i − x_iᵗ) [m]. `normal_force` is λ ≥ 0 [N], `limit` is ε_v h [m].
template <class T>
OGC_HD void add_friction(const Vector<T>& normal, const Vector<T>& moved, const T& weight, const T& majorant,
                         const T& friction, const T& normal_force, float limit, ForceAndBlockOf<T>& sum) {
  const Vector<T> slip = moved - dot(normal, moved) * normal;
  const T strength = friction * normal_force * friction_slope_over_slip(root(dot(slip, slip)), limit);
  sum.add_force(-strength * weight, slip);
  sum.add_identity(strength * majorant);
  sum.add_outer(-strength * majorant, normal);
}

}  // namespace ogc::fast
