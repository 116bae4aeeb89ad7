// Combines the launches of a detection with work of the step that is due at the same time, because on a device a
// separate launch would cost more than this work. The two parts of a launch are independent of each other.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"

namespace ogc::fast {

/// First launch: checks each vertex's old region, sets X_prev ← x, and begins the detection. Runs once for each index
/// below count().
struct BeginStepDetection {
  BeginRegions regions;
  BeginDetection detection;

  OGC_HD int count() const { return detection.count(); }
  OGC_HD void operator()(int i) const {
    if (i < detection.distances.vertex_count) regions(i);
    detection(i);
  }
};

/// First part of the last launch: counts the detection, and writes each slot's row of the contact stream. Runs once for
/// each slot, and at least once.
struct EndStepDetection {
  EndDetection end;
  CopyContactRows<LooseIncidence> rows;
  int slots;  ///< free vertices

  OGC_HD void operator()(int i) const {
    if (i == 0) end(i);
    if (i < slots) rows(i);
  }
};

/// Second part of the last launch: sorts the incidences, and writes the contact of each into the stream. Runs once for
/// each incidence.
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
