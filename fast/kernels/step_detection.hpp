// Runs the launches of a detection within a step, each together with work of the step that is due there: a launch of
// its own would cost a device more than the work. Nothing here reads what its neighbour in the same launch writes.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"

namespace ogc::fast {

/// First launch: certifies the regions that end, sets X_prev ← x, and begins the detection. Index as in BeginDetection.
struct BeginStepDetection {
  BeginRegions regions;
  BeginDetection detection;

  OGC_HD int count() const { return detection.count(); }
  OGC_HD void operator()(int i) const {
    if (i < detection.distances.vertex_count) regions(i);
    detection(i);
  }
};

/// Beside the last launch: counts the detection, and gives each slot its row of the contact stream. Index over slots,
/// at least one.
struct EndStepDetection {
  EndDetection end;
  CopyContactRows<LooseIncidence> rows;
  int slots;  ///< free vertices

  OGC_HD void operator()(int i) const {
    if (i == 0) end(i);
    if (i < slots) rows(i);
  }
};

/// Last launch: writes each incidence at its place, and its contact into the stream of the sweep. Index over all
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
