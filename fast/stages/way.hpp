// Records the positions of a step's detections: an observer that copies X_prev of each detection to the host.
#pragma once

#include <utility>
#include <vector>

#include "compare/way.hpp"
#include "fast/stages/step.hpp"

namespace ogc::fast {

/// Records the detections of a simulation's last step. If the step was repeated because a list grew, only the
/// detections of the last attempt remain.
template <class Backend>
class WayRecorder : public StepObserver {
 public:
  WayRecorder(Backend& backend, const StepState<Backend>& state) : backend_(backend), state_(state) {}

  void begin() override {
    states_.clear();
    seen_ = 0;
  }

  void after(compare::StepEventKind kind, const Vec*) override {
    if (kind != compare::StepEventKind::detection) return;
    backend_.synchronize();
    StepControl control;
    state_.control.download(&control, 1);
    if (std::exchange(seen_, control.detections) == control.detections) return;
    std::vector<Vec> previous(static_cast<std::size_t>(state_.vertex_count));
    state_.previous.download(previous.data(), previous.size());
    std::vector<compare::Vec3f>& state = states_.emplace_back();
    state.reserve(previous.size());
    for (const Vec& x : previous) state.push_back({x.x, x.y, x.z});
  }
  void after_finding() override {}
  void after_guess() override {}

  /// Returns X_prev of each detection [m].
  std::vector<std::vector<compare::Vec3f>> take() { return std::move(states_); }

 private:
  Backend& backend_;
  const StepState<Backend>& state_;
  int seen_ = 0;  ///< number of detections that have been recorded
  std::vector<std::vector<compare::Vec3f>> states_;
};

}  // namespace ogc::fast
