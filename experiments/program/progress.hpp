// Shows the progress of a long command: a redrawn bar on a terminal, or plain lines every few seconds in a file.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace ogc::experiments {

/// Shows the progress of one command on standard error.
class Progress {
 public:
  /// Counts from `first` to `last` in `unit` (steps, frames).
  Progress(std::int64_t first, std::int64_t last, std::string unit);
  /// Shows `current`, followed by `detail`: "1.2 ms a step, 340 contacts". Shows the constructor's `last` only once,
  /// even if it is reported several times.
  void show(std::int64_t current, const std::string& detail);
  /// Ends the bar, so that the next output starts on a new line. Idempotent.
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
