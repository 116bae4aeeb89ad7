// Makes the traits of stage membrane.
#include <limits>

#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

namespace {

std::vector<WrongForm> membrane_forms() {
  constexpr auto stage = &Authority::membrane;
  std::vector<WrongForm> forms = common_forms(stage);
  add_damping(forms, stage);
  forms.push_back(case_asked("area_missing", "the density: A is 1", stage, [](MembraneCase& c) { c.area = 1; }));
  forms.push_back(case_asked("gradients_exchanged", "∇N₁ and ∇N₂ exchanged", stage,
                             [](MembraneCase& c) { std::swap(c.gradient[0], c.gradient[1]); }));
  forms.push_back(case_asked("lame_exchanged", "λ and μ exchanged", stage,
                             [](MembraneCase& c) { std::swap(c.lame_lambda, c.lame_mu); }));
  forms.push_back(case_asked("lambda_missing", "λ is 0", stage, [](MembraneCase& c) { c.lame_lambda = 0; }));
  forms.push_back(case_asked("lambda_for_lambda_plus_mu", "stable Neo-Hookean with λ in place of λ + μ", stage,
                             [](MembraneCase& c) {
                               if (c.model == MembraneModel::stable_neo_hookean) c.lame_lambda -= c.lame_mu;
                             }));
  for (const MembraneModel model : choices<MembraneModel>) {
    if (model == MembraneModel::none) continue;
    const std::string name(name_of(model));
    forms.push_back(
        case_asked(name + "_for_every_model", name + ", whichever model is asked for", stage, [model](MembraneCase& c) {
          if (c.model != MembraneModel::none) c.model = model;
        }));
  }
  return forms;
}

struct Membrane : ForceStage<Membrane, MembraneCase, &Contestant::membrane, &Authority::membrane> {
  static constexpr StageInfo info{.name = "membrane",
                                  .question = "force and block of one corner of one triangle",
                                  .unit = "stencil",
                                  .reference = "reference/energies/membrane.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", membrane_force_tolerance},
                                      MetricInfo{"block", "u cond", membrane_block_tolerance}};
  static constexpr std::array parameters{
      ParameterInfo{"lambda", "first Lamé constant times thickness [N/m]", 0, ranges::vast},
      ParameterInfo{"G", "second Lamé constant times thickness [N/m]", 0x1p-30f, ranges::vast}, ranges::damping};
  static float* parameter(Case& c, std::string_view name) {
    return name == "lambda" ? &c.lame_lambda : name == "G" ? &c.lame_mu : &c.damping;
  }

  static std::span<const Generator> generators() { return membrane_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.corner);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, c.corner, 0x1p-50f, 0x1p-50f);
    check_lengths(problem, c.start, 0x1p-50f, 0x1p-50f);
    problem.number("an area", c.area, std::numeric_limits<float>::min(), vast);
    problem.number("a first Lamé constant", c.lame_lambda, 0, vast);
    problem.number("a second Lamé constant", c.lame_mu, 0x1p-30f, vast);
    problem.number("a damping", c.damping, 0, most_length);
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.corner, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.corner, c.start}); }
  static std::string missing_in(const States& states) {
    return states.rest().triangles.empty() ? "no body that moves has a membrane" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.triangle(states.frame(index), random);
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.corner);
    shape.triangles.push_back({0, 1, 2});
    return shape;
  }
  static std::vector<std::string> roles(const Case&) { return {"corner 0, asked about", "corner 1", "corner 2"}; }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return membrane_forms(); }
};

}  // namespace

constinit const StageTraits stages::membrane = make_traits<Membrane>();

}  // namespace ogc::compare
