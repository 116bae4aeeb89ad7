#include "compare/judge/explain/wrong_forms.hpp"

#include <memory>
#include <mutex>
#include <optional>

#include "compare/judge/ask.hpp"
#include "compare/judge/contestant_stages.hpp"
#include "compare/judge/explain/form_tools.hpp"

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
  switch (stage) {
    case Stage::activation: return activation_forms();
    case Stage::truncate: return truncate_forms();
    case Stage::initial_guess: return initial_guess_forms();
    case Stage::bound: return bound_forms();
    case Stage::contact_force: return contact_force_forms();
    case Stage::friction_force: return friction_force_forms();
    case Stage::membrane: return membrane_forms();
    case Stage::bending: return bending_forms();
    case Stage::spring: return spring_forms();
    case Stage::closest_face: return closest_face_forms();
    case Stage::closest_points: return closest_points_forms();
    case Stage::block: return block_forms();
    case Stage::detect_vertex_facet: return detect_vertex_facet_forms(evidence);
    case Stage::detect_edge_edge: return detect_edge_edge_forms(evidence);
    case Stage::rest_state: return rest_state_forms();
    case Stage::sweep: return sweep_forms();
    case Stage::step: return {};  // its events are judged as the stages that they are, and named
  }
  return {};
}

}  // namespace ogc::compare
