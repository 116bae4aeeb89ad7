// Writes iterations.csv: one row for each iteration of the solvers that keep rows of iterations. Columns are named as
// in steps.csv: "name [unit]".
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// Returns the header line.
std::string iteration_header();

/// Returns the iteration rows of all steps; numbers read back as the same double, "nan" if a quantity was not
/// requested. Empty if there are none.
std::string iteration_lines(std::span<const StepMetrics> steps);

}  // namespace ogc::compare
