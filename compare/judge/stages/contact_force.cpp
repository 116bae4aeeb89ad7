// Makes the traits of stage contact_force.
#include <cmath>

#include "compare/judge/stages/contact_stencil.hpp"

namespace ogc::compare {

namespace {

/// Returns the weight w of the question's vertex. Weights of one side of the contact sum to 1, so w is the vertex's
/// share of the force on its side.
double weight_of(const ContactForceCase& c, const std::function<ForceTruth(const ContactForceIn&)>& right) {
  const bool is_first = c.own < (c.sides == ContactSides::edge_edge ? 2 : 1);
  Vec3 side{}, own{};
  for (std::int32_t v = 0; v < vertex_count(c.sides); ++v) {
    if ((v < (c.sides == ContactSides::edge_edge ? 2 : 1)) != is_first) continue;
    ContactForceCase other = c;
    other.own = v;
    const Vec3 force = right({{other}}).accepted[0][0].force;
    side = {side.x + force.x, side.y + force.y, side.z + force.z};
    if (v == c.own) own = force;
  }
  const double squared = side.x * side.x + side.y * side.y + side.z * side.z;
  return squared > 0 ? (own.x * side.x + own.y * side.y + own.z * side.z) / squared : 0;
}

/// Makes the form in which powers of the weight are missing from force and block.
WrongForm without_weights(std::string name, std::string meaning, int of_force, int of_block) {
  return form(
      std::move(name), std::move(meaning), &Authority::contact_force,
      [of_force, of_block](const std::function<ForceTruth(const ContactForceIn&)>& right, const ContactForceIn& in) {
        ForceTruth truth = right(in);
        for (std::size_t i = 0; i < in.cases.size(); ++i) {
          const double weight = weight_of(in.cases[i], right);
          if (weight == 0) continue;
          for (ForceAnswer& answer : truth.accepted[i]) {
            scale_force(answer, std::pow(weight, -of_force));
            scale_block(answer, std::pow(weight, -of_block));
          }
        }
        return truth;
      });
}

/// Makes the form whose block is 0 for d ≥ r. The error scale `force_scale` is 0 only for d > r. A force within its
/// error limit does not show whether d < r. Then the form accepts the right block and a block of 0.
WrongForm block_ends_at_radius() {
  return told("block_ends_at_radius", "no block from d = r on, where the curvature at r is asked for",
              &Authority::contact_force, [](const ContactForceIn&, ForceTruth& truth) {
                for (std::vector<ForceAnswer>& accepted : truth.accepted) {
                  ForceAnswer& exact = accepted.front();
                  const double force = std::hypot(exact.force.x, exact.force.y, exact.force.z);
                  if (exact.force_scale == 0)
                    exact = {};
                  else if (force <= contact_force_tolerance * unit_roundoff * exact.force_scale)
                    accepted.push_back({});
                }
              });
}

std::vector<WrongForm> contact_force_forms() {
  std::vector<WrongForm> forms = common_forms(&Authority::contact_force);
  add_contact(forms, &Authority::contact_force, [](ContactForceCase& c) -> ContactForceCase& { return c; });
  forms.push_back(without_weights("weight_missing", "force and block without the weight of the vertex", 1, 2));
  forms.push_back(without_weights("weight_not_squared", "the block with w in place of w²", 0, 1));
  forms.push_back(without_weights("block_without_weight", "the block without w²", 0, 2));
  forms.push_back(block_ends_at_radius());
  forms.push_back(case_asked("edges_exchanged",
                             "the second edge first, so that the middle of an overlap is taken on the other one",
                             &Authority::contact_force, [](ContactForceCase& c) {
                               if (c.sides != ContactSides::edge_edge) return;
                               c.vertex = {c.vertex[2], c.vertex[3], c.vertex[0], c.vertex[1]};
                               c.own ^= 2;
                               c.together = static_cast<std::uint8_t>((c.together & 3) << 2 | c.together >> 2);
                             }));
  return forms;
}

struct ContactForce : ForceStage<ContactForce, ContactForceCase, &Contestant::contact_force, &Authority::contact_force>,
                      OfContacts {
  static constexpr StageInfo info{.name = "contact_force",
                                  .question = "normal force and block of one vertex of one contact",
                                  .unit = "stencil",
                                  .reference = "reference/energies/contact_force.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", contact_force_tolerance},
                                      MetricInfo{"block", "u cond", contact_block_tolerance}};
  static constexpr std::array parameters{ranges::contact_radius, ranges::contact_stiffness};
  static constexpr auto parameter = contact_parameter;

  static std::span<const Generator> generators() { return contact_force_generators(); }

  static constexpr auto check = check_contact;
  static void mutate(Random& random, Case& c) { mutate_points(random, vertices_of(c.vertex, c.sides)); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({vertices_of(c.vertex, c.sides)}); }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.contact(states.contact_frame(index), random).contact;
  }
  static Case checked(Case c) {
    check_own(c);
    return c;
  }
  static constexpr auto shape = contact_shape;
  static std::vector<std::string> roles(const Case& c) { return contact_roles(c.sides); }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return contact_force_forms(); }
};

}  // namespace

constinit const StageTraits stages::contact_force = make_traits<ContactForce>();

}  // namespace ogc::compare
