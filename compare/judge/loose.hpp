// Tolerances that no error of ours comes near. Each is either tightened or stands here with its reason: a test holds
// the list to what is seen, both ways.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/judge/judge.hpp"

namespace ogc::compare {

struct LooseTolerance {
  Stage stage = Stage::bound;
  std::string_view metric, reason;
};

std::span<const LooseTolerance> loose_tolerances();

/// Why the metric may be loose; nothing where it is not listed.
std::optional<std::string_view> reason_of_loose(Stage stage, std::string_view metric);

/// What is loose in these reports and not listed, and what is listed and not loose; one message each. Reports of one
/// stage count together. What is seen grows with the cases, as the first ones of a generator are the same in a longer
/// run: what is not loose here is not in any longer run of the seed. What is loose here may be so by lack of cases; the
/// judge of nearer cases, found by longer runs, then belongs among the reports (tests/experiments/nearest.txt).
std::vector<std::string> loose_problems(std::span<const StageReport> reports);

}  // namespace ogc::compare
