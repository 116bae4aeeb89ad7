// Every number a user can set, each with unit, range and default, in one table: `--set`, scene files, `--help` and
// run.json read it. Settings of the problem, which every contestant reads, are fields of a struct. What one contestant
// alone reads it declares itself (SettingsDeclaration), and the problem carries it as name and value.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "compare/problem/bounds.hpp"

namespace ogc::compare {

// Choices among named variants. As wide as every other setting, so that a test can see that the table reaches all of
// them.

/// Contact energy over distance (method.md §4.2): Eq. 18 with Eq. 19 corrected, or one of the variants of the ablation.
enum class ContactActivation : std::int64_t { ogc, ogc_as_printed, quadratic, ipc_log, cubic };
/// What stiffness-proportional damping acts on (method.md §4.9): the change of a stencil's strain, or each vertex's own
/// motion through its own block.
enum class DampingForm : std::int64_t { strain, per_vertex };
/// Whether energies of strains damp, or each vertex's block.
constexpr bool damps_strain(DampingForm form) {
  switch (form) {
    case DampingForm::strain: return true;
    case DampingForm::per_vertex: return false;
  }
  return true;
}

/// How a sweep sets the quaternion of a segment (compare/rods.md): to the minimiser, or as Hsu et al. 2025 have it.
enum class RodOrientation : std::int64_t { exact, as_published };
/// Whether a segment's quaternion is the minimiser.
constexpr bool minimises(RodOrientation update) {
  switch (update) {
    case RodOrientation::exact: return true;
    case RodOrientation::as_published: return false;
  }
  return true;
}
/// What a step begins with: orientations turned along with their segments, or as the step before left them.
enum class RodStart : std::int64_t { turned, kept };
/// Whether orientations turn before the first sweep.
constexpr bool turns(RodStart start) {
  switch (start) {
    case RodStart::turned: return true;
    case RodStart::kept: return false;
  }
  return true;
}

/// The settings of a scene; `setting_table` has their units, ranges and defaults.
struct Settings {
  double time_step = 0.01;          ///< h [s]
  std::int64_t steps = 100;         ///< steps of the run
  std::int64_t iterations = 40;     ///< sweeps a step
  double contact_radius = 0.005;    ///< r [m]
  double detection_radius_cap = 4;  ///< cap of r_q, in units of r (method.md §5.3)
  Bounds bounds = Bounds::ball;     ///< what keeps vertices from passing through others between two detections
  double bounds_relaxation = 0.45;  ///< γ_p, Eq. 21
  double contact_margin = 0;        ///< by which contacts are listed beyond r, in units of r
  double detection_fraction = 0.01;  ///< γ_e, Alg. 3 line 29
  std::int64_t detection_every = 0;  ///< re-detect at the latest after so many iterations; 0: never by count
  std::int64_t guess_rounds = 16;   ///< rounds of the guess loop (method.md §5.2); 1: as printed in Eq. 28
  double friction_velocity = 0.01;  ///< ε_v [m/s]
  std::int64_t frame_steps = 0;     ///< steps between stored frames; 0: max(1, round(1/(60 h)))
  /// W, width of every sum of the sweep: 1, 2, 4, 8, 16 or 32; 0: by mesh size
  std::int64_t lanes = 0;
  ContactActivation contact_activation = ContactActivation::ogc;  ///< contact energy over distance
  /// `per_vertex`, the authors' form, brakes translation, too
  DampingForm damping = DampingForm::strain;
  std::int64_t seed = 0;                                     ///< of whatever the scene draws at random
  RodOrientation rod_orientation = RodOrientation::exact;    ///< of the segments of rods
  RodStart rod_start = RodStart::turned;                     ///< of the orientations of segments
  /// Declared by contestants, where not the default: numbers, of a choice the index of its name. By set_setting.
  std::map<std::string, double, std::less<>> declared;
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// What kind of value a setting has.
enum class SettingKind : std::uint8_t { real, whole, choice };

/// In place of a field: a setting that a contestant declares.
struct DeclaredSetting {
  SettingKind kind = SettingKind::real;  ///< of its value
  double standard = 0;                   ///< default; of a choice the index of its name
};

/// One row of the table of settings.
struct SettingInfo {
  std::string_view name, unit, meaning;  ///< "contact_radius", "m", one line
  double minimum, maximum;               ///< inclusive
  /// where the value is kept
  std::variant<double Settings::*, std::int64_t Settings::*, ContactActivation Settings::*, DampingForm Settings::*,
               Bounds Settings::*, RodOrientation Settings::*, RodStart Settings::*, DeclaredSetting>
      field;
  std::span<const std::string_view> choices{};  ///< names of a choice, in the order of its values; empty for a number
};

/// All settings: those of the struct in its order, then what contestants have declared, by the contestants' names.
std::span<const SettingInfo> setting_table();

/// Adds a contestant's settings to the table, so that scene files, `--set`, `--help`, run.json and checks know them.
/// Make it an object of static storage beside the code that reads the settings: a program knows those of the
/// contestants that it is linked with. `rows`: of static storage, too, each with a DeclaredSetting.
class SettingsDeclaration {
 public:
  SettingsDeclaration(std::string_view contestant, std::span<const SettingInfo> rows);
};

/// The kind of the row's value.
SettingKind kind_of(const SettingInfo& info);

/// The name that a setting has in place of one that it had before; "" for any other word.
std::string_view renamed_setting(std::string_view old);

/// Says that no setting has this name: which one it has now, or the nearest of `known`.
std::string unknown_setting(std::string_view name, std::span<const std::string_view> known);

/// Sets `name` from text. Throws InputError that names the setting, its unit and its range (and the nearest known name
/// for an unknown one).
void set_setting(Settings& settings, std::string_view name, std::string_view value);

/// Sets a number, or a choice by the index of its name, without a check of its range (validate.hpp). Throws InputError
/// for an unknown name.
void set_setting(Settings& settings, std::string_view name, double value);
void set_setting(Settings& settings, const SettingInfo& info, double value);

/// "a number from 1 to 1024 r (cap of …)": what may stand in this row, for messages and help.
std::string describe_range(const SettingInfo& info);

/// Whether the value lies within the row's bounds (and, for `lanes`, is 0 or a power of two above 1); not-a-number does
/// not.
bool in_range(const SettingInfo& info, double value);

/// The value as a user would type it: the name of a choice, otherwise the shortest decimal text.
std::string setting_text(const Settings& settings, const SettingInfo& info);

/// Value of the row's setting as a double; of a choice the index of its name.
double get_setting(const Settings& settings, const SettingInfo& info);

/// Value of a setting as a double. Throws InputError for an unknown name.
double get_setting(const Settings& settings, std::string_view name);

}  // namespace ogc::compare
