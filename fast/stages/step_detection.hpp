// Launches a detection within a step. PlainLaunches (fast/stages/detection.hpp) launches a detection outside a step.
#pragma once

#include <algorithm>

#include "fast/kernels/step_detection.hpp"
#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Runs the first and the last launch of a step's detection. The last launch also makes the contact stream of the
/// sweep.
struct StepLaunches {
  BeginRegions regions;  ///< the certificate, and X_prev ← x
  EndDetection end;
  CopyContactRows rows;    ///< makes the rows of the contact stream
  int slots;               ///< free vertices
  ResolveContact resolve;  ///< writes the contacts of the stream

  /// Runs the first launch, which also checks the certificate of the regions that this detection replaces.
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
