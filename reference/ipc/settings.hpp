// Holds the settings that only IPC has. IPC shares other settings with Newton's method.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// Selects how IPC's barrier stiffness κ adapts: by distances (Li et al. 2020), or by gaps, the distances minus the
/// thickness (Li et al. 2021).
enum class IpcAdaptation : std::uint8_t { distance, gap };
/// Selects when an IPC step has converged. `displacement`: ‖p‖_∞ < tolerance · moving_diagonal · h (Li et al. 2020),
/// with the diagonal of the smallest free body. `velocity`: the root mean square of ‖p_v‖/h over the last three
/// iterations is below velocity_tolerance (Li et al. 2021).
enum class IpcStopping : std::uint8_t { displacement, velocity };
/// Selects the pairs that bound an IPC step. `partial` (Li et al. 2020): CCD of the active pairs, and a largest motion
/// of d̂/2 for all other pairs. If this motion is less than half of what CCD allows, CCD of all pairs replaces this
/// limit. `full` (Li et al. 2021): CCD of all pairs.
enum class IpcCcd : std::uint8_t { partial, full };

/// IPC's settings. The table of settings has their ranges and defaults.
struct IpcSettings {
  double distance;           ///< barrier distance d̂ [m]; 0: from relative_distance
  double relative_distance;  ///< d̂ in units of the rest box's diagonal
  double thickness;          ///< ξ, the least distance of surfaces [m]
  double stiffness;          ///< κ, fixed [J/m⁴]; 0: adaptive
  IpcAdaptation adaptation;  ///< how κ adapts
  IpcStopping stopping;      ///< the rule that ends a step
  IpcCcd ccd;                ///< which pairs bound a step
  double tolerance;  ///< for `displacement`, in units of moving_diagonal per second [1/s]; 0: all iterations run
  double velocity_tolerance;  ///< for `velocity` [m/s]; 0: all iterations run
  /// limit of iterations of a step; the step then ends without convergence, as in the published codes
  std::int64_t iterations;
};

/// Reads the settings from the problem's settings, where their names begin with "ipc_".
IpcSettings ipc_settings(const compare::Settings& settings);

}  // namespace ogc::reference
