// Bounds are numbers that single precision holds exactly, so that rounding a setting can't take it out of its range.
#include "compare/problem/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double most_count = 1 << 30, most_seed = 0x1p53;
constexpr double least_length = 0x1p-20, most_length = 0x1p20;

constexpr std::array<std::string_view, 3> projection_names{"none", "clamp", "absolute"};
constexpr std::array<std::string_view, 5> activations{"ogc", "ogc_as_printed", "quadratic", "ipc_log", "cubic"};
constexpr std::array<std::string_view, 2> damping_forms{"strain", "per_vertex"};
constexpr std::array<std::string_view, 2> adaptation_names{"distance", "gap"};
constexpr std::array<std::string_view, 2> stopping_names{"displacement", "velocity"};
constexpr std::array<std::string_view, 2> ccd_names{"partial", "full"};

constexpr std::array<SettingInfo, 30> table{{
    {"time_step", "s", "h", 0x1p-20, 1, &Settings::time_step},
    {"steps", "1", "steps of the run", 0, most_count, &Settings::steps},
    {"iterations", "1", "sweeps a step", 1, most_count, &Settings::iterations},
    {"contact_radius", "m", "r", least_length, most_length, &Settings::contact_radius},
    {"query_radius_cap", "r", "cap of the query radius r_q, in units of r", 1, 1024, &Settings::query_radius_cap},
    {"bound_relaxation", "1", "γ_p, Eq. 21; below one half", 0x1p-10, 0.5 - 0x1p-10, &Settings::bound_relaxation},
    {"redetect_fraction", "1", "γ_e, Alg. 3 line 29: share of vertices cut at which contacts are detected again", 0, 1, &Settings::redetect_fraction},
    {"redetect_every", "1", "detect again at the latest after so many iterations; 0: never by count", 0, most_count, &Settings::redetect_every},
    {"guess_rounds", "1", "rounds of the guess loop; 1: as printed in Eq. 28", 1, 1 << 20, &Settings::guess_rounds},
    {"friction_velocity", "m/s", "ε_v, below which friction is not fully developed", 0x1p-30, 0x1p10, &Settings::friction_velocity},
    {"frame_steps", "1", "steps between stored frames; 0: max(1, round(1/(60 h)))", 0, most_count, &Settings::frame_steps},
    {"lanes", "1", "W, width of every sum of the sweep: 1, 2, 4, 8, 16 or 32; 0: by mesh size", 0, 32, &Settings::lanes},
    {"newton_iterations", "1", "Newton: iterations a step at most", 1, most_count, &Settings::newton_iterations},
    {"newton_tolerance", "1", "Newton: residual (Eq. 29) at which a step has converged; 0: all iterations are done", 0, 1, &Settings::newton_tolerance},
    {"newton_step_tolerance", "m/s", "Newton: converged, too, where no vertex wants to move faster than this", 0, 0x1p10, &Settings::newton_step_tolerance},
    {"friction_solves", "1", "Newton: solves a step, each with friction lagged to the one before", 1, 1 << 20, &Settings::friction_solves},
    {"projection", "1", "Newton: what becomes of stencils' negative eigenvalues where the sum has some, too", 0, 2, &Settings::projection, projection_names},
    {"activation", "1", "contact energy over distance", 0, 4, &Settings::activation, activations},
    {"damping", "1", "damping acts on the change of strains, or on the motion of each vertex alone (vbd)", 0, 1, &Settings::damping, damping_forms},
    {"ipc_distance", "m", "IPC: barrier distance; 0: by ipc_relative_distance", 0, most_length, &Settings::ipc_distance},
    {"ipc_relative_distance", "1", "IPC: barrier distance in diagonals of the rest box", least_length, 1, &Settings::ipc_relative_distance},
    {"ipc_thickness", "m", "IPC: the distance that surfaces keep at least", 0, most_length, &Settings::ipc_thickness},
    {"ipc_stiffness", "J/m⁴", "IPC: fixed stiffness of the barrier; 0: adaptive", 0, 0x1p120, &Settings::ipc_stiffness},
    {"ipc_adaptation", "1", "IPC: by what the stiffness adapts", 0, 1, &Settings::ipc_adaptation, adaptation_names},
    {"ipc_stopping", "1", "IPC: which rule ends a step", 0, 1, &Settings::ipc_stopping, stopping_names},
    {"ipc_ccd", "1", "IPC: which pairs bound a step", 0, 1, &Settings::ipc_ccd, ccd_names},
    {"ipc_tolerance", "1/s", "IPC, displacement: in diagonals of the rest box a second; 0: all iterations are done", 0, 0x1p10, &Settings::ipc_tolerance},
    {"ipc_velocity_tolerance", "m/s", "IPC, velocity: of the last three iterations; 0: all iterations are done", 0, 0x1p10, &Settings::ipc_velocity_tolerance},
    {"ipc_iterations", "1", "IPC: iterations a step at most", 1, most_count, &Settings::ipc_iterations},
    {"seed", "1", "of whatever the scene draws at random", 0, most_seed, &Settings::seed},
}};

