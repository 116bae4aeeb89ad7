#include "compare/problem/ranges.hpp"

#include <cmath>
#include <limits>

#include "compare/problem/rods.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr double least_single = std::numeric_limits<float>::denorm_min();

/// Returns the text of a range. If `is_rounded`, values are rounded to single precision, which has no number between 0
/// and `least_single`.
std::string range(double minimum, double maximum, bool is_rounded) {
  return (is_rounded && minimum == 0 ? "0, or " + shortest(least_single) : shortest(minimum)) + " to " +
         shortest(maximum);
}

}  // namespace

bool vanishes_in_single(double value) { return value != 0 && std::abs(value) < least_single; }

std::string range_text(const SettingInfo& info) {
  if (!info.choices.empty()) return joined(info.choices);
  if (info.name == "lanes") return "0, 2, 4, 8 or 16";
  return range(info.minimum, info.maximum, kind_of(info) == SettingKind::real);
}

namespace {

template <class Info>
bool holds(const Info& info, double value) {
  return value >= info.minimum && value <= info.maximum && !vanishes_in_single(value);
}

template <class Info>
std::string described(const Info& info) {
  const std::string unit = info.unit == "1" ? "" : " " + std::string(info.unit);
  return "a number from " + range(info.minimum, info.maximum, true) + unit + " (" + std::string(info.meaning) + ")";
}

}  // namespace

std::string range_text(const MaterialInfo& info) { return range(info.minimum, info.maximum, true); }

bool in_range(const MaterialInfo& info, double value) { return holds(info, value); }

std::string describe_range(const MaterialInfo& info) { return described(info); }

bool in_range(const RodInfo& info, double value) { return holds(info, value); }

std::string describe_range(const RodInfo& info) { return described(info); }

}  // namespace ogc::compare
