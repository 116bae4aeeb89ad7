// Prints reports: one JSON object a stage, and a table for people (as a page: compare/judge/report/page.hpp).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

/// Returns one stage: counts, grey zone, cases near a boundary, errors by metric (median, 99.9th percentile, maximum,
/// room below the tolerance, whether that is loose, worst problem string), speed, the listed mismatches, each
/// generator's counts.
nlohmann::ordered_json report_json(const StageReport& report);

/// One row of report_table, of which each metric has one: stage, cases, mismatches, grey share, grey decisions answered
/// otherwise than exactly, share near a boundary, error and its unit, median, 99.9 %, maximum and tolerance in that
/// unit, their ratio, cases per second. What belongs to a stage stands in its first row.
using ReportRow = std::array<std::string, 13>;
ReportRow report_columns();                                     ///< headings of the columns
std::vector<ReportRow> report_rows(const StageReport& report);  ///< one row a metric, at least one

/// Returns "passed", "skipped", or what went wrong.
std::string verdict(const StageReport& report);

/// Returns one line over all stages: cases, mismatches, the share of all cases near a boundary.
std::string report_total(std::span<const StageReport> reports);

/// Returns all rows, the line of report_total, then verdict, loose tolerances and worst cases of each stage.
std::string report_table(std::span<const StageReport> reports);

/// Returns the listed mismatches, problem string and message, at most `limit` a generator, then the count of all
/// others.
std::string report_mismatches(const StageReport& report, std::size_t limit);

}  // namespace ogc::compare
