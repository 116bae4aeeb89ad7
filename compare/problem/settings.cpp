// The limits of ranges are exact in single precision, so that rounding a setting can't move it out of its range.
#include "compare/problem/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>
#include <utility>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double most_count = 1 << 30, most_seed = 0x1p53;
constexpr double least_length = 0x1p-20, most_length = 0x1p20;

/// Largest index of a choice's enumerators.
template <class Choice>
constexpr double last = choice_count<Choice> - 1;

constexpr auto problem_table = std::to_array<SettingInfo>({
    {"time_step", "s", "a step covers this simulated time, h; smaller steps are more accurate and cost more in total",
     0x1p-20, 1, &Settings::time_step},
    {"steps", "1", "a run has this many steps", 0, most_count, &Settings::steps},
    {"iterations", "1",
     "vbd, reference_vbd: a step sweeps over all vertices this often; more sweeps bring materials nearer to their "
     "stiffness",
     1, most_count, &Settings::iterations},
    {"contact_radius", "m", "two surfaces push each other apart below this distance, r", least_length, most_length,
     &Settings::contact_radius},
    {"detection_radius_cap", "r",
     "detection looks for neighbours at most so many contact radii away; it is the cap of r_q", 1, 1024,
     &Settings::detection_radius_cap},
    {"bounds", "1",
     "between two detections a vertex stays in a ball, as in the paper (ball), on its side of planes between near "
     "pairs (planes), or on its side of the planes of Divide and Truncate (dat; vbd, reference_vbd); off: nothing "
     "holds it",
     0, last<Bounds>, &Settings::bounds, choice_names<Bounds>},
    {"bounds_relaxation", "1",
     "a vertex may move by this share of its distance to the nearest neighbour before the next detection, γ_p of Eq. "
     "21",
     0x1p-10, 0.5 - 0x1p-10, &Settings::bounds_relaxation},
    {"contact_margin", "r", "contacts are listed so much beyond the contact radius, before they act", 0, 1,
     &Settings::contact_margin},
    {"detection_fraction", "1",
     "a step detects contacts again once bounds have stopped this share of the vertices, γ_e", 0, 1,
     &Settings::detection_fraction},
    {"detection_every", "1",
     "a step detects contacts again after so many iterations at the latest; 0: their number asks for nothing", 0,
     most_count, &Settings::detection_every},
    {"detection_gap", "1",
     "vbd, reference_vbd: at least so many iterations lie between two detections of a step, however many vertices "
     "bounds "
     "stop; detection_every goes first",
     1, most_count, &Settings::detection_gap},
    {"detection_deep", "1",
     "vbd, reference_vbd: 1: while a vertex lies deep inside a volume, any cut vertex causes a detection; 0: only as "
     "many as detection_fraction says do",
     0, 1, &Settings::detection_deep},
    {"settled_move", "m",
     "vbd, reference_vbd: a step ends after an iteration that cut no vertex and moved none farther than this along any "
     "axis, unless a detection is due; 0: a step has all its iterations",
     0, most_length, &Settings::settled_move},
    {"guess_rounds", "1",
     "a step moves vertices to where inertia takes them in at most so many rounds, each with a detection; 1 is Eq. 28 "
     "as printed",
     1, 1 << 20, &Settings::guess_rounds},
    {"friction_velocity", "m/s", "friction acts in full from this speed of sliding on, ε_v", 0x1p-30, 0x1p10,
     &Settings::friction_velocity},
    {"frame_steps", "1", "a run stores a frame (a state) every so many steps; 0: 60 frames a simulated second", 0,
     most_count, &Settings::frame_steps},
    {"lanes", "1",
     "vbd: forces on a vertex are added up in so many partial sums, W, on which bits depend; 0: the size of the mesh "
     "decides",
     0, 16, &Settings::lanes},
    {"contact_activation", "1",
     "repulsion grows by this law as surfaces approach: the paper's (ogc), the same with Eq. 19 as it is printed, or "
     "another one to compare with",
     0, last<ContactActivation>, &Settings::contact_activation, choice_names<ContactActivation>},
    {"damping", "1",
     "damping resists the change of strains (strain), or the motion of each vertex (per_vertex; vbd, reference_vbd)", 0,
     last<DampingForm>, &Settings::damping, choice_names<DampingForm>},
    {"seed", "1", "a scene draws its start by this seed, which run.json records", 0, most_seed, &Settings::seed},
    {"rod_orientation", "1",
     "vbd, reference_vbd: a sweep sets the orientation of a rod's segment to the least energy (exact), or as Stable "
     "Cosserat Rods does (as_published)",
     0, last<RodOrientation>, &Settings::rod_orientation, choice_names<RodOrientation>},
    {"rod_start", "1",
     "a step begins with orientations of rods' segments that have turned with the segments (turned), or that the step "
     "before left (kept)",
     0, last<RodStart>, &Settings::rod_start, choice_names<RodStart>},
});

/// Former names of settings, each with the present name.
constexpr auto renamed = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"activation", "contact_activation"},
    {"bound_relaxation", "bounds_relaxation"},
    {"colours", "reference_vbd_colours"},
    {"contact", "body_contact"},
    {"contact_blocks", "reference_vbd_contact_blocks"},
    {"contact_set", "reference_contact_set"},
    {"cut_after", "reference_vbd_cut_after"},
    {"friction_solves", "newton_friction_solves"},
    {"orientation", "rod_orientation"},
    {"projection", "newton_projection"},
    {"query_radius_cap", "detection_radius_cap"},
    {"redetect_every", "detection_every"},
    {"redetect_fraction", "detection_fraction"},
    {"start_frames", "rod_start"},
    {"truncation", "newton_truncation"},
});

