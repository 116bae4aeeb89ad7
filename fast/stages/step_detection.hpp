// The launches of a detection within a step (PlainLaunches in fast/stages/detection.hpp is a detection's alone).
#pragma once

#include <algorithm>

#include "fast/kernels/step_detection.hpp"

namespace ogc::fast {

/// First and last launch of a detection, with the step's own work in them.
struct StepLaunches {
  BeginRegions regions;    ///< in the first launch: the certificate and X_prev
  EndStepDetection end;    ///< in the last launch: the control, and rows of the contact stream
  ResolveContact resolve;  ///< in the last launch: the stream's contacts

  /// As PlainLaunches::prepare.
  template <class Backend>
  void prepare(Backend& backend, int items, const PrepareDetection& prepare) const {
    backend.for_each(items, PrepareStepDetection{regions, prepare});
  }
  /// As PlainLaunches::prepare_and_refit.
  template <class Backend>
  void prepare_and_refit(Backend& backend, int items, const PrepareDetection& prepare, const RefitTrees& refit) const {
    backend.for_each(RefitTrees::filled_up(std::max(items, refit.count())),
                     PrepareStepAndRefit{{regions, prepare}, refit});
  }
  /// As PlainLaunches::rank.
  template <class Backend>
  void rank(Backend& backend, const ListsView& lists, const int* count, int capacity) const {
    backend.for_both(std::max(1, end.slots), end, count, capacity, RankAndResolve{{lists}, resolve});
  }
};

}  // namespace ogc::fast
