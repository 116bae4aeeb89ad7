// Writes the report of an IPC step: its notes, the rows of its iterations, and the row of the step. The report changes
// no iteration.
#include <algorithm>
#include <limits>

#include "reference/ipc/solver.hpp"
#include "reference/solvers/measure.hpp"

namespace ogc::reference {

/// Adds a text to the notes, at most once in each step.
void IpcSolver::note(const std::string& what) {
  const std::string text = "step " + std::to_string(metrics_.step) + ": " + what;
  if (std::find(metrics_.notes.begin(), metrics_.notes.end(), text) == metrics_.notes.end())
    metrics_.notes.push_back(text);
}

/// Adds a row with counts since the beginning of the step; `count_by_iteration` converts them to counts of the
/// iteration.
void IpcSolver::add_row() {
  compare::IterationMetrics row;
  row.step = metrics_.step;
  row.iteration = metrics_.iterations;
  row.wall_ms = elapsed_ms();
  row.residual = metrics_.residual;
  const IpcEnergy energy = forces_.energy(x_, set_, stiffness_);
  row.energy = Potential::total(energy.elastic) + energy.barrier + energy.rest;
  row.detected = 1;
  row.condition_number = std::numeric_limits<double>::quiet_NaN();
  row.condition_without_friction = row.condition_without_contact = row.condition_number;
  row.broad_phases = metrics_.broad_phases;
  row.discrete_detections = metrics_.discrete_detections;
  row.continuous_detections = metrics_.continuous_detections;
  rows_.push_back(row);
}

void IpcSolver::count_by_iteration() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto spent = [&](std::int64_t compare::IterationMetrics::*row, std::int64_t compare::StepMetrics::*whole) {
      rows_[i].*row = (i + 1 < rows_.size() ? rows_[i + 1].*row : metrics_.*whole) - rows_[i].*row;
    };
    spent(&compare::IterationMetrics::broad_phases, &compare::StepMetrics::broad_phases);
    spent(&compare::IterationMetrics::discrete_detections, &compare::StepMetrics::discrete_detections);
    spent(&compare::IterationMetrics::continuous_detections, &compare::StepMetrics::continuous_detections);
  }
}

IpcStep IpcSolver::finish(Outcome outcome) {
  IpcStep step;
  step.position = x_;
  step.velocity = x_;
  for (std::size_t v = 0; v < x_.size(); ++v) step.velocity[v] = (1 / settings_.time_step) * (x_[v] - start_[v]);
  const bool by_displacement = ipc_.stopping == IpcStopping::displacement;
  if (outcome == Outcome::limit && (by_displacement ? ipc_.tolerance : ipc_.velocity_tolerance) > 0)
    note("ended at the limit of " + std::to_string(ipc_.iterations) +
         " iterations, above its tolerance; the run goes on, as the published codes do");
  metrics_.status = outcome == Outcome::not_finite   ? compare::step_not_finite
                    : outcome == Outcome::indefinite ? compare::step_indefinite
                    : outcome == Outcome::stuck      ? compare::step_not_converged
                                                     : compare::step_clean;
  const auto is_edges = [](const PrimitivePair& pair) { return pair.sides == compare::ContactSides::edge_edge; };
  metrics_.edge_edge_contacts = std::count_if(set_.active.begin(), set_.active.end(), is_edges);
  metrics_.vertex_facet_contacts = static_cast<std::int64_t>(set_.active.size()) - metrics_.edge_edge_contacts;
  metrics_.query_radius = shape_.reach();
  metrics_.smallest_distance = set_.smallest;
  metrics_.wall_ms = elapsed_ms();
  if (options_.profile) metrics_.stage_ms.assign(stage_ms_.begin(), stage_ms_.end());
  const Potential& potential = forces_.potential();
  metrics_.momentum_lost_end = momentum_lost({x_, start_, target_}, potential);
  metrics_.largest_lag = largest_lag(x_, target_, potential.mobility());
  measure_energies(metrics_, {x_, start_, target_}, potential, scene_, options_.energies);
  if (options_.energies) metrics_.contact_energy = forces_.energy(x_, set_, stiffness_).barrier;
  count_by_iteration();
  metrics_.iteration_rows = std::move(rows_);
  step.metrics = std::move(metrics_);
  return step;
}

}  // namespace ogc::reference
