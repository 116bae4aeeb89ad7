// The barrier's stiffness κ (Li et al. 2020, supplement; constants of the official code). Energies here are those of a
// step in joules, mass/h² times squared lengths, so that κ has the unit J/m⁴ and is the official one divided by h².
#pragma once

#include <optional>

#include "compare/problem/settings.hpp"
#include "reference/ipc/pairs.hpp"
#include "reference/ipc/settings.hpp"

namespace ogc::reference {

/// What κ is measured by.
struct StiffnessScale {
  double diagonal = 0;  ///< of the rest box [m]
  double inertia = 0;   ///< mean m/h² of the free vertices [N/m]
};

/// κ with which the barrier's curvature at a distance of 1e-8 diagonals is 1e11 mean inertias, and a hundred times
/// that. `distance` takes that distance as the gap, `gap` lets it begin at the thickness.
struct StiffnessBounds {
  double lower = 0, upper = 0;  ///< [J/m⁴]
};
/// The bounds of κ for a scene, by what is said above.
StiffnessBounds stiffness_bounds(const BarrierShape& shape, const StiffnessScale& scale, IpcAdaptation adaptation);

/// The κ within the bounds that makes ‖∇E + κ ∇b‖ smallest; the lower one where there is no barrier.
double initial_stiffness(const State& energy_gradient, const State& barrier_gradient, const StiffnessBounds& bounds);

/// Doubles κ where a pair that was closer than 1e-9 diagonals has come closer still.
class StiffnessGuard {
 public:
  StiffnessGuard(const StiffnessScale& scale, const BarrierShape& shape, IpcAdaptation adaptation);
  /// The next gaps have none before them.
  void forget() { close_.clear(); }
  /// A pair that came closer since the last call, if any; remembers those that are close now.
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
