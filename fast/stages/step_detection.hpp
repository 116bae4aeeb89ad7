// The launches of a detection within a step. PlainLaunches in fast/stages/detection.hpp has those of a detection alone.
#pragma once

#include <algorithm>

#include "fast/kernels/step_detection.hpp"
#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Launches a step's detection: its first launch, and its last launch, which also lists contacts for the sweep.
struct StepLaunches {
  BeginRegions regions;  ///< the certificate, and X_prev ← x
  EndDetection end;
  CopyContactRows<LooseIncidence> rows;  ///< of the contact stream
  int slots;                             ///< free vertices
  ResolveContact resolve;                ///< the stream's contacts

  /// Runs the first launch, with the certificate of the regions that end (see PlainLaunches::begin).
  template <class Backend>
  void begin(Backend& backend, const BeginDetection& detection) const {
    const BeginStepDetection begin{regions, detection};
    backend.for_each(begin.count(), begin);
  }
  /// Runs the last launch, which also makes the stream of contacts (see PlainLaunches::rank).
  template <class Backend>
  void rank(Backend& backend, const ListsView& lists, const int* count, int capacity) const {
    backend.for_both(std::max(1, slots), EndStepDetection{end, rows, slots}, count, capacity,
                     RankAndResolve{{lists}, resolve});
  }
};

}  // namespace ogc::fast
