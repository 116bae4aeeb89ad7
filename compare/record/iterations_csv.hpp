// Writes iterations.csv: one row for each iteration of the solvers that report iterations. Columns are named as in
// steps.csv: "name [unit]".
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// Returns the header line.
std::string iteration_header();

/// Returns the iteration rows of all steps; empty if there are none. Numbers read back as the same double; "nan" stands
/// for a quantity that was not requested.
std::string iteration_lines(std::span<const StepMetrics> steps);

}  // namespace ogc::compare
