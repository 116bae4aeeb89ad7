// The launches of a detection within a step, each with what the step has to do there: a launch of its own for it would
// cost a device more than the work. Nothing here reads what its neighbour in the same launch writes.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"

namespace ogc::fast {

/// First launch: the regions that end are certified, X_prev ← x, and the detection begins. Index as of BeginDetection.
struct BeginStepDetection {
  BeginRegions regions;
  BeginDetection detection;

  OGC_HD int count() const { return detection.count(); }
  OGC_HD void operator()(int i) const {
    if (i < detection.distances.vertex_count) regions(i);
    detection(i);
  }
};

/// Beside the last launch: the detection is counted, and each slot gets its row of the contact stream. Index over
/// slots, at least one.
struct EndStepDetection {
  EndDetection end;
  CopyContactRows<LooseIncidence> rows;
  int slots;  ///< free vertices

  OGC_HD void operator()(int i) const {
    if (i == 0) end(i);
    if (i < slots) rows(i);
  }
};

/// Last launch: each incidence at its place, and the same contact in the stream of the sweep. Index over all
/// incidences.
struct RankAndResolve {
  RankIncidences rank;
  ResolveContact resolve;

  OGC_HD void operator()(int i) const {
    if (*rank.lists.overflow != 0) return;
    const LooseIncidence own = rank.lists.loose[i];
    resolve(rank.put(own), Incidence{own.code});
  }
};

}  // namespace ogc::fast
