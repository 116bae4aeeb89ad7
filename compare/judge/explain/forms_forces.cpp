// Forms of the stages that answer with a force and a block.
#include <array>
#include <cmath>

#include "compare/judge/explain/form_tools.hpp"
#include "compare/problem/material_table.hpp"

namespace ogc::compare {

namespace {

template <class In>
using Member = std::function<ForceTruth(const In&)> Authority::*;

/// Each case is changed before the authority is asked.
template <class In, class Change>
WrongForm case_asked(std::string name, std::string meaning, Member<In> stage, Change change) {
  return asked(std::move(name), std::move(meaning), stage, [change](In& in) {
    for (auto& c : in.cases) change(c);
  });
}

/// Each accepted answer is changed: `change(case, answer)`.
template <class In, class Change>
WrongForm case_told(std::string name, std::string meaning, Member<In> stage, Change change) {
  return told(std::move(name), std::move(meaning), stage, [change](const In& in, ForceTruth& truth) {
    for (std::size_t i = 0; i < in.cases.size(); ++i)
      for (ForceAnswer& answer : truth.accepted[i]) change(in.cases[i], answer);
  });
}

void scale_force(ForceAnswer& answer, double factor) {
  answer.force = {factor * answer.force.x, factor * answer.force.y, factor * answer.force.z};
  answer.force_scale *= std::abs(factor);
}

void scale_block(ForceAnswer& answer, double factor) {
  for (double& b : answer.block) b *= factor;
  answer.block_scale *= std::abs(factor);
}

/// What can go wrong with any force and block.
template <class In>
std::vector<WrongForm> common_forms(Member<In> stage) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  const auto factor = [stage](const char* name, const char* meaning, double of_force, double of_block) {
    return case_told(name, meaning, stage, [of_force, of_block](const Case&, ForceAnswer& answer) {
      scale_force(answer, of_force);
      scale_block(answer, of_block);
    });
  };
  return {factor("flipped_sign", "the force with the other sign: the gradient in place of minus it", -1, 1),
          factor("twice_as_stiff", "force and block doubled", 2, 2),
          factor("half_as_stiff", "force and block halved", 0.5, 0.5),
          factor("force_doubled", "the force doubled, the block right", 2, 1),
          factor("force_halved", "the force halved, the block right", 0.5, 1),
          factor("hessian_counted_twice", "the block doubled, the force right", 1, 2),
          factor("hessian_halved", "the block halved, the force right", 1, 0.5),
          factor("hessian_flipped", "the block with the other sign", 1, -1),
          factor("hessian_missing", "the block is 0, the force right", 1, 0),
          factor("term_missing", "force and block are 0: the whole term is dropped", 0, 0),
          case_told("hessian_diagonal_alone", "the block without what is off its diagonal", stage,
                    [](const Case&, ForceAnswer& answer) { answer.block[1] = answer.block[2] = answer.block[4] = 0; }),
          case_told("hessian_isotropic", "the block's trace on its diagonal: I in place of n nᵀ or I − n nᵀ", stage,
                    [](const Case&, ForceAnswer& answer) {
                      const double trace = answer.block[0] + answer.block[3] + answer.block[5];
                      answer.block = {trace, 0, 0, trace, 0, trace};
                    })};
}

/// Damping that is dropped, in part or whole, or is of the other form.
template <class In>
void add_damping(std::vector<WrongForm>& forms, Member<In> stage) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  using Right = std::function<ForceTruth(const In&)>;
  forms.push_back(case_asked("damping_missing", "without damping", stage, [](Case& c) { c.damping = 0; }));
  forms.push_back(case_asked("damping_doubled", "2 k for the damping k", stage, [](Case& c) { c.damping *= 2; }));
  forms.push_back(case_asked("damping_of_strains_for_every_form",
                             "damping of strains, where damping by vertex is asked for", stage,
                             [](Case& c) { c.damping_form = DampingForm::strain; }));
  forms.push_back(case_asked("damping_per_vertex_for_every_form",
                             "damping by vertex, where damping of strains is asked for", stage,
                             [](Case& c) { c.damping_form = DampingForm::per_vertex; }));
  forms.push_back(form("damping_without_block", "damping in the force alone: the block lacks its part", stage,
                       [](const Right& right, const In& in) {
                         ForceTruth truth = right(in);
                         In undamped = in;
                         for (Case& c : undamped.cases) c.damping = 0;
                         const ForceTruth without = right(undamped);
                         for (std::size_t i = 0; i < truth.accepted.size(); ++i)
                           for (ForceAnswer& answer : truth.accepted[i]) answer.block = without.accepted[i][0].block;
                         return truth;
                       }));
}

