// Launches of a detection within a step. Each launch also does work of the step that is due at the same time, because a
// separate launch would cost a device more than the work. The two parts of a launch are independent of each other.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"

namespace ogc::fast {

/// First launch: checks the certificate of the ending regions, sets X_prev ← x, and begins the detection. Index as in
/// BeginDetection.
struct BeginStepDetection {
  BeginRegions regions;
  BeginDetection detection;

  OGC_HD int count() const { return detection.count(); }
  OGC_HD void operator()(int i) const {
    if (i < detection.distances.vertex_count) regions(i);
    detection(i);
  }
};

/// First part of the last launch: counts the detection, and writes each slot's row of the contact stream. Index over
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

/// Second part of the last launch: sorts the incidences, and writes each one's contact into the stream. Index over all
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
