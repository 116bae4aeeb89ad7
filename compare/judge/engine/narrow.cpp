#include "compare/judge/engine/narrow.hpp"

#include <optional>
#include <string>

#include "compare/judge/engine/ask.hpp"

namespace ogc::compare {

namespace {

class Narrowing {
 public:
  Narrowing(Stage stage, const Contestant& contestant, const Authority& authority, std::mutex& turn, Tally& tally)
      : stage_(stage), contestant_(contestant), authority_(authority), turn_(turn), tally_(tally) {}

  /// Judges the cases. If the contestant fails, counts nothing and returns the failure's message.
  std::optional<std::string> judge(Cases cases) {
    Tally attempt(stage_);
    try {
      ask(stage_, cases, contestant_, authority_, turn_, attempt);
    } catch (const ContestantFailure& failure) {
      return failure.what();
    }
    tally_.add(attempt);
    return std::nullopt;
  }

  /// Takes a batch that fails. Judges the cases before the first failing one, reports this one, and returns the cases
  /// after it.
  Cases report_first(Cases cases, std::string message) {
    std::size_t failing = cases.size();
    for (bool is_first = true; failing > 1; is_first = false) {
      // The first half is one case, so that a contestant that fails everywhere is found at once.
      const Cases half = cases.first(is_first ? 1 : failing / 2);
      if (auto of_half = judge(half)) {
        failing = half.size();
        message = *of_half;
        continue;
      }
      cases = cases.subspan(half.size());
      failing -= half.size();
      if (auto of_rest = judge(cases.first(failing))) {
        message = *of_rest;
        continue;
      }
      // Each half alone got an answer: the cases fail only together, and all have now been judged.
      mismatch(cases[0], message + " (in a batch with others, not alone)");
      return cases.subspan(failing);
    }
    mismatch(cases[0], message);
    return cases.subspan(1);
  }

 private:
  void mismatch(const TestCase& test, const std::string& message) {
    tally_.begin(test.name);
    tally_.count(1, 1, 0);
    tally_.mismatch("no answer: " + message);
    ++tally_.failures;
  }

  Stage stage_;
  const Contestant& contestant_;
  const Authority& authority_;
  std::mutex& turn_;
  Tally& tally_;
};

}  // namespace

void ask_narrowing(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
                   std::mutex& contestant_turn, std::uint64_t allowed, Tally& tally) {
  Narrowing narrowing(stage, contestant, authority, contestant_turn, tally);
  while (!cases.empty() && tally.failures < allowed) {
    const auto message = narrowing.judge(cases);
    if (!message) return;
    cases = narrowing.report_first(cases, *message);
  }
}

}  // namespace ogc::compare
