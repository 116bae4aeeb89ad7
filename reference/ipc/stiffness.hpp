// The barrier's stiffness κ (Li et al. 2020, supplement; constants of the official code). A step's energies are in
// joules here, in the official code they are multiplied by h². So κ has the unit J/m⁴ and is the official κ divided by
// h².
#pragma once

#include <optional>

#include "compare/problem/settings.hpp"
#include "reference/ipc/pairs.hpp"
#include "reference/ipc/settings.hpp"

namespace ogc::reference {

/// The length and the stiffness to which κ is proportional.
struct StiffnessScale {
  double diagonal = 0;  ///< diagonal of the rest box [m]
  double inertia = 0;   ///< mean m/h² of the free vertices [N/m]
};

/// Limits of κ. At the lower limit, the barrier's curvature at a distance of 1e-8 diagonals is 1e11 times the mean
/// inertia. The upper limit is a hundred times the lower limit. With IpcAdaptation::gap, the thickness is added to the
/// distance of 1e-8 diagonals.
struct StiffnessBounds {
  double lower = 0, upper = 0;  ///< [J/m⁴]
};
/// Returns the limits of κ for a scene.
StiffnessBounds stiffness_bounds(const BarrierShape& shape, const StiffnessScale& scale, IpcAdaptation adaptation);

/// Returns the κ between the limits that minimises ‖∇E + κ ∇b‖; the lower limit if there is no barrier.
double initial_stiffness(const State& energy_gradient, const State& barrier_gradient, const StiffnessBounds& bounds);

/// Finds pairs that were closer than 1e-9 diagonals of the rest box at the last call and are even closer now. The
/// solver doubles κ if there is such a pair.
class StiffnessGuard {
 public:
  StiffnessGuard(const StiffnessScale& scale, const BarrierShape& shape, IpcAdaptation adaptation);
  /// Forgets the pairs that were close at the last call.
  void forget() { close_.clear(); }
  /// Returns a pair that has come closer since the last call, if any; stores the pairs that are close now.
  std::optional<PrimitivePair> came_closer(const BarrierSet& set);

 private:
  struct Close {
    PrimitivePair pair;
    double squared;
  };
  double near_squared_;  ///< square of the distance below which a pair is close [m²]
  std::vector<Close> close_;
};

}  // namespace ogc::reference
