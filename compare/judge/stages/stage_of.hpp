// Makes the traits of a stage from a class. The class has the members of its stage; its bases in this file have members
// of several stages. A class that lacks a member of the traits does not compile.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/states.hpp"
#include "compare/judge/engine/ask.hpp"
#include "compare/judge/engine/benchmark.hpp"
#include "compare/judge/engine/bits.hpp"
#include "compare/judge/engine/shrink.hpp"
#include "compare/judge/report/answers.hpp"
#include "compare/judge/report/quantities.hpp"
#include "compare/judge/report/shape.hpp"
#include "compare/judge/report/wrong_forms.hpp"
#include "compare/judge/stages/verdict.hpp"

namespace ogc::compare {

/// Returns a function that stores the case of S::of_scene as data; null if the stage has none.
template <class S>
constexpr auto scene_maker() -> CaseData (*)(const Scene&, const Contestant&) {
  if constexpr (std::is_null_pointer_v<decltype(S::of_scene)>)
    return nullptr;
  else
    return [](const Scene& scene, const Contestant& contestant) -> CaseData { return S::of_scene(scene, contestant); };
}

/// Makes the traits of the stage `S`. `S::Case` is the type of its cases; all other members have the names of
/// StageTraits and take such cases.
template <class S>
constexpr StageTraits make_traits() {
  using Case = typename S::Case;
  return {
      .info = S::info,
      .generators = S::generators,
      .metrics = S::metrics,
      .parameters = S::parameters,
      .check = [](const CaseData& data, FirstProblem& problem) { S::check(case_of<Case>(data), problem); },
      .set = [](CaseData& data, std::span<const Override> values) { return S::set(case_of<Case>(data), values); },
      .mutate = [](Random& random, CaseData& data) { S::mutate(random, case_of<Case>(data)); },
      .coordinates = [](CaseData& data) -> std::vector<float*> { return S::coordinates(case_of<Case>(data)); },
      .missing_in = [](const States& states) -> std::string { return S::missing_in(states); },
      .of_state = [](const States& states, std::uint64_t index, Random& random) -> CaseData {
        return S::of_state(states, index, random);
      },
      .write = [](const CaseData& data) { return S::write(case_of<Case>(data)); },
      .read = [](const nlohmann::ordered_json& json) -> CaseData { return S::read(json); },
      .shape = [](const CaseData& data) { return S::shape(case_of<Case>(data)); },
      .inputs = [](const CaseData& data) { return S::inputs(case_of<Case>(data)); },
      .mesh = [](const CaseData& data) -> const Topology* { return S::mesh(case_of<Case>(data)); },
      .part = [](const CaseData& data, const MeshPart& part) -> CaseData { return S::part(case_of<Case>(data), part); },
      .numbers = [](CaseData& data) { return S::numbers(case_of<Case>(data)); },
      .can_judge = S::can_judge,
      .ask = S::ask,
      .bits = S::bits,
      .answers = S::answers,
      .wrong_forms = S::wrong_forms,
      .benchmark = S::benchmark,
      .of_scene = scene_maker<S>(),
      .is_same_renumbered = S::is_same_renumbered};
}

/// A case that cannot be made smaller.
struct TakenWhole {
  /// Implement the functions of StageTraits for shrinking: there is neither a mesh nor a number that could be
  /// shortened.
  template <class Case>
  static const Topology* mesh(const Case&) {
    return nullptr;
  }
  template <class Case>
  static Case part(const Case& c, const MeshPart&) {
    return c;
  }
  template <class Case>
  static ShortenedNumbers numbers(Case&) {
    return {};
  }
};

/// A stage without a check of renumbering: its answers depend on the numbers of vertices and triangles, or its
/// questions have no mesh.
struct Numbered {
  /// Null means that renumbering is not checked.
  static constexpr std::nullptr_t is_same_renumbered = nullptr;
};

/// A stage whose benchmarks use its own generic cases.
struct OwnCases {
  /// Null means that no scene makes a case.
  static constexpr std::nullptr_t of_scene = nullptr;
};

/// A stage whose cases have no parameters.
struct NoParameters {
  static constexpr std::span<const ParameterInfo> parameters{};
  template <class Case>
  static std::string set(Case&, std::span<const Override>) {
    return {};
  }
};

/// A stage whose parameters are numbers of the case: `S::parameter(case, name)` points to one.
template <class S>
struct ParametersOfCase {
  /// Sets each parameter that `values` name.
  template <class Case>
  static std::string set(Case& c, std::span<const Override> values) {
    for (const Override& value : values) *S::parameter(c, value.name) = value.value;
    return {};
  }
};

/// A stage that has cases in every run.
struct InEveryRun {
  /// Returns an empty text.
  static std::string missing_in(const States&) { return {}; }
};

/// A stage that has cases only in runs with a contact.
struct OfContacts {
  /// Returns why the run has no cases for the stage; empty if one of its frames has a contact.
  static std::string missing_in(const States& states) {
    return states.has_contact() ? "" : "none of its frames has a contact";
  }
};

/// Returns the question that consists of the unchanged cases.
template <class In, class Case>
In case_question(Cases cases, std::vector<Case> In::*questions) {
  In in;
  for (const TestCase& test : cases) (in.*questions).push_back(case_of<Case>(test.data));
  return in;
}

/// The types of question and answer of a stage of Contestant or Authority.
template <class Member>
struct SideTypes;
template <class Answered, class Asked, class Side>
struct SideTypes<std::function<Answered(const Asked&)> Side::*> {
  using In = Asked;
  using Answer = Answered;
};

/// Returns the contestant's answer. If the contestant fails, returns nothing and writes the reason into the note.
template <class Out, class In>
std::optional<Out> answer_or_note(const std::function<Out(const In&)>& contestant, const In& in, std::string& note) {
  try {
    return contestant(in);
  } catch (const ContestantFailure& failure) {
    note = std::string("no answer: ") + failure.what();
    return std::nullopt;
  }
}

/// A stage that asks contestant and authority the same question. `S::outputs(in, answer)` returns the members of an Out
/// or of a Truth as named quantities.
template <class S, auto contestant, auto authority>
struct SameQuestion {
  using In = typename SideTypes<decltype(contestant)>::In;
  using Out = typename SideTypes<decltype(contestant)>::Answer;
  using Truth = typename SideTypes<decltype(authority)>::Answer;

