// Records the events of a step of the resident simulation for the judge (compare::StepEventKind). Only events that
// StepControl has counted are recorded.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "compare/stages/step.hpp"
#include "fast/probes/download.hpp"
#include "fast/probes/probe_volumes.hpp"
#include "fast/stages/step.hpp"

namespace ogc::fast {

/// Records the steps of one simulation.
template <class Backend>
class StepTrace : public StepObserver {
 public:
  StepTrace(Backend& backend, Step<Backend>& step, StepState<Backend>& state, Detection<Backend>& detection,
            const Volumes<Backend>& volumes, const Rods<Backend>& rods, const compare::Topology& topology)
      : backend_(backend),
        step_(step),
        state_(state),
        detection_(detection),
        volumes_(volumes),
        rods_(rods),
        topology_(topology) {}

  void begin() override {
    events_.clear();
    seen_ = {};
  }

  void after(compare::StepEventKind kind, const Vec* position) override {
    backend_.synchronize();
    StepControl control;
    state_.control.download(&control, 1);
    const int counted = count_of(kind, control);
    if (std::exchange(seen_[static_cast<std::size_t>(kind)], counted) < counted)
      events_.push_back(event(kind, position, control));
  }

  void after_finding() override {
    backend_.synchronize();
    const auto last = std::find_if(events_.rbegin(), events_.rend(), [](const compare::StepEvent& event) {
      return event.kind == compare::StepEventKind::detection;
    });
    if (last != events_.rend()) set_contacts(*last);
  }

  void after_guess() override {
    backend_.synchronize();
    turned_ = rods_.now();
  }

  /// Returns the frames of segments after the guess loop.
  std::vector<compare::Quaternion> take_turned() { return std::move(turned_); }
  /// Returns the events of the last step.
  std::vector<compare::StepEvent> take() { return std::move(events_); }

 private:
  static int count_of(compare::StepEventKind kind, const StepControl& control) {
    switch (kind) {
      case compare::StepEventKind::detection: return control.detections;
      case compare::StepEventKind::guess: return control.rounds;
      case compare::StepEventKind::sweep: return control.iterations;
    }
    __builtin_unreachable();
  }

  compare::StepEvent event(compare::StepEventKind kind, const Vec* position, const StepControl& control) {
    const auto n = static_cast<std::size_t>(state_.vertex_count);
    compare::StepEvent event;
    event.kind = kind;
    if (kind != compare::StepEventKind::detection) {
      event.position = download_positions(backend_, position, n);
      event.cut = control.cut_last;
      if (kind == compare::StepEventKind::sweep) event.orientation = rods_.now();
      return event;
    }
    const Vec* previous = state_.previous.data();
    event.position = download_positions(backend_, previous, n);
    // Before the first iteration, a detection belongs to the guess loop, which does not search in volumes. So the trace
    // searches here.
    if (control.iterations == 0) step_.find_in_volumes(previous);
    set_contacts(event);
    return event;
  }

  void set_contacts(compare::StepEvent& event) {
    ContactSets sets = download_contacts(backend_, detection_, topology_);
    event.vertex_facet = {std::move(sets.vertex_facet), std::move(sets.d_min_vertex), std::move(sets.d_min_triangle)};
    event.edge_edge = {std::move(sets.edge_edge), std::move(sets.d_min_edge)};
    event.bound = std::move(sets.bound);
    event.planes = detection_.download_planes();
    event.volumes = download_volume_contacts(backend_, volumes_, topology_);
  }

  Backend& backend_;
  Step<Backend>& step_;
  StepState<Backend>& state_;
  Detection<Backend>& detection_;
  const Volumes<Backend>& volumes_;
  const Rods<Backend>& rods_;
  const compare::Topology& topology_;
  std::array<int, 3> seen_{};  ///< by kind: number of events that have been recorded
  std::vector<compare::StepEvent> events_;
  std::vector<compare::Quaternion> turned_;
};

}  // namespace ogc::fast
