#include "reference/energies/membrane.hpp"

#include <optional>

#include "reference/energies/inputs.hpp"
#include "reference/energies/membrane_terms.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

using compare::DampingForm;
using compare::ForceAnswer;
using compare::MembraneModel;

/// A case in Input numbers. Corners are relative to the own corner, which is the first.
struct Question {
  Inputs inputs;
  std::array<Triple<Input>, 3> corner, start;
  MembraneTermOf<Input> term;
  MembraneCorner<Input> at;

  explicit Question(const compare::MembraneCase& q)
      : corner(relative(q.corner)), start(relative(q.start)), term(term_of(q)), at(term, 0, corner) {}

 private:
  std::array<Triple<Input>, 3> relative(const std::array<compare::Vec3f, 3>& x) {
    return {Triple<Input>{}, inputs.vector(x[1], x[0]), inputs.vector(x[2], x[0])};
  }
  MembraneTermOf<Input> term_of(const compare::MembraneCase& q) {
    MembraneTermOf<Input> result;
    result.area = inputs.number(q.area);
    result.lambda = inputs.number(q.lame_lambda);
    result.mu = inputs.number(q.lame_mu);
    result.damping = inputs.number(q.damping);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (std::size_t k = 0; k < 2; ++k) result.gradient[k + 1][axis] = inputs.number(q.gradient[k][axis]);
      result.gradient[0][axis] = -result.gradient[1][axis] - result.gradient[2][axis];
    }
    result.start = strain(deformation<Input>(start, result.gradient));
    result.model = q.model;
    return result;
  }
};

double length(const Triple<Input>& a) { return std::hypot(a[0].value, a[1].value, a[2].value); }

/// Returns an answer that covers all directions of the normal f₁ × f₂ if f₁ × f₂ may be 0; otherwise returns nothing.
/// Force and block are those of ψ without J. The scales cover the terms with J, whose direction is unknown. With b = ∇N
/// of the own corner and t = b₁ f₂ − b₂ f₁, these terms are at most
///
///  - A (λ + 2μ) ‖t‖ in the force,
///  - A (μ ‖b‖² + (λ + μ) ‖t‖²) in the block.
///
/// Both limits are enlarged by a hundredth, because J is not quite 0.
std::optional<ForceAnswer> any_normal(const Question& q) {
  const Inputs& inputs = q.inputs;
  const MembraneTermOf<Input>& term = q.term;
  const auto& f = q.at.f;
  const auto values = [](const Triple<ByOwnTwice<Input>>& a) -> Triple<Input> {
    return {a[0].value, a[1].value, a[2].value};
  };
  const Triple<Input> first = values(f[0]), second = values(f[1]), normal = cross(first, second);
  constexpr double u = compare::unit_roundoff;
  const double doubt = compare::neo_hookean_grey * u * inputs.condition(normal);
  if (length(normal) > 2 * doubt) return std::nullopt;
  const std::array<Input, 2>& own = term.gradient[0];
  const Triple<Input> t = own[0] * second - own[1] * first;
  const double reach = length(t) + compare::neo_hookean_grey * u * inputs.condition(t);
  const Input slope = own[0] * own[0] + own[1] * own[1];
  VertexSystemOf<Input> flat;
  add_force(0.5 * term.area * term.mu, (dot(f[0], f[0]) + dot(f[1], f[1])).slope, flat);
  add_identity(term.area * term.mu * slope, flat.block);
  ForceAnswer result = answer(inputs, flat);
  const double area = 1.01 * term.area.value, lambda = term.lambda.value, mu = term.mu.value;
  result.force_scale += area * (lambda + 2 * mu) * reach / (u * compare::neo_hookean_force_tolerance);
  result.block_scale += area * (mu * slope.value + (lambda + mu) * reach * reach) /
                        (u * compare::neo_hookean_block_tolerance);
  return result;
}

/// Tolerances and rules of the stage that depend on the membrane model.
struct ModelRules {
  double force_tolerance = compare::membrane_force_tolerance, block_tolerance = compare::membrane_block_tolerance;
  bool needs_normal = false;  ///< whether a collapsed triangle gets the answer of any_normal
};

ModelRules rules_of(MembraneModel model) {
  switch (model) {
    case MembraneModel::none:
    case MembraneModel::st_venant_kirchhoff: break;
    case MembraneModel::stable_neo_hookean:
      return {compare::neo_hookean_force_tolerance, compare::neo_hookean_block_tolerance, true};
  }
  return {};
}

ForceAnswer in_units_of_model(const ModelRules& rules, const ForceAnswer& answer) {
  return with_units(answer, rules.force_tolerance / compare::membrane_force_tolerance,
                    rules.block_tolerance / compare::membrane_block_tolerance);
}

std::vector<ForceAnswer> damped_by_strain(const Question& q, const ModelRules& rules,
                                          const std::optional<ForceAnswer>& any) {
  VertexSystemOf<Input> all, damping;
  add_elastic(q.term, q.at, all);
  add_damping(q.term, q.at, all);
  std::vector answers{in_units_of_model(rules, answer(q.inputs, all))};
  if (!any) return answers;
  add_damping(q.term, q.at, damping);
  answers.push_back(in_units_of_model(rules, sum(*any, answer(q.inputs, damping))));
  return answers;
}

/// Adapts the error scales to damping by vertex. The damping force is the block times `moved`, so its tolerance is the
/// block's tolerance plus per_vertex_additions.
ForceAnswer with_vertex_units(const ModelRules& rules, const ForceAnswer& answer) {
  return with_units(answer, (rules.block_tolerance + compare::per_vertex_additions) / compare::membrane_force_tolerance,
                    rules.block_tolerance / compare::membrane_block_tolerance);
}

std::vector<ForceAnswer> damped_by_motion(const Question& q, const ModelRules& rules, std::optional<ForceAnswer> any,
                                          const Triple<Input>& moved) {
  VertexSystemOf<Input> elastic;
  add_elastic(q.term, q.at, elastic);
  std::vector answers{with_vertex_units(rules, damped_by_vertex(q.inputs, elastic, q.term.damping, moved))};
  if (!any) return answers;
  // An upper limit of the block's norm: the norm of any->block plus its error.
  constexpr double u = compare::unit_roundoff;
  const double largest = std::hypot(any->block[0], any->block[3], any->block[5]) +
                         rules.block_tolerance * u * any->block_scale;
  any->force_scale += q.term.damping.value * largest * length(moved) / (u * rules.force_tolerance);
  any->block_scale += q.term.damping.value * largest / (u * rules.block_tolerance);
  answers.push_back(with_vertex_units(rules, *any));
  return answers;
}

}  // namespace

std::vector<ForceAnswer> membrane(const compare::MembraneCase& asked) {
  if (asked.model == MembraneModel::none) return {ForceAnswer{}};
  Question q(asked);
  const ModelRules rules = rules_of(asked.model);
  const std::optional<ForceAnswer> any = rules.needs_normal ? any_normal(q) : std::nullopt;
  std::vector<ForceAnswer> answers;
  switch (asked.damping_form) {
    case DampingForm::strain: answers = damped_by_strain(q, rules, any); break;
    case DampingForm::per_vertex:
      answers = damped_by_motion(q, rules, any, q.inputs.vector(asked.corner[0], asked.start[0]));
      break;
  }
  return answers;
}

compare::ForceTruth membrane(const compare::MembraneIn& in) {
  return for_all(in.cases, [](const compare::MembraneCase& question) { return membrane(question); });
}

}  // namespace ogc::reference
