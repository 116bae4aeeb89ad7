// Every number a user can set, each with unit, range and default, in one table: `--set`, scene files, `--help` and
// run.json read it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace ogc::compare {

// Choices among named variants. As wide as every other setting, so that a test can see that the table reaches all of
// them.

/// How Newton's method makes a stencil's Hessian positive semidefinite: not at all, negative eigenvalues to 0, or to
/// their absolute values.
enum class HessianProjection : std::int64_t { none, clamp, absolute };
/// Contact energy over distance (method.md §4.2): Eq. 18 with Eq. 19 corrected, or one of the variants of the ablation.
enum class ContactActivation : std::int64_t { ogc, ogc_as_printed, quadratic, ipc_log, cubic };
/// How IPC's barrier stiffness κ adapts: by distances (Li et al. 2020), or by gaps, which a thickness leaves of them
/// (Li et al. 2021).
enum class IpcAdaptation : std::int64_t { distance, gap };
/// When an IPC step has converged: ‖p‖_∞ < tolerance · diagonal · h (Li et al. 2020), or root mean square of ‖p_v‖/h of
/// the last three iterations (2021).
enum class IpcStopping : std::int64_t { displacement, velocity };
/// Which pairs bound an IPC step: the active ones and d̂/2 of motion for the others while that takes at most half of it
/// (Li et al. 2020), or all (2021).
enum class IpcCcd : std::int64_t { partial, full };
/// What stiffness-proportional damping acts on (method.md §4.9): the change of a stencil's strain, or each vertex's own
/// motion through its own block.
enum class DampingForm : std::int64_t { strain, per_vertex };
/// What keeps a vertex from passing through others between two detections (method.md §5b): a ball about X_prev, as in
/// the paper; planes between near pairs, and a ball for the others; nothing.
enum class Bounds : std::int64_t { ball, planes, off };

/// Names of the activations and damping forms, in the order of the enumerations.
std::span<const std::string_view> activation_names();
std::span<const std::string_view> damping_form_names();

struct Settings {
  double time_step = 0.01;          ///< h [s]
  std::int64_t steps = 100;         ///< steps of the run
  std::int64_t iterations = 40;     ///< sweeps a step
  double contact_radius = 0.005;    ///< r [m]
  double query_radius_cap = 4;      ///< cap of r_q, in units of r (method.md §5.3)
  Bounds bounds = Bounds::ball;     ///< what keeps vertices from passing through others between two detections
  double bound_relaxation = 0.45;   ///< γ_p, Eq. 21
  double contact_margin = 0;        ///< by which contacts are listed beyond r, in units of r
  double redetect_fraction = 0.01;  ///< γ_e, Alg. 3 line 29
  std::int64_t redetect_every = 0;  ///< re-detect at the latest after so many iterations; 0: never by count
  std::int64_t guess_rounds = 16;   ///< rounds of the guess loop (method.md §5.2); 1: as printed in Eq. 28
  double friction_velocity = 0.01;  ///< ε_v [m/s]
  std::int64_t frame_steps = 0;     ///< steps between stored frames; 0: max(1, round(1/(60 h)))
  /// W, width of every sum of the sweep: 1, 2, 4, 8, 16 or 32; 0: by mesh size
  std::int64_t lanes = 0;
  std::int64_t newton_iterations = 50;  ///< Newton: iterations a step at most
  /// Newton: residual (Eq. 29) at which a step has converged; 0: all iterations are done
  double newton_tolerance = 1e-4;
  /// Newton: a step has also converged where no vertex wants to move faster than this [m/s]
  double newton_step_tolerance = 0;
  std::int64_t friction_solves = 1;  ///< Newton: solves a step, each with friction lagged to the one before
  HessianProjection projection = HessianProjection::clamp;  ///< Newton: of each stencil's Hessian
  ContactActivation activation = ContactActivation::ogc;    ///< contact energy over distance
  /// `per_vertex`, the authors' form, brakes translation, too
  DampingForm damping = DampingForm::strain;
  double ipc_distance = 0;              ///< IPC: barrier distance d̂ [m]; 0: by ipc_relative_distance
  double ipc_relative_distance = 1e-3;  ///< IPC: d̂ in units of the rest box's diagonal
  double ipc_thickness = 0;             ///< IPC: ξ, the distance that surfaces keep at least [m]
  double ipc_stiffness = 0;             ///< IPC: κ, fixed [J/m⁴]; 0: adaptive
  IpcAdaptation ipc_adaptation = IpcAdaptation::distance;  ///< IPC: how κ adapts
  IpcStopping ipc_stopping = IpcStopping::displacement;    ///< IPC: which of the two rules ends a step
  IpcCcd ipc_ccd = IpcCcd::partial;                        ///< IPC: which pairs bound a step
  /// IPC, `displacement`: in diagonals of the rest box a second [1/s]; 0: all iterations are done
  double ipc_tolerance = 1e-2;
  double ipc_velocity_tolerance = 1e-3;  ///< IPC, `velocity` [m/s]; 0: all iterations are done
  /// IPC: iterations a step at most; the step then ends where it is, as in the published codes
  std::int64_t ipc_iterations = 10000;
  std::int64_t seed = 0;  ///< of whatever the scene draws at random
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// One row of the table of settings.
struct SettingInfo {
  std::string_view name, unit, meaning;
  double minimum, maximum;  ///< inclusive
  std::variant<double Settings::*, std::int64_t Settings::*, HessianProjection Settings::*,
               ContactActivation Settings::*, DampingForm Settings::*, Bounds Settings::*, IpcAdaptation Settings::*,
               IpcStopping Settings::*, IpcCcd Settings::*>
      field;
  std::span<const std::string_view> choices{};  ///< names of a choice, in the order of its values; empty for a number
};

/// All settings, in the order of the struct.
std::span<const SettingInfo> setting_table();

/// Sets `name` from text. Throws InputError that names the setting, its unit and its range (and the nearest known name
/// for an unknown one).
void set_setting(Settings& settings, std::string_view name, std::string_view value);

/// "a number from 1 to 1024 r (cap of …)": what may stand in this row, for messages and help.
std::string describe_range(const SettingInfo& info);

/// Whether the value lies within the row's bounds (and, for `lanes`, is 0 or a power of two); not-a-number does not.
bool in_range(const SettingInfo& info, double value);

/// The value as a user would type it: the name of a choice, otherwise the shortest decimal text.
std::string setting_text(const Settings& settings, const SettingInfo& info);

/// Value of the row's setting as a double; of a choice its number.
double get_setting(const Settings& settings, const SettingInfo& info);

/// Value of a setting as a double. Throws InputError for an unknown name.
double get_setting(const Settings& settings, std::string_view name);

}  // namespace ogc::compare
