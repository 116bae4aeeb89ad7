// Reports: one JSON object a stage, and a table for people.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/judge.hpp"

namespace ogc::compare {

/// One stage: counts, grey zone, errors by metric (median, 99.9th percentile, maximum, worst problem string), speed, the listed mismatches, each
/// generator's counts.
nlohmann::ordered_json report_json(const StageReport& report);

/// One row a metric: stage, cases, mismatches, grey share, median, 99.9 %, maximum and tolerance in the metric's unit, cases per second, worst case.
std::string report_table(std::span<const StageReport> reports);

/// The listed mismatches, problem string and message, at most `limit` a generator, then the count of all others.
std::string report_mismatches(const StageReport& report, std::size_t limit);

}  // namespace ogc::compare
