// Checks that MetricInfo::loose_because gives a reason for exactly those tolerances that the errors in reports show to
// be loose.
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/judge/engine/judge.hpp"

namespace ogc::tests {

using namespace compare;

namespace loose {

struct Seen {
  const MetricInfo* info = nullptr;
  double largest = 0;
  bool any = false;
};

inline std::map<std::pair<Stage, std::string_view>, Seen> seen_in(std::span<const StageReport> reports) {
  std::map<std::pair<Stage, std::string_view>, Seen> all;
  for (const StageReport& report : reports) {
    const std::span<const MetricInfo> infos = metrics(report.tally.stage);
    for (std::size_t i = 0; i < infos.size(); ++i) {
      Seen& seen = all[{report.tally.stage, infos[i].name}];
      seen.info = &infos[i];
      seen.any = seen.any || report.tally.metrics[i].errors.count() > 0;
      seen.largest = std::max(seen.largest, report.tally.metrics[i].errors.maximum());
    }
  }
  return all;
}

inline std::string numbers(const Seen& seen) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "largest error %.3g, accepted %g", seen.largest, seen.info->tolerance);
  return buffer;
}

}  // namespace loose

/// Returns one message for each tolerance that is loose without a reason in MetricInfo::loose_because, or that has a
/// reason and is not loose. A tolerance is loose if it exceeds loose_factor times the largest error in all reports of
/// its stage.
///
/// A longer run with the same seed repeats these cases, so a tolerance that is not loose here is not loose there. The
/// reverse may fail. So reports must include the cases of longer runs with the largest errors
/// (tests/experiments/nearest.txt).
inline std::vector<std::string> loose_problems(std::span<const StageReport> reports) {
  std::vector<std::string> problems;
  for (const auto& [name, seen] : loose::seen_in(reports)) {
    if (!seen.any) continue;
    const bool loose = seen.largest * loose_factor < seen.info->tolerance, listed = !seen.info->loose_because.empty();
    const std::string which = std::string(stage_name(name.first)) + " " + std::string(name.second) + ": ";
    if (loose && !listed)
      problems.push_back(which + "loose, and not listed with a reason in MetricInfo::loose_because; " +
                         loose::numbers(seen));
    if (listed && !loose)
      problems.push_back(which + "listed in MetricInfo::loose_because, and not loose; " + loose::numbers(seen));
  }
  return problems;
}

}  // namespace ogc::tests
