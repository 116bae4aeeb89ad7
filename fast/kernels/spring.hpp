// A spring seen from one of its ends: k_s/2 (l − l₀)², damping (k_d/h) k_s/2 (l − lᵗ)² (compare/stages/spring.hpp).
#pragma once

#include <cmath>

#include "fast/kernels/accumulator.hpp"
#include "fast/kernels/qualifiers.hpp"
#include "fast/kernels/vector.hpp"

namespace ogc::fast {

struct SpringRest {
  int end[2] = {-1, -1};
  float stiffness = 0, rest_length = 0;  ///< k_s [N/m], l₀ [m]
  float damping = 0;                     ///< k_d/h [1]
};

/// 0 where the squared length is no normal number.
OGC_HD inline float spring_length(const Vec& apart) {
  const float squared = dot(apart, apart);
  return squared >= 0x1p-126f ? sqrtf(squared) : 0.0f;
}

/// Adds force and block of the end x₀; `apart` = x₀ − x₁, `length_start` lᵗ.
OGC_HD inline void add_spring(const SpringRest& spring, float damping, const Vec& apart, float length_start, ForceAndBlock& sum) {
  const float length = spring_length(apart), stiffness = spring.stiffness;
  if (!(length > 0)) {
    if (spring.rest_length == 0) sum.add_identity(stiffness);
    return;
  }
  const float stretched = 1.0f - spring.rest_length / length, across = stretched > 0 ? stretched : 0.0f, resistance = damping * stiffness;
  sum.add_force(-(stiffness * stretched + resistance * ((length - length_start) / length)), apart);
  sum.add_identity(stiffness * across);
  sum.add_outer(stiffness * (1.0f - across) + resistance, (1.0f / length) * apart);
}

/// [J], in double: energies are only reported.
OGC_HD inline double spring_energy(const SpringRest& spring, float length) {
  const double change = static_cast<double>(length) - spring.rest_length;
  return 0.5 * spring.stiffness * change * change;
}

}  // namespace ogc::fast
