// Lists every number that a user can set, with unit, range and default, in one table. `--set`, scene files, `--help`
// and run.json read it. Settings of the problem, which every contestant reads, are fields of a struct. A contestant
// declares the settings that only it reads (SettingsDeclaration); the problem stores these by name and value.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "compare/problem/bounds.hpp"

namespace ogc::compare {

// Choices among named variants. Their underlying type is that of whole-number settings, so that a test can check that
// the table covers all fields.

/// Contact energy over distance (method.md §4.2): Eq. 18 with Eq. 19 corrected, or another activation.
enum class ContactActivation : std::int64_t { ogc, ogc_as_printed, quadratic, ipc_log, cubic };
/// The motion that stiffness-proportional damping resists (method.md §4.9): the change of a stencil's strain, or the
/// motion of each vertex (with the vertex's own block as stiffness).
enum class DampingForm : std::int64_t { strain, per_vertex };
/// Returns whether strains are damped; otherwise the motion of each vertex is damped.
constexpr bool damps_strain(DampingForm form) {
  switch (form) {
    case DampingForm::strain: return true;
    case DampingForm::per_vertex: return false;
  }
  return true;
}

/// How a sweep sets the quaternion of a segment (compare/rods.md): to the minimiser, or as in Hsu et al. 2025.
enum class RodOrientation : std::int64_t { exact, as_published };
/// Returns whether a segment's quaternion is set to the minimiser.
constexpr bool minimises(RodOrientation update) {
  switch (update) {
    case RodOrientation::exact: return true;
    case RodOrientation::as_published: return false;
  }
  return true;
}
/// Orientations at the start of a step: the orientations after the last step, rotated with their segments or unchanged.
enum class RodStart : std::int64_t { turned, kept };
/// Returns whether orientations are rotated with their segments before the first sweep.
constexpr bool turns(RodStart start) {
  switch (start) {
    case RodStart::turned: return true;
    case RodStart::kept: return false;
  }
  return true;
}

/// The settings of a scene; `setting_table` has their units, ranges and defaults.
struct Settings {
  double time_step = 0.01;           ///< h [s]
  std::int64_t steps = 100;          ///< steps of the run
  std::int64_t iterations = 40;      ///< sweeps a step
  double contact_radius = 0.005;     ///< r [m]
  double detection_radius_cap = 4;   ///< cap of r_q, in units of r (method.md §5.3)
  Bounds bounds = Bounds::ball;      ///< what keeps vertices from passing through others between two detections
  double bounds_relaxation = 0.45;   ///< γ_p, Eq. 21
  double contact_margin = 0;         ///< contacts are listed up to this far beyond r, in units of r
  double detection_fraction = 0.01;  ///< γ_e, Alg. 3 line 29
  std::int64_t detection_every = 0;  ///< number of iterations after which contacts are detected again; 0: no limit
  std::int64_t detection_gap = 1;    ///< least number of iterations between two detections of a step
  std::int64_t detection_deep = 1;   ///< 1: a vertex deep inside a volume causes detections (compare/volumes.md); 0: no
  double settled_move = 0;           ///< largest move of an iteration that ends a step [m]; 0: none does
  std::int64_t guess_rounds = 16;    ///< rounds of the guess loop (method.md §5.2); 1: as printed in Eq. 28
  double friction_velocity = 0.01;   ///< ε_v [m/s]
  std::int64_t frame_steps = 0;      ///< steps between stored frames; 0: max(1, round(1/(60 h)))
  /// W, width of the sums of the sweep: 2, 4, 8 or 16; 0: by mesh size
  std::int64_t lanes = 0;
  ContactActivation contact_activation = ContactActivation::ogc;  ///< contact energy over distance
  /// `per_vertex` is the damping of the paper's authors, which also resists translation
  DampingForm damping = DampingForm::strain;
  std::int64_t seed = 0;                                   ///< seed of all random numbers of the scene
  RodOrientation rod_orientation = RodOrientation::exact;  ///< how a sweep sets segments' orientations
  RodStart rod_start = RodStart::turned;                   ///< segments' orientations at the start of a step
  /// Values of settings that contestants declare, unless a value is the default. A choice is stored as its index. Only
  /// set_setting writes here.
  std::map<std::string, double, std::less<>> declared;
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// The kind of a setting's value.
enum class SettingKind : std::uint8_t { real, whole, choice };

/// A setting that a contestant declares, and that thus has no field.
struct DeclaredSetting {
  SettingKind kind = SettingKind::real;  ///< kind of its value
  double standard = 0;                   ///< default; for a choice the index of its name
};

/// One row of the table of settings.
struct SettingInfo {
  std::string_view name, unit, meaning;  ///< "contact_radius", "m", one line
  double minimum, maximum;               ///< inclusive
  /// member that holds the value
  std::variant<double Settings::*, std::int64_t Settings::*, ContactActivation Settings::*, DampingForm Settings::*,
               Bounds Settings::*, RodOrientation Settings::*, RodStart Settings::*, DeclaredSetting>
      field;
  std::span<const std::string_view> choices{};  ///< names of the values of a choice, in order; empty for a number
};

/// Returns all settings: those of the struct in its order, then those that contestants have declared, by the
/// contestants' names.
std::span<const SettingInfo> setting_table();

/// Adds a contestant's settings to the table, so that scene files, `--set`, `--help`, run.json and checks accept them.
/// Define it as an object of static storage beside the code that reads the settings; then a program has the settings of
/// all contestants that are linked into it. `rows` need static storage, too, and each has a DeclaredSetting.
class SettingsDeclaration {
 public:
  SettingsDeclaration(std::string_view contestant, std::span<const SettingInfo> rows);
};

/// Returns the kind of the row's value.
SettingKind kind_of(const SettingInfo& info);

/// Returns the present name of a setting, given its former name; "" for any other word.
std::string_view renamed_setting(std::string_view old);

/// Returns the message that no setting is called `name`. It contains the present name of a renamed setting, or else the
/// nearest of `known`.
std::string unknown_setting(std::string_view name, std::span<const std::string_view> known);

/// Sets `name` from text. Throws InputError for a bad value, with the setting's unit and range, and for an unknown
/// name, with the nearest known name.
void set_setting(Settings& settings, std::string_view name, std::string_view value);

/// Sets a number, or a choice by its index, without checking the range (validate.hpp does). Throws InputError for an
/// unknown name.
void set_setting(Settings& settings, std::string_view name, double value);
void set_setting(Settings& settings, const SettingInfo& info, double value);

/// Returns "a number from 1 to 1024 r (cap of …)": the values that a row allows, for messages and help.
std::string describe_range(const SettingInfo& info);

/// Returns whether the row allows the value: it is in the range and, for `lanes`, 0 or a power of two above 1.
/// Not-a-number is not allowed.
bool in_range(const SettingInfo& info, double value);

/// Returns the value as a user would type it: the name of a choice, otherwise the shortest decimal text.
std::string setting_text(const Settings& settings, const SettingInfo& info);

/// Returns the value of the row's setting as a double; for a choice its index.
double get_setting(const Settings& settings, const SettingInfo& info);

/// Returns the value of a setting as a double. Throws InputError for an unknown name.
double get_setting(const Settings& settings, std::string_view name);

}  // namespace ogc::compare
