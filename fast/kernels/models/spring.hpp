// Adds a spring as one of its ends sees it: the energy k_s/2 (l − l₀)² and the damping (k_d/h) k_s/2 (l − lᵗ)², with l
// = ‖x₀ − (1 − s) x₁ − s x₂‖ (compare/stages/spring.hpp).
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A spring or stitch at rest.
struct SpringRest {
  int end[3] = {-1, -1, -1};             ///< vertices; the third equals the second if s = 0
  float stiffness = 0, rest_length = 0;  ///< k_s [N/m], l₀ [m]
  float damping = 0;                     ///< k_d/h [1]
  float ratio = 0;                       ///< s [1]
};

/// Returns the number of ends: 2 for a spring, 3 for a stitch.
inline int end_count(const SpringRest& spring) { return spring.ratio > 0 ? 3 : 2; }

/// Returns x₀ − (1 − s) x₁ − s x₂.
OGC_HD inline Vec spring_apart(const SpringRest& spring, const Vec* end) {
  const Vec apart = end[0] - end[1];
  return spring.ratio > 0 ? apart - spring.ratio * (end[2] - end[1]) : apart;
}

/// Returns the weight w of an end in l: 1, s − 1 or −s.
OGC_HD inline float spring_weight(const SpringRest& spring, int end) {
  return end == 0 ? 1.0f : end == 1 ? spring.ratio - 1.0f : -spring.ratio;
}

/// Returns l [m]; 0 if the squared length is not a normal number.
OGC_HD inline float spring_length(const Vec& apart) {
  const float squared = dot(apart, apart);
  return squared >= 0x1p-126f ? sqrtf(squared) : 0.0f;
}

/// Adds the force and block of the end with weight w. `apart` is x₀ − (1 − s) x₁ − s x₂, `length_start` is lᵗ.
OGC_HD inline void add_spring(const SpringRest& spring, float weight, float damping, const Vec& apart,
                              float length_start, ForceAndBlock& sum) {
  const float length = spring_length(apart), stiffness = weight * weight * spring.stiffness;
  // Without a length there is no direction and no force. The block w² k_s I majorises the energy for every l₀. It is
  // also needed for a stitch with l₀ = 0, whose length may have been lost to rounding.
  if (!(length > 0)) {
    sum.add_identity(stiffness);
    return;
  }
  const float stretched = 1.0f - spring.rest_length / length, across = stretched > 0 ? stretched : 0.0f,
              resistance = damping * stiffness;
  const float pull = spring.stiffness * stretched + damping * spring.stiffness * ((length - length_start) / length);
  sum.add_force(-(weight * pull), apart);
  sum.add_identity(stiffness * across);
  sum.add_outer(stiffness * (1.0f - across) + resistance, (1.0f / length) * apart);
}

/// Returns the energy [J], in double because it is only reported.
OGC_HD inline double spring_energy(const SpringRest& spring, float length) {
  const double change = static_cast<double>(length) - spring.rest_length;
  return 0.5 * spring.stiffness * change * change;
}

}  // namespace ogc::fast
