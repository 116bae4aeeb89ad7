#include "compare/judge/ask.hpp"

#include <chrono>

#include "compare/judge/questions.hpp"
#include "compare/judge/sweep_question.hpp"

namespace ogc::compare {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Asks both sides the same question.
class Asker {
 public:
  Asker(std::mutex& turn, Tally& tally) : turn_(turn), tally_(tally) {}

  template <class Question, class Truth, class In>
  Truth truth(const Question& question, const std::function<Truth(const In&)>& authority) {
    const auto start = std::chrono::steady_clock::now();
    Truth truth = authority(question);
    tally_.authority_seconds += seconds_since(start);
    return truth;
  }

  template <class Question, class Out, class In>
  Out answer(const Question& question, const std::function<Out(const In&)>& contestant) {
    const std::lock_guard lock(turn_);
    const auto start = std::chrono::steady_clock::now();
    Out out = contestant(question);
    tally_.contestant_seconds += seconds_since(start);
    return out;
  }

 private:
  std::mutex& turn_;
  Tally& tally_;
};

/// Likewise, and each event of the answer is a question of its own.
void ask_step(const TestCase& test, const Contestant& contestant, const Authority& authority, Asker& asker,
              Tally& tally) {
  const StepIn question = step_question(test);
  const StepOut out = asker.answer(question, contestant.step);
  if (!can_judge_step(test, question, out, tally)) return;
  const std::function<bool(const StepIn&)> about_answer = [&](const StepIn& in) {
    judge_step(test, in, authority.step(in, out), out, authority, tally);
    return true;
  };
  asker.truth(question, about_answer);
}

/// The truth follows the answer, so the contestant is asked first.
void ask_sweep(const TestCase& test, const Contestant& contestant, const Authority& authority, Asker& asker,
               Tally& tally) {
  const SweepQuestion question(std::get<SweepCase>(test.data), authority);
  const SweepOut out = asker.answer(question.in(), contestant.sweep);
  if (!can_judge_sweep(test, question.in(), out, tally)) return;
  const std::function<SweepTruth(const SweepIn&)> about_answer = [&](const SweepIn& in) {
    return authority.sweep(in, out);
  };
  judge_sweep(test, question.in(), asker.truth(question.in(), about_answer), out, tally);
}

void ask_mesh(Stage stage, const TestCase& test, const Contestant& contestant, const Authority& authority, Asker& asker,
              Tally& tally) {
  if (stage == Stage::step) {
    ask_step(test, contestant, authority, asker, tally);
    return;
  }
  if (stage == Stage::sweep) {
    ask_sweep(test, contestant, authority, asker, tally);
    return;
  }
  if (stage == Stage::rest_state) {
    const RestStateIn in = rest_question(test);
    judge_rest_state(test, asker.truth(in, authority.rest_state), asker.answer(in, contestant.rest_state), tally);
    return;
  }
  if (stage == Stage::block) {
    const BlockIn in = block_question(test);
    judge_block(test, asker.truth(in, authority.block), asker.answer(in, contestant.block), tally);
    return;
  }
  if (stage == Stage::bound) {
    const BoundIn in = bound_question(test);
    judge_bound(test, asker.truth(in, authority.bound), asker.answer(in, contestant.bound), tally);
    return;
  }
  const DetectIn in = detect_question(test);
  if (stage == Stage::detect_vertex_facet)
    judge_detect_vertex_facet(test, asker.truth(in, authority.detect_vertex_facet),
                              asker.answer(in, contestant.detect_vertex_facet), tally);
  else
    judge_detect_edge_edge(test, asker.truth(in, authority.detect_edge_edge),
                           asker.answer(in, contestant.detect_edge_edge), tally);
}

/// Position and cut are asked about the y of the answer.
void ask_guess(Cases cases, const Contestant& contestant, const Authority& authority, Asker& asker, Tally& tally) {
  const InitialGuessIn in = case_question(cases, &InitialGuessIn::cases);
  const InitialGuessOut out = asker.answer(in, contestant.initial_guess);
  const TruncateTruth cut = asker.truth(cut_question(in, out), authority.truncate);
  judge_initial_guess(cases, in, asker.truth(in, authority.initial_guess), cut, out, tally);
}

void ask_force(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority, Asker& asker,
               Tally& tally) {
  const auto put = [&](const auto& in, const auto& truth, const auto& answer) {
    judge_force(cases, asker.truth(in, truth), asker.answer(in, answer), tally);
  };
  switch (stage) {
    case Stage::contact_force:
      return put(case_question(cases, &ContactForceIn::cases), authority.contact_force, contestant.contact_force);
    case Stage::friction_force:
      return put(case_question(cases, &FrictionForceIn::cases), authority.friction_force, contestant.friction_force);
    case Stage::membrane: return put(case_question(cases, &MembraneIn::cases), authority.membrane, contestant.membrane);
    case Stage::spring: return put(case_question(cases, &SpringIn::cases), authority.spring, contestant.spring);
    default: return put(case_question(cases, &BendingIn::cases), authority.bending, contestant.bending);
  }
}

}  // namespace

void ask(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
         std::mutex& contestant_turn, Tally& tally) {
  if (cases.empty()) return;
  Asker asker(contestant_turn, tally);
  if (is_mesh_stage(stage)) {
    for (const TestCase& test : cases) ask_mesh(stage, test, contestant, authority, asker, tally);
  } else if (is_force_stage(stage)) {
    ask_force(stage, cases, contestant, authority, asker, tally);
  } else if (stage == Stage::closest_face) {
    const ClosestFaceIn in = face_question(cases);
    judge_closest_face(cases, in, asker.truth(in, authority.closest_face), asker.answer(in, contestant.closest_face),
                       tally);
  } else if (stage == Stage::closest_points) {
    const ClosestPointsIn in = points_question(cases);
    judge_closest_points(cases, in, asker.truth(in, authority.closest_points),
                         asker.answer(in, contestant.closest_points), tally);
  } else if (stage == Stage::initial_guess) {
    ask_guess(cases, contestant, authority, asker, tally);
  } else if (stage == Stage::activation) {
    const ActivationIn in = activation_question(cases);
    judge_activation(cases, in, asker.truth(in, authority.activation), asker.answer(in, contestant.activation), tally);
  } else {
    const TruncateIn in = truncate_question(cases);
    judge_truncate(cases, in, asker.truth(in, authority.truncate), asker.answer(in, contestant.truncate), tally);
  }
}

}  // namespace ogc::compare
