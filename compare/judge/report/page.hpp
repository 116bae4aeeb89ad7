// Prints a report as one static HTML page that loads no other files.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

/// Returns the page: the table of report_table, a histogram of each metric, the counts of each generator, the listed
/// mismatches and the worst cases. `heading` names the judged contestant.
std::string report_page(std::span<const StageReport> reports, const std::string& heading);

}  // namespace ogc::compare
