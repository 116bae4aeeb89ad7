#include "experiments/program/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace ogc::experiments {

namespace {

// Updates are frequent enough to show activity and rare enough to cost nothing. The log of a day has fewer than ten
// thousand lines.
constexpr std::chrono::milliseconds redraw_interval{100}, line_interval{10000};
constexpr int bar_width = 24;

std::string bar(double share) {
  const int full = static_cast<int>(share * bar_width);
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(bar_width - full), '.') + "]";
}

}  // namespace

Progress::Progress(std::int64_t first, std::int64_t last, std::string unit)
    : first_(first), last_(last), unit_(std::move(unit)), terminal_(isatty(STDERR_FILENO) != 0) {}

std::string Progress::time_left(std::int64_t current) const {
  if (current <= first_) return "";
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const auto seconds = static_cast<long long>(elapsed * static_cast<double>(last_ - current) /
                                              static_cast<double>(current - first_));
  if (seconds < 60) return ", " + std::to_string(seconds) + " s left";
  if (seconds < 3600) return ", " + std::to_string(seconds / 60) + " min left";
  return ", " + std::to_string(seconds / 3600) + " h " + std::to_string(seconds / 60 % 60) + " min left";
}

void Progress::show(std::int64_t current, const std::string& detail) {
  const Clock::time_point now = Clock::now();
  if (complete_) return;
  complete_ = current == last_;
  if (!complete_ && shown_ != Clock::time_point{} && now - shown_ < (terminal_ ? redraw_interval : line_interval))
    return;
  shown_ = now;
  const std::string text = unit_ + " " + std::to_string(current) + "/" + std::to_string(last_) +
                           (detail.empty() ? "" : ", " + detail) + time_left(current);
  if (!terminal_) {
    std::fputs((text + "\n").c_str(), stderr);
    return;
  }
  const double share = last_ > first_ ? static_cast<double>(current - first_) / static_cast<double>(last_ - first_) : 1;
  std::fputs(("\r" + bar(std::clamp(share, 0., 1.)) + " " + text + "\x1b[K").c_str(), stderr);
  drawn_ = true;
}

void Progress::end() {
  if (drawn_) std::fputs("\n", stderr);
  drawn_ = false;
}

}  // namespace ogc::experiments