const SettingInfo& find_setting(std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const SettingInfo& info) { return info.name == name; });
  if (found != table.end()) return *found;
  std::vector<std::string_view> names;
  for (const SettingInfo& info : table) names.push_back(info.name);
  throw InputError(unknown_name("setting", name, names));
}

template <class Number>
bool parse(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

void set_number(Settings& settings, const SettingInfo& info, std::string_view value) {
  const auto assign = [&]<class T>(T Settings::*field) {
    if constexpr (!std::is_enum_v<T>) {
      T number = settings.*field;
      if (!parse(value, number) || !in_range(info, static_cast<double>(number)))
        throw InputError("setting '" + std::string(info.name) + "' can't be '" + std::string(value) + "'; give " + describe_range(info));
      settings.*field = number;
    }
  };
  std::visit(assign, info.field);
}

void set_choice(Settings& settings, const SettingInfo& info, std::string_view value) {
  const auto found = std::find(info.choices.begin(), info.choices.end(), value);
  if (found == info.choices.end())
    throw InputError("setting '" + std::string(info.name) + "' can't be '" + std::string(value) + "'; give " + describe_range(info));
  std::visit([&]<class T>(T Settings::*field) { settings.*field = static_cast<T>(found - info.choices.begin()); }, info.field);
}

}  // namespace

std::span<const SettingInfo> setting_table() { return table; }

std::span<const std::string_view> activation_names() { return activations; }

std::span<const std::string_view> damping_form_names() { return damping_forms; }

std::string describe_range(const SettingInfo& info) {
  if (!info.choices.empty()) return "one of " + joined(info.choices) + " (" + std::string(info.meaning) + ")";
  const bool whole = std::holds_alternative<std::int64_t Settings::*>(info.field);
  const std::string kind = info.name == "lanes" ? "0 or a power of two" : whole ? "a whole number" : "a number";
  std::string text = kind + " from " + shortest(info.minimum) + " to " + shortest(info.maximum);
  if (info.unit != "1") text.append(" ").append(info.unit);
  return text.append(" (").append(info.meaning).append(")");
}

bool in_range(const SettingInfo& info, double value) {
  if (!(value >= info.minimum && value <= info.maximum)) return false;
  if (info.name != "lanes") return true;
  const auto lanes = static_cast<std::int64_t>(value);
  return (lanes & (lanes - 1)) == 0;
}

void set_setting(Settings& settings, std::string_view name, std::string_view value) {
  const SettingInfo& info = find_setting(name);
  if (info.choices.empty()) set_number(settings, info, value);
  else set_choice(settings, info, value);
}

std::string setting_text(const Settings& settings, const SettingInfo& info) {
  const double value = get_setting(settings, info);
  if (!info.choices.empty() && in_range(info, value)) return std::string(info.choices[static_cast<std::size_t>(value)]);
  return shortest(as_typed(value));
}

double get_setting(const Settings& settings, const SettingInfo& info) {
  return std::visit([&](auto field) { return static_cast<double>(settings.*field); }, info.field);
}

double get_setting(const Settings& settings, std::string_view name) { return get_setting(settings, find_setting(name)); }

}  // namespace ogc::compare
