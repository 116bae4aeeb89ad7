// Makes the traits of stage bending.
#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

namespace {

std::vector<WrongForm> bending_forms() {
  constexpr auto stage = &Authority::bending;
  std::vector<WrongForm> forms = common_forms(stage);
  add_damping(forms, stage);
  forms.push_back(case_asked("rest_angle_missing", "θ₀ is 0", stage, [](BendingCase& c) { c.rest_angle = 0; }));
  forms.push_back(case_asked("rest_angle_flipped", "θ₀ with the other sign", stage,
                             [](BendingCase& c) { c.rest_angle = -c.rest_angle; }));
  forms.push_back(case_asked("opposite_exchanged", "the opposite vertices exchanged", stage, [](BendingCase& c) {
    std::swap(c.vertex[2], c.vertex[3]);
    std::swap(c.start[2], c.start[3]);
    if (c.own > 1) c.own = 5 - c.own;
  }));
  forms.push_back(case_asked("weights_exchanged", "isometric weights of o0 and o1 exchanged", stage,
                             [](BendingCase& c) { std::swap(c.weight[1], c.weight[2]); }));
  for (const BendingModel model : choices<BendingModel>) {
    if (model == BendingModel::none) continue;
    const std::string name(name_of(model));
    forms.push_back(
        case_asked(name + "_for_every_model", name + ", whichever model is asked for", stage, [model](BendingCase& c) {
          if (c.model != BendingModel::none) c.model = model;
        }));
  }
  return forms;
}

struct Bending : ForceStage<Bending, BendingCase, &Contestant::bending, &Authority::bending> {
  static constexpr StageInfo info{.name = "bending",
                                  .question = "force and block of one vertex of one hinge",
                                  .unit = "stencil",
                                  .reference = "reference/energies/bending.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", bending_force_tolerance},
                                      MetricInfo{"block", "u cond", bending_block_tolerance}};
  static constexpr std::array parameters{ParameterInfo{"c", "stiffness of the hinge [J]", 0x1p-60f, ranges::vast},
                                         ParameterInfo{"theta_0", "rest angle [rad]", -3.1415925f, 3.1415925f},
                                         ranges::damping};
  static float* parameter(Case& c, std::string_view name) {
    return name == "c" ? &c.stiffness : name == "theta_0" ? &c.rest_angle : &c.damping;
  }

  static std::span<const Generator> generators() { return bending_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, c.vertex, 0x1p-30f);
    check_lengths(problem, c.start, 0x1p-30f);
    problem.number("a stiffness", c.stiffness, 0x1p-60f, vast);
    problem.number("a damping", c.damping, 0, most_length);
    problem.require(c.own >= 0 && c.own < 4, "no such vertex is asked about");
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.vertex, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.vertex, c.start}); }
  static std::string missing_in(const States& states) {
    return states.rest().hinges.empty() ? "no body that moves bends" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.hinge(states.frame(index), random);
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.vertex);
    shape.triangles = {{0, 1, 2}, {1, 0, 3}};
    shape.dots.push_back(c.own);
    return shape;
  }
  static std::vector<std::string> roles(const Case&) {
    return {"vertex 0, x0 of the edge", "vertex 1, x1 of the edge", "vertex 2, opposite o0", "vertex 3, opposite o1"};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return bending_forms(); }
};

}  // namespace

constinit const StageTraits stages::bending = make_traits<Bending>();

}  // namespace ogc::compare
