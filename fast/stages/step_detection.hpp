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

/// Last launch of a listing, likewise. `End`: what it does to the control.
template <class End>
struct StepListing {
  End end;
  CopyContactRows<LooseIncidence> rows;  ///< of the contact stream
  int slots;                             ///< free vertices
  ResolveContact resolve;                ///< the stream's contacts

  /// As PlainLaunches::rank.
  template <class Backend>
  void rank(Backend& backend, const ListsView& lists, const int* count, int capacity) const {
    backend.for_both(std::max(1, slots), EndStepDetection<End>{end, rows, slots, lists}, count, capacity,
                     RankAndResolve{{lists}, resolve});
  }
};

/// Both, of a detection that lists its contacts at once.
struct StepLaunches : StepStart, StepListing<EndDetection> {};

/// Of a detection in a round of the guess loop: its first launch, and the last, in which vertices of active contacts
/// are marked in place of lists.
struct RoundLaunches : StepStart {
  StepControl* control;  ///< on the backend
  const Vec* previous;   ///< X_prev by vertex, on the backend [m]
  float radius;          ///< r [m]
  int* touched;          ///< by vertex, on the backend: marks

  /// `bounds` of `bounded` vertices, beside the marks.
  template <class Backend>
  void mark(Backend& backend, const ConservativeBound& bounds, int bounded, const CollectContacts& collect) const {
    const ListsView& lists = collect.lists;
    backend.for_both(std::max(1, bounded), EndRoundDetection{bounds, bounded, {control, lists.overflow}, lists},
                     lists.noted_count, lists.noted_capacity, MarkTouched{collect, previous, radius, control, touched});
  }
};

}  // namespace ogc::fast
