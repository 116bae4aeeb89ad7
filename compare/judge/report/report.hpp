// Prints reports: one JSON object for each stage, and a table for readers (as a page: compare/judge/report/page.hpp).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

/// Returns the report of one stage:
/// - counts, grey zone, cases near a decision boundary,
/// - for each metric: median, 99.9th percentile and maximum of the errors, tolerance over maximum, whether the
///   tolerance is loose, problem string of the largest error,
/// - speed, the listed mismatches, and the counts of each generator.
nlohmann::ordered_json report_json(const StageReport& report);

/// One row of report_table, for one metric:
/// - stage, cases, mismatches,
/// - share of grey decisions, number of grey decisions with another answer than the exact one,
/// - share of cases near a decision boundary,
/// - error and its unit; median, 99.9 % quantile, maximum and tolerance in this unit; maximum over tolerance,
/// - cases per second.
/// Only the first row of a stage has the columns of the stage.
using ReportRow = std::array<std::string, 13>;
ReportRow report_columns();                                     ///< headings of the columns
std::vector<ReportRow> report_rows(const StageReport& report);  ///< one row for each metric, at least one

/// Returns "passed", "skipped", or what went wrong.
std::string verdict(const StageReport& report);

/// Returns one line for all stages: cases, mismatches, the share of cases near a decision boundary.
std::string report_total(std::span<const StageReport> reports);

/// Returns all rows, the line of report_total, then verdict, loose tolerances and worst cases of each stage.
std::string report_table(std::span<const StageReport> reports);

/// Returns the listed mismatches with problem string and message, at most `limit` for each generator, then the number
/// of all others.
std::string report_mismatches(const StageReport& report, std::size_t limit);

}  // namespace ogc::compare
