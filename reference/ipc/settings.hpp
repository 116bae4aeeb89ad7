// What IPC is set to beside the problem's own settings, and those that it shares with Newton's method.
#pragma once

#include <cstdint>

#include "compare/problem/settings.hpp"

namespace ogc::reference {

/// How IPC's barrier stiffness κ adapts: by distances (Li et al. 2020), or by gaps, which a thickness leaves of them
/// (Li et al. 2021).
enum class IpcAdaptation : std::uint8_t { distance, gap };
/// When an IPC step has converged: ‖p‖_∞ < tolerance · diagonal · h (Li et al. 2020; the diagonal is that of the
/// smallest free body, moving_diagonal), or root mean square of ‖p_v‖/h of the last three iterations (2021).
enum class IpcStopping : std::uint8_t { displacement, velocity };
/// Which pairs bound an IPC step: the active ones and d̂/2 of motion for the others while that takes at most half of it
/// (Li et al. 2020), or all (2021).
enum class IpcCcd : std::uint8_t { partial, full };

/// See the table of settings for ranges and defaults.
struct IpcSettings {
  double distance;           ///< barrier distance d̂ [m]; 0: by relative_distance
  double relative_distance;  ///< d̂ in units of the rest box's diagonal
  double thickness;          ///< ξ, the distance that surfaces keep at least [m]
  double stiffness;          ///< κ, fixed [J/m⁴]; 0: adaptive
  IpcAdaptation adaptation;  ///< how κ adapts
  IpcStopping stopping;      ///< which of the two rules ends a step
  IpcCcd ccd;                ///< which pairs bound a step
  double tolerance;  ///< `displacement`: in diagonals of moving_diagonal a second [1/s]; 0: all iterations are done
  double velocity_tolerance;  ///< `velocity` [m/s]; 0: all iterations are done
  std::int64_t iterations;    ///< a step at most; it then ends where it is, as in the published codes
};

/// As the problem carries them, each under its name with "ipc_" before it.
IpcSettings ipc_settings(const compare::Settings& settings);

}  // namespace ogc::reference
