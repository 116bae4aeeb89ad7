#include "compare/judge/report/wrong_forms.hpp"

#include <memory>
#include <mutex>
#include <optional>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/ask.hpp"

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
  return traits_of(stage).wrong_forms(evidence);
}

}  // namespace ogc::compare
