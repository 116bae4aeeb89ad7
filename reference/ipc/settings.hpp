// Settings of IPC beside the problem's own and those that it shares with Newton's method.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// How IPC's barrier stiffness κ adapts: by distances (Li et al. 2020), or by the gaps that remain of them with a
/// thickness (Li et al. 2021).
enum class IpcAdaptation : std::uint8_t { distance, gap };
/// When an IPC step has converged: ‖p‖_∞ < tolerance · diagonal · h (Li et al. 2020; the diagonal is that of the
/// smallest free body, moving_diagonal), or root mean square of ‖p_v‖/h of the last three iterations (2021).
enum class IpcStopping : std::uint8_t { displacement, velocity };
/// Which pairs bound an IPC step: the active ones, and d̂/2 of motion for the others while that takes at most half of
/// the step (Li et al. 2020), or all (2021).
enum class IpcCcd : std::uint8_t { partial, full };

/// IPC's settings. The table of settings has ranges and defaults.
struct IpcSettings {
  double distance;           ///< barrier distance d̂ [m]; 0: from relative_distance
  double relative_distance;  ///< d̂ in units of the rest box's diagonal
  double thickness;          ///< ξ, the least distance of surfaces [m]
  double stiffness;          ///< κ, fixed [J/m⁴]; 0: adaptive
  IpcAdaptation adaptation;  ///< how κ adapts
  IpcStopping stopping;      ///< the rule that ends a step
  IpcCcd ccd;                ///< which pairs bound a step
  double tolerance;  ///< for `displacement`: in diagonals of moving_diagonal a second [1/s]; 0: all iterations are done
  double velocity_tolerance;  ///< for `velocity` [m/s]; 0: all iterations are done
  std::int64_t iterations;    ///< most of a step; it then ends where it is, as in the published codes
};

/// Reads the settings from the problem's, each under its name with "ipc_" before it.
IpcSettings ipc_settings(const compare::Settings& settings);

}  // namespace ogc::reference
