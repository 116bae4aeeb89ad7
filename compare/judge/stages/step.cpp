// Makes the traits of stage step, which is judged event by event (compare/judge/stages/step_verdict.cpp).
#include <array>

#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/scene_json.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

namespace {

Quantity event_names(const std::vector<StepEventKind>& kinds) {
  std::vector<std::string> names;
  for (const StepEventKind kind : kinds)
    names.emplace_back(kind == StepEventKind::detection ? "detection"
                       : kind == StepEventKind::guess   ? "guess"
                                                        : "sweep");
  return words("events", std::move(names));
}

/// Makes a form in which `change(move, is_first)` changes the move of each touching vertex. `is_first` is true in the
/// first round of the guess loop.
template <class Change>
WrongForm with_moves(std::string name, std::string meaning, Change change) {
  return form_of(std::move(name), std::move(meaning), [change](const Authority& authority) {
    Authority wrong = authority;
    wrong.step = [right = authority.step, change](const StepIn& in, const StepOut& out) {
      StepTruth truth = right(in, out);
      bool is_first = true;
      for (std::vector<HeldMove>& round : truth.moves) {
        for (HeldMove& held : round)
          if (held.touches != 0) change(held, is_first);
        is_first = is_first && round.empty();
      }
      return truth;
    };
    return wrong;
  });
}

/// Makes a form that uses `friction` as μ of every contact in the guess loop.
WrongForm with_friction(std::string name, std::string meaning, float friction) {
  return form_of(std::move(name), std::move(meaning), [friction](const Authority& authority) {
    Authority wrong = authority;
    wrong.step = [right = authority.step, friction](const StepIn& in, const StepOut& out) {
      StepOut other = out;
      for (auto& meeting : other.rest.meetings) meeting.friction = friction;
      return right(in, other);
    };
    return wrong;
  });
}

struct Step : TakenWhole, Numbered {
  using Case = StepCase;
  static constexpr StageInfo info{.name = "step",
                                  .question = "Algorithm 3, event by event",
                                  .unit = "vertex at an event",
                                  .reference = "reference/solvers/step.cpp",
                                  .kind = CaseKind::followed,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"query_radius", "u r_q", step_query_radius_tolerance},
                                      MetricInfo{"target", "u scale", initial_guess_target_tolerance},
                                      MetricInfo{"velocity", "u |x − xᵗ|/h", step_velocity_tolerance},
                                      MetricInfo{"guess", "accepted error", 1}};
  static constexpr std::array parameters{ranges::contact_radius, ranges::time_step, ranges::bounds_relaxation,
                                         ranges::contact_stiffness, ranges::friction};
  static std::string set(Case& c, std::span<const Override> values) {
    c.scene = ranges::with_parameters(*c.scene, values);
    return {};
  }

  static std::span<const Generator> generators() { return step_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    check_scene(problem, *c.scene);
    problem.require(c.topology->triangles == c.scene->mesh.triangles, "the topology is another mesh's");
    problem.vectors("a coordinate", to_single(c.scene->mesh.positions));
    problem.vectors("a velocity", to_single(c.scene->velocities));
  }
  static void mutate(Random& random, Case& c) {
    auto scene = std::make_shared<Scene>(*c.scene);
    scene->velocities = mutated(random, c.scene->velocities);
    c.scene = std::move(scene);
  }
  static std::vector<float*> coordinates(Case&) { return {}; }
  static std::string missing_in(const States& states) { return stages::rest_state.missing_in(states); }
  static Case of_state(const States& states, std::uint64_t index, Random&) { return states.step(states.frame(index)); }
  static Case of_scene(const Scene& scene, const Contestant&) {
    return {std::make_shared<Scene>(scene), std::make_shared<Topology>(build_topology(scene))};
  }

  static Json write(const Case& c) { return {{"scene", scene_to_json(*c.scene)}}; }
  static Case read(const Json& data) {
    Scene scene = to_scene(data.at("scene"));
    if (const auto problems = validate(scene); !problems.empty()) throw InputError(describe(problems));
    auto topology = std::make_shared<Topology>(build_topology(scene));
    return {std::make_shared<Scene>(std::move(scene)), std::move(topology)};
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, to_single(c.scene->mesh.positions));
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return joined(mesh_quantities(*c.topology), scene_quantities(*c.scene),
                  std::vector{points("positions", "m", c.scene->mesh.positions),
                              points("velocities", "m/s", c.scene->velocities)});
  }

  static StepIn question(const TestCase& test) {
    const auto& c = case_of<Case>(test.data);
    return {c.scene.get(), c.topology.get()};
  }
  static bool can_judge(const Contestant& c, const Authority& a) {
    return c.step && a.step && a.rest_state && a.detect_vertex_facet && a.detect_edge_edge && a.bound &&
           a.initial_guess && a.truncate && a.sweep && a.volume_depth;
  }
  /// Calls the contestant first: the truth is about the contestant's answer, and each event of the answer makes a
  /// question.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    for (const TestCase& test : cases) {
      const StepIn in = question(test);
      const StepOut out = asker.answer(in, c.step);
      if (!can_judge_step(test, in, out, tally)) continue;
      const std::function<bool(const StepIn&)> about_answer = [&](const StepIn& asked) {
        judge_step(test, asked, a.step(asked, out), out, a, tally);
        return true;
      };
      asker.truth(in, about_answer);
    }
  }
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority&) {
    std::vector<std::string> all;
    for (const TestCase& test : cases) {
      Bits bits;
      bits.add(c.step(question(test)));
      all.push_back(bits.take());
    }
    return all;
  }
  static BenchmarkCall benchmark(Cases cases, const Contestant& c, const Authority&) {
    const auto test = std::make_shared<const TestCase>(cases.front());
    return {[test, stage = c.step] { stage(question(*test)); }, case_of<Case>(test->data).topology->vertex_count};
  }

  static std::vector<Quantity> outputs(double query_radius, const std::vector<StepEventKind>& events,
                                       const Quantity& velocity) {
    return {scalar("query_radius", "m", query_radius), event_names(events), velocity};
  }
  static Answers answers(const TestCase& test, const Contestant& c, const Authority& a) {
    const StepIn in = question(test);
    std::string note;
    const auto out = answer_or_note(c.step, in, note);
    Tally tally(Stage::step);
    if (!out || !can_judge_step(test, in, *out, tally)) return {{}, out ? tally.mismatches[0].message : note};
    std::vector<StepEventKind> kinds;
    for (const StepEvent& event : out->events) kinds.push_back(event.kind);
    const StepTruth truth = a.step(in, *out);
    return paired(outputs(out->query_radius, kinds, points("velocity", "m/s", out->velocity)),
                  outputs(truth.query_radius, truth.events, points("velocity", "m/s", truth.velocity)), note);
  }
  /// Returns forms of the guess loop. All other events are judged as other stages, whose forms name the mistake.
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) {
    return {with_moves("touching_vertices_stay",
                       "a vertex in contact stays where it is from the second round of the guess loop on",
                       [](HeldMove& held, bool is_first) {
                         if (is_first)
                           held.touches = 0;
                         else
                           held = {.move = {}, .touches = 1};
                       }),
            with_moves("contacts_hold_nothing", "vertices in contact go to y like all others",
                       [](HeldMove& held, bool) { held.touches = 0; }),
            with_friction("guess_without_friction", "contacts in the guess loop take no slip", 0),
            with_friction("slip_taken_whole", "contacts in the guess loop take all slip, whatever Coulomb allows",
                          0x1p20f)};
  }
};

}  // namespace

constinit const StageTraits stages::step = make_traits<Step>();

}  // namespace ogc::compare