/// Forms of the contact inside a question: `contact(case)` finds it.
template <class In, class Contact>
void add_contact(std::vector<WrongForm>& forms, Member<In> stage, Contact contact) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  const auto changed = [&](std::string name, std::string meaning, auto change) {
    forms.push_back(
        case_asked(std::move(name), std::move(meaning), stage, [contact, change](Case& c) { change(contact(c)); }));
  };
  for (const auto& [kind, name, meaning] : other_activations)
    changed(name, std::string(meaning) + ", where `ogc` is asked for", [to = kind](ContactForceCase& c) {
      if (c.activation == ContactActivation::ogc) c.activation = to;
    });
  changed("ogc_for_every_activation", "`ogc`, whichever activation is asked for",
          [](ContactForceCase& c) { c.activation = ContactActivation::ogc; });
  // A rest length that is none, and not 0 either: e_k is 1.
  changed("mollifier_missing", "e_k is 1: nearly parallel edges act in full", [](ContactForceCase& c) {
    if (c.rest_squared[0] > 0) c.rest_squared = {-1, -1};
  });
  changed("overlap_share_missing", "e_k is 1 for nearly parallel edges without triangles", [](ContactForceCase& c) {
    if (c.rest_squared == std::array<float, 2>{}) c.rest_squared = {-1, -1};
  });
  changed("mollifier_of_present_edges", "e_k of the present edges, not of those at the last detection",
          [](ContactForceCase& c) { c.detected = c.vertex; });
  changed("block_of_own_weight_alone", "w² in the block where other vertices are updated together with it",
          [](ContactForceCase& c) { c.together = 0; });
  changed("ends_exchanged", "the weight of the edge's other end", [](ContactForceCase& c) {
    if (c.sides == ContactSides::edge_edge) c.own ^= 1;
    if (c.sides == ContactSides::point_edge && c.own > 0) c.own = 3 - c.own;
  });
  changed("sides_exchanged", "the weight and side of the other edge", [](ContactForceCase& c) {
    if (c.sides == ContactSides::edge_edge) c.own ^= 2;
  });
}

/// w of the vertex asked about: its share of its side's force, as the weights of a side sum to 1.
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

/// Powers of the weight that are missing in force and block.
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

}  // namespace

std::vector<WrongForm> contact_force_forms() {
  std::vector<WrongForm> forms = common_forms(&Authority::contact_force);
  add_contact(forms, &Authority::contact_force, [](ContactForceCase& c) -> ContactForceCase& { return c; });
  forms.push_back(without_weights("weight_missing", "force and block without the weight of the vertex", 1, 2));
  forms.push_back(without_weights("weight_not_squared", "the block with w in place of w²", 0, 1));
  forms.push_back(without_weights("block_without_weight", "the block without w²", 0, 2));
  return forms;
}

std::vector<WrongForm> friction_force_forms() {
  constexpr auto stage = &Authority::friction_force;
  std::vector<WrongForm> forms = common_forms(stage);
  add_contact(forms, stage, [](FrictionForceCase& c) -> ContactForceCase& { return c.contact; });
  forms.push_back(case_asked("smoothing_missing", "f₁ is 1 below the slip limit, too", stage,
                             [](FrictionForceCase& c) { c.slip_limit *= 0x1p-24f; }));
  forms.push_back(case_asked("slip_since_now", "slip since the present position, not since the start of the step: none",
                             stage, [](FrictionForceCase& c) { c.start = c.contact.vertex; }));
  forms.push_back(
      case_asked("friction_squared", "μ² for μ", stage, [](FrictionForceCase& c) { c.friction *= c.friction; }));
  return forms;
}

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
  for (const auto model : {MembraneModel::st_venant_kirchhoff, MembraneModel::stable_neo_hookean}) {
    const std::string name(name_of(model));
    forms.push_back(
        case_asked(name + "_for_every_model", name + ", whichever model is asked for", stage, [model](MembraneCase& c) {
          if (c.model != MembraneModel::none) c.model = model;
        }));
  }
  return forms;
}

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
  for (const auto model : {BendingModel::discrete_hinge, BendingModel::isometric_quadratic}) {
    const std::string name(name_of(model));
    forms.push_back(
        case_asked(name + "_for_every_model", name + ", whichever model is asked for", stage, [model](BendingCase& c) {
          if (c.model != BendingModel::none) c.model = model;
        }));
  }
  return forms;
}

namespace {

/// l of the spring, from these positions.
double length_of(const SpringCase& c, const std::array<Vec3f, 3>& x) {
  const double s = c.ratio;
  const auto apart = [&](float Vec3f::*k) {
    return double{x[0].*k} - (1 - s) * (x[1].*k) - (s > 0 ? s * (x[2].*k) : 0);
  };
  return std::hypot(apart(&Vec3f::x), apart(&Vec3f::y), apart(&Vec3f::z));
}

/// No damping of strain but while the spring shortens (`sign` −1) or lengthens (1).
void damped_alone(SpringCase& c, double sign) {
  const double change = length_of(c, c.vertex) - length_of(c, c.start);
  if (c.damping_form == DampingForm::strain && !(sign * change > 0)) c.damping = 0;
}

}  // namespace

std::vector<WrongForm> spring_forms() {
  constexpr auto stage = &Authority::spring;
  std::vector<WrongForm> forms = common_forms(stage);
  add_damping(forms, stage);
  forms.push_back(case_asked("damping_on_approach_alone",
                             "damping acts while the ends approach, and not while they part", stage,
                             [](SpringCase& c) { damped_alone(c, -1); }));
  forms.push_back(case_asked("damping_on_parting_alone",
                             "damping acts while the ends part, and not while they approach", stage,
                             [](SpringCase& c) { damped_alone(c, 1); }));
  forms.push_back(case_asked("rest_length_missing", "l₀ is 0", stage, [](SpringCase& c) { c.rest_length = 0; }));
  forms.push_back(
      case_asked("ratio_exchanged", "1 − s for s: the weights of the edge's ends exchanged", stage, [](SpringCase& c) {
        if (c.ratio > 0 && c.ratio < 1) c.ratio = 1 - c.ratio;
      }));
  forms.push_back(
      case_asked("edge_end_for_point", "an end of the edge in place of the point between", stage, [](SpringCase& c) {
        if (c.own < 2) c.ratio = 0;
      }));
  return forms;
}

}  // namespace ogc::compare
