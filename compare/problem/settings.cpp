// Bounds are numbers that single precision holds exactly, so that rounding a setting can't take it out of its range.
#include "compare/problem/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double most_count = 1 << 30, most_seed = 0x1p53;
constexpr double least_length = 0x1p-20, most_length = 0x1p20;

constexpr std::array<SettingInfo, 13> table{{
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

}  // namespace

std::span<const SettingInfo> setting_table() { return table; }

std::string describe_range(const SettingInfo& info) {
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
  const auto assign = [&](auto field) {
    auto number = settings.*field;
    if (!parse(value, number) || !in_range(info, static_cast<double>(number))) {
      throw InputError("setting '" + std::string(name) + "' can't be '" + std::string(value) + "'; give " + describe_range(info));
    }
    settings.*field = number;
  };
  std::visit(assign, info.field);
}

double get_setting(const Settings& settings, const SettingInfo& info) {
  return std::visit([&](auto field) { return static_cast<double>(settings.*field); }, info.field);
}

double get_setting(const Settings& settings, std::string_view name) { return get_setting(settings, find_setting(name)); }

}  // namespace ogc::compare
