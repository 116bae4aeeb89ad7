// Measures Eq. 29 during the run (method.md §6): sums the force on each free vertex after the guess loop and at the end
// of a step, with the step's own contact sets.
#pragma once

#include "fast/kernels/sums/step_sums.hpp"
#include "fast/stages/reduce.hpp"
#include "fast/stages/sweep.hpp"

namespace ogc::fast {

/// Measures the forces on the free vertices after the guess loop and at the end of a step.
template <class Backend>
class LeftForces {
 public:
  /// Takes the number of vertices of the mesh, and of its free vertices (`slots`).
  LeftForces(Backend& backend, int vertices, int slots) : reduction_(backend, vertices), slots_(slots) {
    left_.resize(static_cast<std::size_t>(slots));
    totals_.resize(left_columns);
  }
  /// Measures the forces after the guess loop. `view`: data of the first iteration (Step::view).
  void begin(const Sweep<Backend>& sweep, SweepView view) { measure(sweep, view, false); }
  /// Measures the forces at the end of the step. `view`: data of the iteration that would follow the last one; if it is
  /// off, nothing is measured.
  void end(const Sweep<Backend>& sweep, SweepView view) { measure(sweep, view, true); }
  /// Adds up the forces of both measurements.
  void add() {
    reduction_.template add<0, left_columns>(LeftSums{left_.data(), slots_}, 0, Nothing{});
    reduction_.total(totals_.data(), 0, Nothing{}, 0, Nothing{});
  }
  /// Returns the forces by slot, on the backend.
  LeftForce* left() { return left_.data(); }
  /// Returns the totals of the last step by LeftColumn, on the backend.
  const double* totals() const { return totals_.data(); }

 private:
  void measure(const Sweep<Backend>& sweep, SweepView view, bool is_end) {
    view.to_fresh = 0;
    sweep.measure(view, left_.data(), is_end);
  }

  Reduction<Backend, left_columns> reduction_;
  int slots_;
  typename Backend::template Buffer<LeftForce> left_;
  typename Backend::template Buffer<double> totals_;
};

}  // namespace ogc::fast
