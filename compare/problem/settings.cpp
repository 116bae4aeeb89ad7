// Bounds are numbers that single precision holds exactly, so that rounding a setting can't take it out of its range.
#include "compare/problem/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double most_count = 1 << 30, most_seed = 0x1p53;
constexpr double least_length = 0x1p-20, most_length = 0x1p20;

constexpr std::array<std::string_view, 3> projection_names{"none", "clamp", "absolute"};
constexpr std::array<std::string_view, 5> activations{"ogc", "ogc_as_printed", "quadratic", "ipc_log", "cubic"};
constexpr std::array<std::string_view, 2> damping_forms{"strain", "per_vertex"};
constexpr std::array<std::string_view, 3> bounds_names{"ball", "planes", "off"};
constexpr std::array<std::string_view, 2> adaptation_names{"distance", "gap"};
constexpr std::array<std::string_view, 2> stopping_names{"displacement", "velocity"};
constexpr std::array<std::string_view, 2> ccd_names{"partial", "full"};

constexpr std::array<SettingInfo, 32> table{{
    {"time_step", "s", "simulated time that one step covers, h; smaller steps are more accurate and cost more in all",
     0x1p-20, 1, &Settings::time_step},
    {"steps", "1", "number of steps of the run", 0, most_count, &Settings::steps},
    {"iterations", "1", "sweeps over all vertices in a step (vbd); more make materials as stiff as they are given", 1,
     most_count, &Settings::iterations},
    {"contact_radius", "m", "distance below which two surfaces push each other apart, r", least_length, most_length,
     &Settings::contact_radius},
    {"query_radius_cap", "r", "farthest that detection looks for neighbours, in contact radii: the cap of r_q", 1, 1024,
     &Settings::query_radius_cap},
    {"bounds", "1",
     "what keeps a vertex from passing through others between two detections: a ball as in the paper, planes between "
     "near pairs, or nothing",
     0, 2, &Settings::bounds, bounds_names},
    {"bound_relaxation", "1",
     "share of its distance to the nearest neighbour that a vertex may move before the next detection, γ_p of Eq. 21",
     0x1p-10, 0.5 - 0x1p-10, &Settings::bound_relaxation},
    {"contact_margin", "r", "how much farther than the contact radius contacts are listed, before they act", 0, 1,
     &Settings::contact_margin},
    {"redetect_fraction", "1",
     "share of vertices stopped at their bounds from which contacts are detected again within a step, γ_e", 0, 1,
     &Settings::redetect_fraction},
    {"redetect_every", "1", "iterations after which contacts are detected again at the latest; 0: never by count", 0,
     most_count, &Settings::redetect_every},
    {"guess_rounds", "1",
     "rounds of detecting and moving at most that bring vertices to where inertia takes them; 1: as printed in Eq. 28",
     1, 1 << 20, &Settings::guess_rounds},
    {"friction_velocity", "m/s", "speed of sliding from which friction acts in full, ε_v", 0x1p-30, 0x1p10,
     &Settings::friction_velocity},
    {"frame_steps", "1", "steps from one stored frame to the next; 0: 60 frames a simulated second", 0, most_count,
     &Settings::frame_steps},
    {"lanes", "1", "partial sums that forces on a vertex are added up in, W (vbd); bits depend on it; 0: by mesh size",
     0, 32, &Settings::lanes},
    {"newton_iterations", "1", "Newton's iterations in a step at most", 1, most_count, &Settings::newton_iterations},
    {"newton_tolerance", "1",
     "relative force that may remain when a Newton step has converged (Eq. 29); 0: all iterations are done", 0, 1,
     &Settings::newton_tolerance},
    {"newton_step_tolerance", "m/s",
     "a Newton step has also converged where no vertex wants to move faster than this; 0: this does not end it", 0,
     0x1p10, &Settings::newton_step_tolerance},
    {"friction_solves", "1", "Newton's solves in a step, each with the friction that the one before led to", 1, 1 << 20,
     &Settings::friction_solves},
    {"projection", "1",
     "what Newton does with negative curvature of an energy: keep it, cut it off at zero, or take its absolute value",
     0, 2, &Settings::projection, projection_names},
    {"activation", "1",
     "how the repulsion grows as surfaces approach: the paper's, as printed there, or another to compare with", 0, 4,
     &Settings::activation, activations},
    {"damping", "1", "what damping resists: the change of strains, or the motion of each vertex alone (vbd)", 0, 1,
     &Settings::damping, damping_forms},
    {"ipc_distance", "m", "IPC: distance at which the barrier begins to act; 0: by ipc_relative_distance", 0,
     most_length, &Settings::ipc_distance},
    {"ipc_relative_distance", "1", "IPC: the same distance as a share of the diagonal of the scene's box at rest",
     least_length, 1, &Settings::ipc_relative_distance},
    {"ipc_thickness", "m", "IPC: the distance that surfaces keep at least", 0, most_length, &Settings::ipc_thickness},
    {"ipc_stiffness", "J/m⁴", "IPC: stiffness of the barrier, held fixed; 0: it adapts", 0, 0x1p120,
     &Settings::ipc_stiffness},
    {"ipc_adaptation", "1",
     "IPC: whether the stiffness adapts to distances, or to the gaps that a thickness leaves of them", 0, 1,
     &Settings::ipc_adaptation, adaptation_names},
    {"ipc_stopping", "1",
     "IPC: whether the last iteration's displacement ends a step, or the mean velocity of the last three", 0, 1,
     &Settings::ipc_stopping, stopping_names},
    {"ipc_ccd", "1", "IPC: whether the pairs near each other alone limit a move, or all pairs", 0, 1,
     &Settings::ipc_ccd, ccd_names},
    {"ipc_tolerance", "1/s",
     "IPC, displacement: motion at which a step ends, in diagonals of the box a second; 0: all iterations are done", 0,
     0x1p10, &Settings::ipc_tolerance},
    {"ipc_velocity_tolerance", "m/s", "IPC, velocity: mean velocity at which a step ends; 0: all iterations are done",
     0, 0x1p10, &Settings::ipc_velocity_tolerance},
    {"ipc_iterations", "1", "IPC: iterations in a step at most", 1, most_count, &Settings::ipc_iterations},
    {"seed", "1", "which of its random starts a scene takes; recorded with the run", 0, most_seed, &Settings::seed},
}};

