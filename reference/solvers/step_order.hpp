// The order of Algorithm 3 with the guess loop of method.md §5.2, apart from what its events do.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/stages/step.hpp"

namespace ogc::reference {

/// Says what comes next, given how many vertices each event cut. K, of bounded_count, is `moving`.
class StepOrder {
 public:
  StepOrder(const compare::Settings& settings, compare::Index moving)
      : settings_(settings), redetect_count_(std::max(1.0, std::ceil(settings.redetect_fraction * moving))) {}

  /// Empty after the last iteration.
  std::optional<compare::StepEventKind> next() const {
    if (guessing_) return found_ ? compare::StepEventKind::guess : compare::StepEventKind::detection;
    if (iterations_ == settings_.iterations) return std::nullopt;
    return found_ ? compare::StepEventKind::sweep : compare::StepEventKind::detection;
  }

  /// The event that was next took place; `cut`: of a round or an iteration.
  void took_place(compare::Index cut) {
    switch (*next()) {
      case compare::StepEventKind::detection:
        found_ = true;
        since_detection_ = 0;
        break;
      case compare::StepEventKind::guess:
        guessing_ = settings_.guess == compare::Guess::rounds && cut >= redetect_count_ &&
                    ++rounds_ < settings_.guess_rounds;
        found_ = !guessing_;
        break;
      case compare::StepEventKind::sweep:
        ++iterations_;
        ++since_detection_;
        found_ = cut < redetect_count_ &&
                 (settings_.redetect_every == 0 || since_detection_ < settings_.redetect_every);
        break;
    }
  }

  /// So many cut vertices ask for a detection.
  bool are_many(compare::Index cut) const { return cut >= redetect_count_; }
  /// The guess that took place was by pairs and may have left the regions of its detection: another comes before the
  /// first iteration.
  void left_regions() { found_ = false; }

  /// Whether a round of the guess loop holds vertices in contact: from the second on.
  bool holds_contacts() const { return rounds_ > 0; }

 private:
  const compare::Settings& settings_;
  double redetect_count_;  ///< max(1, ⌈γ_e K⌉)
  bool guessing_ = true;   ///< in the guess loop
  bool found_ = false;     ///< contacts and bounds hold for what comes next
  std::int64_t rounds_ = 0, iterations_ = 0, since_detection_ = 0;
};

}  // namespace ogc::reference
