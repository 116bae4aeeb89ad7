// How far a long command is: a bar that is redrawn where a person watches, plain lines (at most one every few seconds)
// where a file does.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace ogc::experiments {

/// How far one command is, told on standard error.
class Progress {
 public:
  /// From `first` to `last` (steps, frames), counted in `unit`.
  Progress(std::int64_t first, std::int64_t last, std::string unit);
  /// At `current`; `detail` is put behind: "1.2 ms a step, 340 contacts". The end is shown once, however often it is
  /// reported.
  void show(std::int64_t current, const std::string& detail);
  /// Ends the bar, so that what follows starts on a fresh line. Idempotent.
  void end();
  ~Progress() { end(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::string time_left(std::int64_t current) const;
  std::int64_t first_, last_;
  std::string unit_;
  bool terminal_, drawn_ = false, complete_ = false;
  Clock::time_point start_ = Clock::now(), shown_{};
};

}  // namespace ogc::experiments
