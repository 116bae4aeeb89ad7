#include "compare/judge/report/wrong_forms.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/ask.hpp"
#include "compare/judge/report/answers.hpp"
#include "compare/stages/all.hpp"

namespace ogc::compare {

namespace {

template <class Out, class In>
std::function<Out(const In&)> asked_once(const std::function<Out(const In&)>& contestant) {
  if (!contestant) return {};
  return [contestant, answer = std::make_shared<std::optional<Out>>()](const In& in) {
    if (!*answer) *answer = contestant(in);
    return **answer;
  };
}

/// Checks whether the answer contains a NaN or is right.
bool is_no_number_or_right(const Evidence& evidence, const Authority& authority) {
  const std::vector<AnswerPair> outputs = answers_to(evidence.test, evidence.answered, authority).outputs;
  const bool is_nan = std::ranges::any_of(outputs, [](const AnswerPair& pair) {
    return std::ranges::any_of(pair.given.numbers, [](double x) { return std::isnan(x); });
  });
  return is_nan || agrees(evidence, authority);
}

}  // namespace

Contestant remembered(const Contestant& contestant) {
  Contestant copy = contestant;
  visit_stages([&](const char*, auto stage) { copy.*stage = asked_once(contestant.*stage); });
  return copy;
}

bool agrees(const Evidence& evidence, const Authority& authority) {
  std::mutex turn;
  Tally tally(evidence.test.name.stage);
  ask(evidence.test.name.stage, {&evidence.test, 1}, evidence.answered, authority, turn, tally);
  return tally.mismatched == 0;
}

WrongForm form_of(std::string name, std::string meaning, std::function<Authority(const Authority&)> wrong) {
  const auto fits = [wrong](const Evidence& evidence, const Authority& authority) {
    return agrees(evidence, wrong(authority));
  };
  return {std::move(name), std::move(meaning), fits, std::move(wrong)};
}

std::vector<WrongForm> wrong_forms(Stage stage, std::span<const Evidence> evidence) {
  std::vector<WrongForm> forms = traits_of(stage).wrong_forms(evidence);
  if (stage_info(stage).kind == CaseKind::single)
    forms.push_back({.name = "not_a_number",
                     .meaning = "an answer that is no number, all else right",
                     .fits = is_no_number_or_right,
                     .is_vague = true});
  return forms;
}

}  // namespace ogc::compare
