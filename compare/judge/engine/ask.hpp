// Gives cases to the contestant and the authority, and measures the time of each.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <span>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/judge/engine/tally.hpp"

namespace ogc::compare {

/// Cases of one stage.
using Cases = std::span<const TestCase>;

/// Asks contestant and authority the same question. Adds the seconds of each answer to a tally.
class Asker {
 public:
  Asker(std::mutex& contestant_turn, Tally& tally) : turn_(contestant_turn), tally_(tally) {}

  /// Returns the authority's answer.
  template <class Question, class Truth, class In>
  Truth truth(const Question& question, const std::function<Truth(const In&)>& authority) {
    const auto start = std::chrono::steady_clock::now();
    Truth truth = authority(question);
    tally_.authority_seconds += seconds_since(start);
    return truth;
  }

  /// Returns the contestant's answer. One thread at a time calls the contestant.
  template <class Question, class Out, class In>
  Out answer(const Question& question, const std::function<Out(const In&)>& contestant) {
    const std::lock_guard lock(turn_);
    const auto start = std::chrono::steady_clock::now();
    Out out = contestant(question);
    tally_.contestant_seconds += seconds_since(start);
    return out;
  }

 private:
  static double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  std::mutex& turn_;
  Tally& tally_;
};

/// Gives cases of one stage to contestant and authority, and judges the answers. Holds `contestant_turn` during each
/// call of the contestant, which need not be safe for several threads.
void ask(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
         std::mutex& contestant_turn, Tally& tally);

}  // namespace ogc::compare
