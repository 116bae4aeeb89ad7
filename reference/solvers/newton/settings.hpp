// Settings that only Newton's method has. IPC shares two of them, newton_friction_solves and newton_projection.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"

namespace ogc::reference {

/// Selects what limits Newton's step between two detections.
enum class Truncation {
  vertex,  ///< a region for each vertex, as the setting `bounds` selects
  pair     ///< a plane for each near pair, which moves with the pair (moving_planes.hpp)
};
/// Returns whether a plane moves with each near pair, in place of a fixed region for each vertex.
constexpr bool moves_planes(Truncation truncation) {
  switch (truncation) {
    case Truncation::vertex: return false;
    case Truncation::pair: return true;
  }
  return false;
}

/// Settings of Newton's method; the table of settings has their ranges and defaults.
struct NewtonSettings {
  std::int64_t iterations;  ///< most iterations of a step
  double tolerance;         ///< residual (Eq. 29) at which a step has converged; if 0, all iterations run
  /// a step has also converged if Newton's direction δ moves every vertex by less than this times h [m/s]
  double step_tolerance;
  /// number of solves in a step; each takes lagged friction from the result of the previous solve
  std::int64_t friction_solves;
  HessianProjection projection;  ///< projection of each stencil's Hessian
  Truncation truncation;
};

/// Reads newton_iterations, newton_tolerance, newton_step_tolerance, newton_friction_solves, newton_projection and
/// newton_truncation from the problem's settings.
NewtonSettings newton_settings(const compare::Settings& settings);

}  // namespace ogc::reference
