// What the judge sees of a step: the resident simulation's own, event by event. Only parts that took place become
// events; the control's counters tell.
#pragma once

#include <utility>
#include <vector>

#include "compare/stages/step.hpp"
#include "fast/stages/download.hpp"
#include "fast/stages/step.hpp"

namespace ogc::fast {

template <class Backend>
class StepTrace : public StepObserver {
 public:
  StepTrace(Backend& backend, StepState<Backend>& state, Detection<Backend>& detection,
            const compare::Topology& topology)
      : backend_(backend), state_(state), detection_(detection), topology_(topology) {}

  void begin() override {
    events_.clear();
    seen_ = {};
  }

  void after(compare::StepEventKind part, const Vec* position) override {
    backend_.synchronize();
    StepControl control;
    state_.control.download(&control, 1);
    const bool took_place = part == compare::StepEventKind::detection ? control.detections > seen_.detections
                            : part == compare::StepEventKind::guess   ? control.rounds > seen_.rounds
                                                                      : control.iterations > seen_.iterations;
    seen_ = control;
    if (took_place) events_.push_back(event(part, position, control));
  }

  std::vector<compare::StepEvent> take() { return std::move(events_); }

 private:
  compare::StepEvent event(compare::StepEventKind part, const Vec* position, const StepControl& control) {
    const auto n = static_cast<std::size_t>(state_.vertex_count);
    compare::StepEvent event;
    event.kind = part;
    if (part != compare::StepEventKind::detection) {
      event.position = download_positions(backend_, position, n);
      event.cut = control.cut_last;
      return event;
    }
    const Vec* previous = state_.previous.data();
    event.position = download_positions(backend_, previous, n);
    ContactSets sets = download_contacts(backend_, detection_, topology_);
    event.vertex_facet = {std::move(sets.vertex_facet), std::move(sets.d_min_vertex), std::move(sets.d_min_triangle)};
    event.edge_edge = {std::move(sets.edge_edge), std::move(sets.d_min_edge)};
    event.bound = std::move(sets.bound);
    return event;
  }

  Backend& backend_;
  StepState<Backend>& state_;
  Detection<Backend>& detection_;
  const compare::Topology& topology_;
  StepControl seen_;  ///< at the last look
  std::vector<compare::StepEvent> events_;
};

}  // namespace ogc::fast
