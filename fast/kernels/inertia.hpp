// Computes the target y of inertia, and adds force and block of its energy m/(2h²) ‖x − y‖².
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Returns y = xᵗ + h vᵗ + h² a [m].
OGC_HD inline Vec inertia_target(const Vec& start, const Vec& velocity, const Vec& acceleration, float step) {
  return start + step * (velocity + step * acceleration);
}

/// Adds the force and block of inertia; `weight` is m/h² [N/m].
OGC_HD inline void add_inertia(float weight, const Vec& position, const Vec& target, ForceAndBlock& sum) {
  sum.add_force(weight, target - position);
  sum.add_identity(weight);
}

}  // namespace ogc::fast
