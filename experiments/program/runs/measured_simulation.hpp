// Measures Eq. 29 for contestants that do not compute their residual: the reference evaluates it at their states,
// beside the run and outside its times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Holds the steps from first to last, counted from 1.
struct StepRange {
  std::int64_t first = 1, last = 0;  ///< empty if last is before first
  bool holds(std::int64_t step) const { return first <= step && step <= last; }
  friend bool operator==(const StepRange&, const StepRange&) = default;
};
/// Parses "40:139". Throws compare::InputError for another text.
StepRange step_range(const std::string& text);
std::string text_of(const StepRange& range);

/// Selects what is measured beside a run.
struct Measured {
  bool residual = false;                ///< StepMetrics::residual
  bool iterations = false;              ///< StepMetrics::iteration_rows, and the residual
  bool ledger = false;                  ///< StepMetrics::ledger
  std::optional<StepRange> meetings{};  ///< StepMetrics::meetings of these steps
  /// Returns whether anything is selected.
  bool any() const { return residual || iterations || ledger || meetings; }
};

/// Returns a contestant that also fills what `what` selects.
///
/// The residual has forces in double and contacts detected at the end of the step (method.md §6). Rows and ledgers come
/// from the trace of the contestant's own step (Contestant::step), which its simulation repeats bit by bit; the
/// residual of a row has the contacts of the last detection. A trace that ends in another state than the step throws
/// std::logic_error.
///
/// Times of rows: the time of the stages before the first event comes first; each detection and iteration then adds an
/// equal share of the time of its kind. Without SimulationOptions::profile the iterations share the whole time.
///
/// Meetings are counted from each X_prev to the next, and from the last to the end of the step, as told by the
/// simulation (compare::WayTeller) or by the trace; of a contestant that has neither, from the begin of a step to its
/// end. If detections tell the states and the scene's bounds forbid meetings, the row's status is step_met, and its
/// notes name pairs.
compare::Contestant measured(compare::Contestant contestant, const Measured& what);

}  // namespace ogc::experiments
