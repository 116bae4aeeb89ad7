// Determines the order of events in Algorithm 3 with the guess loop of method.md §5.2.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/stages/step.hpp"

namespace ogc::reference {

/// Counts the prescribed vertices that are behind their targets, if bounds are planes (method.md §5.6, Detections).
struct StepLag {
  compare::Index lagging = 0;  ///< number of prescribed vertices behind their targets
  bool has_advanced = false;   ///< whether one of them has moved since the last detection
};

/// Depth in units of r from which a vertex is deep inside a volume (compare/volumes.md, The step).
inline constexpr double deep_share = 0.5;

/// Determines the next event of a step from the number of vertices that each event cut. `moving` is K, the number of
/// vertices with a bound.
class StepOrder {
 public:
  StepOrder(const compare::Settings& settings, compare::Index moving)
      : settings_(settings), redetect_vertices_(settings.detection_fraction * moving) {}

  /// Returns the next event; empty after the last iteration, or after one that settled the step.
  std::optional<compare::StepEventKind> next() const {
    if (guessing_) return found_ ? compare::StepEventKind::guess : compare::StepEventKind::detection;
    if (is_over_ || iterations_ == settings_.iterations) return std::nullopt;
    return found_ ? compare::StepEventKind::sweep : compare::StepEventKind::detection;
  }

  /// Records that the event `next()` took place. `cut` is the number of vertices that it cut, lagging ones included;
  /// `is_deep` is whether an iteration left a vertex deep inside a volume; `is_still` is whether an iteration moved no
  /// vertex farther than `settled_move`.
  void took_place(compare::Index cut, const StepLag& lag = {}, bool is_deep = false, bool is_still = false) {
    switch (*next()) {
      case compare::StepEventKind::detection:
        found_ = true;
        since_detection_ = 0;
        break;
      case compare::StepEventKind::guess:
        ++rounds_;
        guessing_ = asks(cut, lag, rounds_) && rounds_ < settings_.guess_rounds;
        found_ = !guessing_;
        break;
      case compare::StepEventKind::sweep:
        ++iterations_;
        ++since_detection_;
        found_ = (since_detection_ < settings_.detection_gap ||
                  (!asks(cut, lag, 1) && !(settings_.detection_deep != 0 && is_deep && cut > lag.lagging))) &&
                 (settings_.detection_every == 0 || since_detection_ < settings_.detection_every);
        is_over_ = settings_.settled_move > 0 && is_still && cut == 0 && found_;
        break;
    }
  }

 private:
  double least_cut(std::int64_t times) const {
    return std::max(1.0, std::ceil(static_cast<double>(times) * redetect_vertices_));
  }

  bool asks(compare::Index cut, const StepLag& lag, std::int64_t times) {
    const bool lag_asks = lag.lagging > 0 && (lag.has_advanced || !lag_asked_);
    lag_asked_ = lag_asked_ || lag_asks;
    return cut - lag.lagging >= least_cut(times) || lag_asks;
  }

  const compare::Settings& settings_;
  double redetect_vertices_;  ///< γ_e K
  bool guessing_ = true;      ///< whether the guess loop runs
  bool lag_asked_ = false;    ///< whether a vertex behind its target has triggered a detection in this step
  bool is_over_ = false;      ///< whether an iteration settled the step
  bool found_ = false;        ///< whether contacts and bounds are valid for the next event
  std::int64_t rounds_ = 0, iterations_ = 0, since_detection_ = 0;
};

}  // namespace ogc::reference