  /// Checks whether contestant and authority have the stage.
  static bool can_judge(const Contestant& c, const Authority& a) { return c.*contestant && a.*authority; }

  /// Returns a remark that is printed with an exact answer.
  static std::string note(const Truth&) { return {}; }

  /// Returns both answers to the case.
  static Answers answers(const TestCase& test, const Contestant& c, const Authority& a) {
    const In in = S::question_of(test);
    const Truth truth = (a.*authority)(in);
    std::string note = S::note(truth);
    const std::optional<Out> out = answer_or_note(c.*contestant, in, note);
    return paired(out ? S::outputs(in, *out) : std::vector<Quantity>{}, S::outputs(in, truth), note);
  }
};

/// A stage with single cases, many in one question. It needs `S::question(cases)`, `S::judge(cases, in, truth, out,
/// tally)`, and `S::arrays(out)`, which ties the arrays of an answer; entry i of each belongs to case i.
template <class S, auto contestant, auto authority>
struct BatchStage : SameQuestion<S, contestant, authority>, Numbered, OwnCases {
  using typename SameQuestion<S, contestant, authority>::In;
  using typename SameQuestion<S, contestant, authority>::Out;

  /// Returns the question of a single case.
  static In question_of(const TestCase& test) { return S::question({&test, 1}); }

  /// Asks contestant and authority one question with all cases, and judges the answer.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    const In in = S::question(cases);
    S::judge(cases, in, asker.truth(in, a.*authority), asker.answer(in, c.*contestant), tally);
  }

  /// Returns the bits of the answer to one question with all cases.
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority&) {
    const Out out = (c.*contestant)(S::question(cases));
    return std::apply([&](const auto&... arrays) { return bits_by_case(cases.size(), arrays...); }, S::arrays(out));
  }

  /// Returns a benchmark of one question with all cases.
  static BenchmarkCall benchmark(Cases cases, const Contestant& c, const Authority&) {
    const auto in = std::make_shared<const In>(S::question(cases));
    return {[in, stage = c.*contestant] { stage(*in); }, static_cast<std::int64_t>(cases.size())};
  }
};

/// A stage whose cases are meshes. The question of a case is a view of the case. The class needs `S::question(case)`,
/// `S::judge(test, truth, out, tally)` and `S::add(bits, out)`, which adds an answer's bits.
template <class S, auto contestant, auto authority>
struct MeshStage : SameQuestion<S, contestant, authority> {
  using typename SameQuestion<S, contestant, authority>::In;

  /// Returns a view of the case.
  static In question_of(const TestCase& test) { return S::question(case_of<typename S::Case>(test.data)); }

  /// Asks contestant and authority about each mesh, and judges the answers.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    for (const TestCase& test : cases) {
      const In in = question_of(test);
      S::judge(test, asker.truth(in, a.*authority), asker.answer(in, c.*contestant), tally);
    }
  }

  /// Returns the bits of the answer for each mesh.
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority&) {
    std::vector<std::string> all;
    for (const TestCase& test : cases) {
      Bits bits;
      S::add(bits, (c.*contestant)(question_of(test)));
      all.push_back(bits.take());
    }
    return all;
  }

  /// Returns the number of vertices, the unit of a benchmark's rate.
  template <class Case>
  static std::int64_t items(const Case& c) {
    return c.topology->vertex_count;
  }

  /// Returns a benchmark of the first case.
  static BenchmarkCall benchmark(Cases cases, const Contestant& c, const Authority&) {
    const auto test = std::make_shared<const TestCase>(cases.front());
    return {[test, in = question_of(*test), stage = c.*contestant] { stage(in); },
            S::items(case_of<typename S::Case>(test->data))};
  }
};

}  // namespace ogc::compare
