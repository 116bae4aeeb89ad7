// Settings of Newton's method beside the problem's own; IPC shares newton_friction_solves and newton_projection.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"

namespace ogc::reference {

/// Selects what limits Newton's step between two detections.
enum class Truncation {
  vertex,  ///< a region for each vertex, by `bounds`
  pair     ///< near pairs have planes that travel with them (moving_planes.hpp)
};
/// Returns whether planes travel with near pairs.
constexpr bool moves_planes(Truncation truncation) {
  switch (truncation) {
    case Truncation::vertex: return false;
    case Truncation::pair: return true;
  }
  return false;
}

/// Newton's settings. The table of settings has their ranges and defaults.
struct NewtonSettings {
  std::int64_t iterations;  ///< most iterations of a step
  double tolerance;         ///< residual (Eq. 29) at which a step has converged; 0: all iterations run
  double step_tolerance;  ///< a step has also converged if Newton's direction moves every vertex slower than this [m/s]
  std::int64_t friction_solves;  ///< solves of a step; each lags friction to the previous solve
  HessianProjection projection;  ///< projection of each stencil's Hessian
  Truncation truncation;
};

/// Reads newton_iterations, newton_tolerance, newton_step_tolerance, newton_friction_solves, newton_projection and
/// newton_truncation from the problem's settings.
NewtonSettings newton_settings(const compare::Settings& settings);

}  // namespace ogc::reference