/// Holds the problem's settings and those that contestants have declared.
struct Table {
  std::map<std::string_view, std::span<const SettingInfo>> declared;  ///< by contestant
  std::vector<SettingInfo> rows;

  Table() { join(); }
  void join() {
    rows.assign(problem_table.begin(), problem_table.end());
    for (const auto& [contestant, own] : declared) rows.insert(rows.end(), own.begin(), own.end());
  }
};

/// Makes the table at its first use, because declarations in other files may be constructed before the objects of this
/// file.
Table& known() {
  static Table table;
  return table;
}

const SettingInfo& find_setting(std::string_view name) {
  const std::span<const SettingInfo> table = setting_table();
  const auto found = std::ranges::find(table, name, &SettingInfo::name);
  if (found != table.end()) return *found;
  std::vector<std::string_view> names;
  for (const SettingInfo& info : table) names.push_back(info.name);
  throw InputError(unknown_setting(name, names));
}

template <class Number>
bool parse(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

[[noreturn]] void refuse(const SettingInfo& info, std::string_view value) {
  throw InputError("setting '" + std::string(info.name) + "' can't be '" + shown(value) + "'; give " +
                   describe_range(info));
}

double number_of(const SettingInfo& info, std::string_view text) {
  double number = 0;
  std::int64_t whole = 0;
  const bool parsed = kind_of(info) == SettingKind::whole ? parse(text, whole) : parse(text, number);
  if (kind_of(info) == SettingKind::whole) number = static_cast<double>(whole);
  if (!parsed || !in_range(info, number)) refuse(info, text);
  return number;
}

double place_of(const SettingInfo& info, std::string_view name) {
  const auto found = std::find(info.choices.begin(), info.choices.end(), name);
  if (found == info.choices.end()) refuse(info, name);
  return static_cast<double>(found - info.choices.begin());
}

}  // namespace

std::span<const SettingInfo> setting_table() { return known().rows; }

SettingsDeclaration::SettingsDeclaration(std::string_view contestant, std::span<const SettingInfo> rows) {
  known().declared[contestant] = rows;
  known().join();
}

std::string_view renamed_setting(std::string_view old) {
  const auto found = std::ranges::find(renamed, old, [](const auto& names) { return names.first; });
  return found == renamed.end() ? std::string_view{} : found->second;
}

std::string unknown_setting(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view now = renamed_setting(name);
  if (now.empty()) return unknown_name("setting", name, known);
  return "unknown setting '" + std::string(name) + "': it is called " + std::string(now);
}

SettingKind kind_of(const SettingInfo& info) {
  if (!info.choices.empty()) return SettingKind::choice;
  if (const auto* declared = std::get_if<DeclaredSetting>(&info.field)) return declared->kind;
  return std::holds_alternative<double Settings::*>(info.field) ? SettingKind::real : SettingKind::whole;
}

std::string describe_range(const SettingInfo& info) {
  const bool whole = kind_of(info) == SettingKind::whole;
  const std::string kind = !info.choices.empty()  ? "one of "
                           : info.name == "lanes" ? ""
                           : whole                ? "a whole number from "
                                                  : "a number from ";
  return kind + range_text(info) + (info.unit == "1" ? "" : " " + std::string(info.unit)) + " (" +
         std::string(info.meaning) + ")";
}

bool in_range(const SettingInfo& info, double value) {
  if (!(value >= info.minimum && value <= info.maximum)) return false;
  if (kind_of(info) == SettingKind::real) return !vanishes_in_single(value);
  if (info.name != "lanes") return true;
  const auto lanes = static_cast<std::int64_t>(value);
  return lanes != 1 && (lanes & (lanes - 1)) == 0;
}

void set_setting(Settings& settings, std::string_view name, std::string_view value) {
  const SettingInfo& info = find_setting(name);
  set_setting(settings, info, info.choices.empty() ? number_of(info, value) : place_of(info, value));
}

void set_setting(Settings& settings, std::string_view name, double value) {
  set_setting(settings, find_setting(name), value);
}

void set_setting(Settings& settings, const SettingInfo& info, double value) {
  if (const auto* row = std::get_if<DeclaredSetting>(&info.field)) {
    settings.declared.erase(std::string(info.name));
    if (value != row->standard) settings.declared.emplace(info.name, value);
    return;
  }
  std::visit(
      [&]<class Field>(Field field) {
        if constexpr (!std::is_same_v<Field, DeclaredSetting>)
          settings.*field = static_cast<std::remove_reference_t<decltype(settings.*field)>>(value);
      },
      info.field);
}

std::string setting_text(const Settings& settings, const SettingInfo& info) {
  const double value = get_setting(settings, info);
  if (!info.choices.empty() && in_range(info, value)) return std::string(info.choices[static_cast<std::size_t>(value)]);
  return shortest(as_typed(value));
}

double get_setting(const Settings& settings, const SettingInfo& info) {
  return std::visit(
      [&]<class Field>(Field field) {
        if constexpr (std::is_same_v<Field, DeclaredSetting>) {
          const auto found = settings.declared.find(info.name);
          return found == settings.declared.end() ? field.standard : found->second;
        } else {
          return static_cast<double>(settings.*field);
        }
      },
      info.field);
}

double get_setting(const Settings& settings, std::string_view name) {
  return get_setting(settings, find_setting(name));
}

}  // namespace ogc::compare
