// Combines the launches of a detection with other work of the step that is due at the same time. On a device a separate
// launch would cost more than this work. The two parts of a launch are independent of each other.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"

namespace ogc::fast {

/// Does the first launch of a detection: checks each vertex's old region, sets X_prev ← x, and prepares the detection.
/// Runs once for each index below count().
struct BeginStepDetection {
  BeginRegions regions;
  BeginDetection detection;

  OGC_HD int count() const { return detection.count(); }
  OGC_HD void operator()(int i) const {
    if (i < detection.distances.vertex_count) regions(i);
    detection(i);
  }
};

/// Does the first part of a detection's last launch: counts the detection, and writes each slot's row of the contact
/// stream. Runs once for each slot, and at least once.
struct EndStepDetection {
  EndDetection end;
  CopyContactRows rows;
  int slots;  ///< free vertices

  OGC_HD void operator()(int i) const {
    if (i == 0) end(i);
    if (i < slots) rows(i);
  }
};

/// Does the second part of a detection's last launch: sorts the incidences, and writes the contact of each incidence
/// into the stream. Runs once for each incidence.
struct RankAndResolve {
  /// 5 blocks limit a thread to 96 registers. Most of the time threads wait for scattered loads, which more warps hide.
  static constexpr int resident_blocks = 5;
  RankIncidences rank;
  ResolveContact resolve;

  OGC_HD LooseIncidence load(int i) const { return rank.lists.loose[i]; }
  OGC_HD void operator()(int i) const { (*this)(i, load(i)); }
  OGC_HD void operator()(int, const LooseIncidence& own) const {
    if (*rank.lists.overflow != 0) return;
    const Incidence incidence{own.code};
    // loaded before the row is read, so that latencies overlap
    const ResolveContact::Record record = resolve.record(incidence);
    resolve(rank.put(own), incidence, record);
  }
};

}  // namespace ogc::fast
