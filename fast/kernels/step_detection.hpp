// The launches of a detection within a step, each with what the step has to do there: a launch of its own for it would
// cost a device more than the work. Nothing here reads what its neighbour in the same launch writes.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/detection.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/kernels/mark_touched.hpp"

namespace ogc::fast {

/// First launch: the regions that end are certified, X_prev ← x, and the detection is prepared. Index as there.
struct PrepareStepDetection {
  BeginRegions regions;
  PrepareDetection prepare;

  OGC_HD void operator()(int i) const {
    if (i < prepare.distances.vertex_count) regions(i);
    prepare(i);
  }
};

/// The same with the trees' refit, where no skin decides in between whether they are needed; whole warps of 32.
struct PrepareStepAndRefit {
  PrepareStepDetection prepare;
  RefitTrees refit;

  OGC_HD void operator()(int i) const {
    prepare(i);
    refit(i);
  }
};

/// Beside the last launch: `End`'s work on the step's control, and each slot gets its row of the contact stream. What
/// was noted is used up: where a step does not take place, the listing after its guess loop finds nothing to do. Index
/// over slots, at least one.
template <class End>
struct EndStepDetection {
  End end;  ///< EndDetection or EndListing
  CopyContactRows<LooseIncidence> rows;
  int slots;  ///< free vertices
  ListsView lists;

  OGC_HD void operator()(int i) const {
    if (i == 0) {
      end(i);
      if (*lists.overflow == 0) {
        *lists.listed_count = *lists.contact_count;
        *lists.noted_count = *lists.contact_count = 0;
      }
    }
    if (i < slots) rows(i);
  }
};

/// Beside the marks of a round of the guess loop, which has no lists: bounds, and the detection is counted. Where pairs
/// found no room the marks are incomplete, and the step ends. Index over bounded vertices, at least one.
struct EndRoundDetection {
  ConservativeBound bounds;
  int bounded;  ///< vertices of `bounds`; 0 where bounds are planes
  EndDetection end;
  ListsView lists;

  OGC_HD void operator()(int i) const {
    if (i < bounded) bounds(i);
    if (i > 0) return;
    if (*lists.noted_count > lists.noted_capacity) *lists.overflow = 1;
    end(i);
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
