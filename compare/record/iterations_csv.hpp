// iterations.csv: one row an iteration, of runs whose solver keeps them. Columns as in steps.csv: "name [unit]".
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// The header line.
std::string iteration_header();

/// The iteration rows of all steps; numbers read back as the same double, "nan" where a quantity was not asked for.
/// Empty where there are none.
std::string iteration_lines(std::span<const StepMetrics> steps);

}  // namespace ogc::compare
