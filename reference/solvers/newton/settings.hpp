// What Newton's method is set to beside the problem's own settings; IPC shares friction_solves and projection.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"

namespace ogc::reference {

/// What Newton's step is held to between two detections.
enum class Truncation {
  vertex,  ///< each vertex to its own region, a ball or what `bounds` says
  pair     ///< near pairs to planes that travel with them (moving_planes.hpp)
};
/// Whether planes travel with near pairs.
constexpr bool moves_planes(Truncation truncation) {
  switch (truncation) {
    case Truncation::vertex: return false;
    case Truncation::pair: return true;
  }
  return false;
}

/// See the table of settings for ranges and defaults.
struct NewtonSettings {
  std::int64_t iterations;       ///< a step at most
  double tolerance;              ///< residual (Eq. 29) at which a step has converged; 0: all iterations are done
  double step_tolerance;         ///< a step has also converged where no vertex wants to move faster than this [m/s]
  std::int64_t friction_solves;  ///< solves a step, each with friction lagged to the one before
  HessianProjection projection;  ///< of each stencil's Hessian
  Truncation truncation;
};

/// As the problem carries them: newton_iterations, newton_tolerance, newton_step_tolerance, friction_solves,
/// projection and truncation.
NewtonSettings newton_settings(const compare::Settings& settings);

}  // namespace ogc::reference
