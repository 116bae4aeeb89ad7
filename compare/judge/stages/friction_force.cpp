// Makes the traits of stage friction_force.
#include "compare/judge/stages/contact_stencil.hpp"

namespace ogc::compare {

namespace {

std::vector<WrongForm> friction_force_forms() {
  constexpr auto stage = &Authority::friction_force;
  std::vector<WrongForm> forms = common_forms(stage);
  add_contact(forms, stage, [](FrictionForceCase& c) -> ContactForceCase& { return c.contact; });
  forms.push_back(case_asked("smoothing_missing", "f₁ is 1 below the slip limit, too", stage,
                             [](FrictionForceCase& c) { c.slip_limit *= 0x1p-24f; }));
  forms.push_back(case_asked("slip_since_now", "slip since the present position, not since the start of the step: none",
                             stage, [](FrictionForceCase& c) { c.start = c.contact.vertex; }));
  forms.push_back(
      case_told("ones_for_identity", "the block from a matrix full of ones where I belongs: 1 − n nᵀ for I − n nᵀ",
                stage, [](const FrictionForceCase&, ForceAnswer& answer) { add_ones(answer, trace(answer) / 2); }));
  forms.push_back(
      case_asked("friction_squared", "μ² for μ", stage, [](FrictionForceCase& c) { c.friction *= c.friction; }));
  return forms;
}

struct FrictionForce
    : ForceStage<FrictionForce, FrictionForceCase, &Contestant::friction_force, &Authority::friction_force>,
      OfContacts {
  static constexpr StageInfo info{.name = "friction_force",
                                  .question = "likewise, friction",
                                  .unit = "stencil",
                                  .reference = "reference/energies/friction_force.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", friction_force_tolerance},
                                      MetricInfo{"block", "u cond", friction_block_tolerance}};
  static constexpr ParameterInfo slip_limit{"slip", "slip limit ε_v h [m]", 0x1p-100f, ranges::most};
  static constexpr std::array parameters{ranges::contact_radius, ranges::contact_stiffness, ranges::friction,
                                         slip_limit};
  static float* parameter(Case& c, std::string_view name) {
    return name == ranges::friction.name ? &c.friction
           : name == slip_limit.name     ? &c.slip_limit
                                         : contact_parameter(c.contact, name);
  }

  static std::span<const Generator> generators() { return friction_force_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    check_contact(c.contact, problem);
    problem.vectors("a coordinate at the start", c.start);
    problem.number("a friction coefficient", c.friction, 0, 0x1p10f);
    problem.number("a slip limit", c.slip_limit, slip_limit.minimum, most_length);
  }
  static void mutate(Random& random, Case& c) { mutate_points(random, vertices_of(c.contact.vertex, c.contact.sides)); }
  static std::vector<float*> coordinates(Case& c) {
    return coordinates_of({vertices_of(c.contact.vertex, c.contact.sides), vertices_of(c.start, c.contact.sides)});
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.contact(states.contact_frame(index), random);
  }
  static Case checked(Case c) {
    check_own(c.contact);
    return c;
  }
  static Shape shape(const Case& c) { return contact_shape(c.contact); }
  static std::vector<std::string> roles(const Case& c) { return contact_roles(c.contact.sides); }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return friction_force_forms(); }
};

}  // namespace

constinit const StageTraits stages::friction_force = make_traits<FrictionForce>();

}  // namespace ogc::compare
