// Eq. 29 for contestants that do not know their residual: measured by the reference at the states that they come to,
// beside the run and outside its times.
#pragma once

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// What is measured beside a run.
struct Measured {
  bool residual = false;    ///< StepMetrics::residual
  bool iterations = false;  ///< StepMetrics::iteration_rows, and the residual
  bool ledger = false;      ///< StepMetrics::ledger
  /// Whether there is anything.
  bool any() const { return residual || iterations || ledger; }
};

/// The contestant, with what is asked for filled. The residual: forces in double, contacts detected at the end of the
/// step (method.md §6). Rows and ledgers come from the trace of its own step (Contestant::step), which its simulation
/// takes to the same bits; a row's residual has the contacts of the contestant's last detection. Times of rows: the
/// step's time but its detections and iterations, then each of these with an equal share of what all of them took;
/// without SimulationOptions::profile iterations share the whole. A trace that ends in another state than the step
/// throws std::logic_error.
compare::Contestant measured(compare::Contestant contestant, const Measured& what);

}  // namespace ogc::experiments
