// The barrier's stiffness κ (Li et al. 2020, supplement; constants of the official code). Energies here are those of a
// step in joules, mass/h² times squared lengths, so that κ has the unit J/m⁴ and is the official one divided by h².
#pragma once

#include <optional>

#include "compare/problem/settings.hpp"
#include "reference/ipc/pairs.hpp"
#include "reference/ipc/settings.hpp"

namespace ogc::reference {

/// The scales of κ.
struct StiffnessScale {
  double diagonal = 0;  ///< of the rest box [m]
  double inertia = 0;   ///< mean m/h² of the free vertices [N/m]
};

/// The lower bound is the κ with which the barrier's curvature at a distance of 1e-8 diagonals is 1e11 mean inertias;
/// the upper one is a hundred times that. `distance` takes that distance as the gap, `gap` measures it from the
/// thickness.
struct StiffnessBounds {
  double lower = 0, upper = 0;  ///< [J/m⁴]
};
/// Returns the bounds of κ for a scene.
StiffnessBounds stiffness_bounds(const BarrierShape& shape, const StiffnessScale& scale, IpcAdaptation adaptation);

/// Returns the κ within the bounds that makes ‖∇E + κ ∇b‖ smallest; the lower bound where there is no barrier.
double initial_stiffness(const State& energy_gradient, const State& barrier_gradient, const StiffnessBounds& bounds);

/// Finds pairs that were closer than 1e-9 diagonals and have come closer still; κ is then doubled.
class StiffnessGuard {
 public:
  StiffnessGuard(const StiffnessScale& scale, const BarrierShape& shape, IpcAdaptation adaptation);
  /// Forgets the earlier gaps.
  void forget() { close_.clear(); }
  /// Returns a pair that came closer since the last call, if any; remembers the pairs that are close now.
  std::optional<PrimitivePair> came_closer(const BarrierSet& set);

 private:
  struct Close {
    PrimitivePair pair;
    double squared;
  };
  double near_squared_;  ///< [m²]
  std::vector<Close> close_;
};

}  // namespace ogc::reference
