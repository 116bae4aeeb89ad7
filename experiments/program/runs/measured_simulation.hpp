// Eq. 29 for contestants that do not know their residual: measured by the reference at the states that they come to,
// beside the run and outside its times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Steps first to last, from 1.
struct StepRange {
  std::int64_t first = 1, last = 0;  ///< none where last is before first
  bool holds(std::int64_t step) const { return first <= step && step <= last; }
  friend bool operator==(const StepRange&, const StepRange&) = default;
};
/// "40:139". Throws compare::InputError for another text.
StepRange step_range(const std::string& text);
std::string text_of(const StepRange& range);

/// What is measured beside a run.
struct Measured {
  bool residual = false;                ///< StepMetrics::residual
  bool iterations = false;              ///< StepMetrics::iteration_rows, and the residual
  bool ledger = false;                  ///< StepMetrics::ledger
  std::optional<StepRange> meetings{};  ///< StepMetrics::meetings of these steps
  /// Whether there is anything.
  bool any() const { return residual || iterations || ledger || meetings; }
};

/// The contestant, with what is asked for filled. The residual: forces in double, contacts detected at the end of the
/// step (method.md §6). Rows and ledgers come from the trace of its own step (Contestant::step), which its simulation
/// takes to the same bits; a row's residual has the contacts of the contestant's last detection. Times of rows: the
/// step's time but its detections and iterations, then each of these with an equal share of what all of them took;
/// without SimulationOptions::profile iterations share the whole. A trace that ends in another state than the step
/// throws std::logic_error.
/// Meetings are counted from each X_prev to the next, and from the last to the end of the step, as the simulation tells
/// (compare::WayTeller) or the trace; of a contestant that has neither from the begin of a step to its end. Where the
/// scene's bounds forbid them, and states of detections show them, the row says step_met, and names pairs in its notes.
compare::Contestant measured(compare::Contestant contestant, const Measured& what);

}  // namespace ogc::experiments
