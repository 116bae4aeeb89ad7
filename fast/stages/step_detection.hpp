// The launches of a detection within a step (PlainLaunches in fast/stages/detection.hpp is a detection's alone).
#pragma once

#include <algorithm>

#include "fast/kernels/step_detection.hpp"
#include "fast/stages/beside.hpp"

namespace ogc::fast {

/// First launch of a detection, with the step's own work in it.
struct StepStart {
  BeginRegions regions;  ///< the certificate and X_prev

  /// As PlainLaunches::prepare.
  template <class Backend>
  void prepare(Backend& backend, int items, const PrepareDetection& prepare, int vertices,
               const MeasureDrift& drift) const {
    for_each_beside(backend, items, PrepareStepDetection{regions, prepare}, vertices, drift);
  }
  /// As PlainLaunches::prepare_and_refit.
  template <class Backend>
  void prepare_and_refit(Backend& backend, int items, const PrepareDetection& prepare, const RefitTrees& refit) const {
    backend.for_each(RefitTrees::filled_up(std::max(items, refit.count())),
                     PrepareStepAndRefit{{regions, prepare}, refit});
  }
};

/// A detection of a step: its first launch and its last, which lists contacts for the sweep.
struct StepLaunches : StepStart {
  EndDetection end;
  CopyContactRows<LooseIncidence> rows;  ///< of the contact stream
  int slots;                             ///< free vertices
  ResolveContact resolve;                ///< the stream's contacts

  /// As PlainLaunches::rank.
  template <class Backend>
  void rank(Backend& backend, const ListsView& lists, const int* count, int capacity) const {
    backend.for_both(std::max(1, slots), EndStepDetection{end, rows, slots, lists}, count, capacity,
                     RankAndResolve{{lists}, resolve});
  }
};

}  // namespace ogc::fast
