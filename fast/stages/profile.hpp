// Times by stage, by synchronising around each; without `profile` nothing but the call itself.
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace ogc::fast {

enum class StepStage : int { begin, detection, initial_guess, sweep, metrics };

inline std::vector<std::string> step_stage_names() {
  return {"begin", "detection", "initial_guess", "sweep", "metrics"};
}

template <class Backend>
class StageClock {
 public:
  StageClock(Backend& backend, bool on) : backend_(backend), on_(on) {}
  bool on() const { return on_; }

  template <class Body>
  void time(StepStage stage, Body body) {
    if (!on_) return body();
    backend_.synchronize();
    const auto start = std::chrono::steady_clock::now();
    body();
    backend_.synchronize();
    const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
    milliseconds_[static_cast<std::size_t>(stage)] += passed.count();
  }

  /// Times since the last call [ms], in the order of step_stage_names.
  std::vector<double> take() {
    std::vector<double> result(milliseconds_.begin(), milliseconds_.end());
    milliseconds_.fill(0);
    return result;
  }

 private:
  Backend& backend_;
  bool on_;
  std::array<double, 5> milliseconds_{};
};

}  // namespace ogc::fast
