// Measures quantities that a contestant does not compute itself: the residual of Eq. 29, rows of iterations, ledgers,
// and meetings (pairs that touch between states, compare/meetings.md). The measurements run beside the simulation and
// do not count in its times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"

namespace ogc::experiments {

/// Holds a range of steps, counted from 1.
struct StepRange {
  std::int64_t first = 1, last = 0;  ///< empty if last is before first
  bool holds(std::int64_t step) const { return first <= step && step <= last; }
  friend bool operator==(const StepRange&, const StepRange&) = default;
};
/// Parses a range such as "40:139". Throws compare::InputError for other texts.
StepRange step_range(const std::string& text);
std::string text_of(const StepRange& range);

/// Selects what is measured beside a run.
struct Measured {
  bool residual = false;                ///< StepMetrics::residual
  bool iterations = false;              ///< StepMetrics::iteration_rows, and the residual
  bool ledger = false;                  ///< StepMetrics::ledger
  std::int64_t repeats = 0;             ///< repetitions of each step for its times
  std::optional<StepRange> meetings{};  ///< StepMetrics::meetings, for these steps
  /// Returns whether anything is selected.
  bool any() const { return residual || iterations || ledger || meetings || repeats > 0; }
};

/// What is measured at each vertex in the last step of a simulation; an array is empty if it is not measured.
struct VertexMeasures {
  /// with `residual` or `iterations`: the vertex's part of the residual (StepMetrics::residual is the mean over free
  /// vertices); not-a-number for a vertex that is not free [1]
  std::vector<float> residual;
  std::vector<float> cut;  ///< with `ledger`: 1 if the last iteration cut the vertex, else 0
};
/// Returns the measures of the vertices in the last step of a simulation; they are empty unless a contestant of
/// `measured` started it and it did a step.
const VertexMeasures& vertex_measures(const compare::Simulation& simulation);

/// Returns a contestant that also measures what `what` selects.
///
/// The residual uses forces in double precision and contacts detected at the end of the step (method.md §6). Iteration
/// rows and ledgers come from the trace of the contestant's own step (Contestant::step), which its simulation repeats
/// bit by bit. The residual of an iteration row uses the contacts of the last detection. Throws std::logic_error if a
/// trace ends in another state than the step.
///
/// The times of iteration rows are measured: StepMetrics::iteration_ends_ms and detection_ends_ms, which a simulation
/// has with SimulationOptions::profile. Without them they are not-a-number.
///
/// With `repeats` each step is done once to warm up, and then so often again from the same state. Its times are those
/// of the repetition whose time is the median. Throws std::logic_error if a repetition ends in another state.
///
/// Meetings (compare/meetings.md) are counted from each X_prev to the next, and from the last X_prev to the end of the
/// step. These states come from the simulation (compare::WayTeller) or from the trace. If a contestant has neither,
/// meetings are counted from the start of a step to its end. If X_prev is known and the scene's bounds forbid meetings,
/// a meeting sets the row's status to step_met, and the row's notes name pairs.
compare::Contestant measured(compare::Contestant contestant, const Measured& what);

}  // namespace ogc::experiments