const SettingInfo& find_setting(std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const SettingInfo& info) { return info.name == name; });
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

void set_number(Settings& settings, const SettingInfo& info, std::string_view value) {
  const auto assign = [&]<class T>(T Settings::*field) {
    if constexpr (!std::is_enum_v<T>) {
      T number = settings.*field;
      if (!parse(value, number) || !in_range(info, static_cast<double>(number)))
        throw InputError("setting '" + std::string(info.name) + "' can't be '" + shown(value) + "'; give " +
                         describe_range(info));
      settings.*field = number;
    }
  };
  std::visit(assign, info.field);
}

void set_choice(Settings& settings, const SettingInfo& info, std::string_view value) {
  const auto found = std::find(info.choices.begin(), info.choices.end(), value);
  if (found == info.choices.end())
    throw InputError("setting '" + std::string(info.name) + "' can't be '" + shown(value) + "'; give " +
                     describe_range(info));
  std::visit([&]<class T>(T Settings::*field) { settings.*field = static_cast<T>(found - info.choices.begin()); },
             info.field);
}

}  // namespace

std::span<const SettingInfo> setting_table() { return table; }

std::span<const std::string_view> activation_names() { return activations; }

std::span<const std::string_view> damping_form_names() { return damping_forms; }

std::string describe_range(const SettingInfo& info) {
  const bool whole = std::holds_alternative<std::int64_t Settings::*>(info.field);
  const std::string kind = !info.choices.empty()  ? "one of "
                           : info.name == "lanes" ? ""
                           : whole                ? "a whole number from "
                                                  : "a number from ";
  return kind + range_text(info) + (info.unit == "1" ? "" : " " + std::string(info.unit)) + " (" +
         std::string(info.meaning) + ")";
}

bool in_range(const SettingInfo& info, double value) {
  if (!(value >= info.minimum && value <= info.maximum)) return false;
  if (std::holds_alternative<double Settings::*>(info.field)) return !vanishes_in_single(value);
  if (info.name != "lanes") return true;
  const auto lanes = static_cast<std::int64_t>(value);
  return (lanes & (lanes - 1)) == 0;
}

void set_setting(Settings& settings, std::string_view name, std::string_view value) {
  const SettingInfo& info = find_setting(name);
  if (info.choices.empty())
    set_number(settings, info, value);
  else
    set_choice(settings, info, value);
}

std::string setting_text(const Settings& settings, const SettingInfo& info) {
  const double value = get_setting(settings, info);
  if (!info.choices.empty() && in_range(info, value)) return std::string(info.choices[static_cast<std::size_t>(value)]);
  return shortest(as_typed(value));
}

double get_setting(const Settings& settings, const SettingInfo& info) {
  return std::visit([&](auto field) { return static_cast<double>(settings.*field); }, info.field);
}

double get_setting(const Settings& settings, std::string_view name) {
  return get_setting(settings, find_setting(name));
}

}  // namespace ogc::compare
