#include "compare/laws/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/laws/groups.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// Returns the distance of a reading from its answer; for Side::at_most, its excess over the answer. Not-a-number gives
/// not-a-number.
double excess(const Reading& reading) {
  const double off = reading.measured - reading.answer;
  return reading.side == Side::both ? std::abs(off) : off;
}

double share_of_tolerance(const Reading& reading) {
  const double off = excess(reading);
  if (std::isnan(off)) return std::numeric_limits<double>::infinity();
  return reading.tolerance > 0 ? off / reading.tolerance : (off > 0 ? std::numeric_limits<double>::infinity() : 0);
}

std::vector<Law> all_laws() {
  std::vector<Law> all;
  for (const auto group : {falls, free_bodies, slopes, drags, rests, releases, strips, beams, cords, invariances}) {
    const std::vector<Law> found = group();
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace

Verdict verdict(const Reading& reading) {
  const double off = excess(reading);
  if (off <= reading.tolerance) return Verdict::holds;
  return off <= reading.limit ? Verdict::limit : Verdict::broken;
}

Verdict verdict(std::span<const Reading> readings) {
  Verdict found = Verdict::holds;
  for (const Reading& reading : readings) found = std::max(found, verdict(reading));
  return found;
}

const Reading* worst(std::span<const Reading> readings) {
  const auto found = std::ranges::max_element(
      readings, {}, [](const Reading& reading) { return std::pair(verdict(reading), share_of_tolerance(reading)); });
  return found == readings.end() ? nullptr : &*found;
}

std::span<const Law> laws() {
  static const std::vector<Law> all = all_laws();
  return all;
}

const Law& find_law(std::string_view name) {
  const auto found = std::ranges::find(laws(), name, &Law::name);
  if (found != laws().end()) return *found;
  std::vector<std::string_view> names;
  for (const Law& law : laws()) names.push_back(law.name);
  throw InputError(unknown_name("law", name, names));
}

}  // namespace ogc::compare
