#include "reference/energies/bending.hpp"

#include <numbers>
#include <vector>

#include "reference/energies/hinge_terms.hpp"
#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

using compare::BendingModel;
using compare::DampingForm;
using compare::ForceAnswer;

Hinge<ByVertex> now_of(const compare::BendingCase& q, Inputs& inputs) {
  const auto own = static_cast<std::size_t>(q.own);
  const Hinge<Input> relative = inputs.stencil(q.vertex, own);
  Hinge<ByVertex> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = k == own ? own_vertex() : fixed(relative[k]);
  return x;
}

const Input& at_vertex(const ByVertex& x) { return x.value; }
const Input& at_vertex(const Input& x) { return x; }

/// Returns the angle. If rounding could move the angle past ±π, also returns the angle ∓ 2π.
template <class T>
std::vector<T> with_turn(const Inputs& inputs, const T& angle) {
  const Input& value = at_vertex(angle);
  const double doubt = compare::bending_grey * compare::unit_roundoff * inputs.condition({&value, 1});
  if (std::abs(value.value) + doubt < std::numbers::pi) return {angle};
  return {angle, angle + T(Input(value.value > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi))};
}

/// Holds scales of second-order errors of force and block, which remain if the first derivatives are 0:
///  - ∇θ: its error is n u · condition, with n = bending_gradient and u = 2⁻²⁴.
///  - Block: the square of the error of ∇θ, times the curvature ∂²E/∂θ².
///  - Force: the product of the error of ∇θ and the error of the moment ∂E/∂θ. All roundings of the force except those
///    of ∇θ count as roundings of the moment.
struct SecondOrder {
  double force, block;
};

SecondOrder second_order(const Inputs& inputs, const HingeTermOf<Input>& term, const ByVertex& angle) {
  constexpr double moment_share = (compare::bending_force_tolerance - compare::bending_gradient) /
                                  compare::bending_force_tolerance;
  const Second<1, Input> energy = along(angle.value, [&](const Second<1, Input>& a) { return term.energy_of(a); });
  const double gradient = inputs.condition(angle.slope),
               error = compare::bending_gradient * compare::unit_roundoff * gradient;
  return {moment_share * error * inputs.condition(energy.slope), error * energy.bend(0).value * gradient};
}

/// A case of the stage in Input numbers.
struct Question {
  const compare::BendingCase& asked;
  Inputs inputs;
  Hinge<ByVertex> x;
  Fold<Input> before;
  HingeTermOf<Input> term;  ///< includes damping by strain, but not damping by vertex
  Input damping;            ///< k of damping by strain or by vertex
  Triple<Input> moved;      ///< motion of the vertex, for damping by vertex

  explicit Question(const compare::BendingCase& q)
      : asked(q), x(now_of(q, inputs)), before(inputs.stencil(q.start, 0)) {
    term.model = q.model;
    term.stiffness = inputs.number(q.stiffness);
    term.rest_angle = inputs.number(q.rest_angle);
    damping = inputs.number(q.damping);
    const auto own = static_cast<std::size_t>(q.own);
    switch (q.damping_form) {
      case DampingForm::strain: term.damping = damping; break;
      case DampingForm::per_vertex: moved = inputs.vector(q.vertex[own], q.start[own]); break;
    }
  }
  bool by_vertex() const { return !damps_strain(asked.damping_form); }
  /// Returns `term` with the angle θᵗ = `start` at the start of the step.
  HingeTermOf<Input> from(const Input& start) const {
    HingeTermOf<Input> result = term;
    result.start = start;
    return result;
  }
};

/// Returns the answers for all accepted pairs of the present angle and the angle at the start. Adds a zero answer if
/// the hinge may count as collapsed.
template <class AnswerAt>
std::vector<ForceAnswer> over_angles(const Question& q, bool damped, AnswerAt answer_at) {
  const Fold<ByVertex> now(q.x);
  if (now.collapsed()) return {ForceAnswer{}};
  const std::vector<ByVertex> angles = with_turn(q.inputs, now.angle());
  std::vector<Input> starts = damped && !q.before.collapsed() ? with_turn(q.inputs, q.before.angle())
                                                              : std::vector{Input(0.0)};
  if (damped && !q.before.collapsed() && q.before.may_count_as_collapsed()) starts.push_back(Input(0.0));
  std::vector<ForceAnswer> answers;
  for (const ByVertex& angle : angles)
    for (const Input& start : starts) answers.push_back(answer_at(angle, start));
  if (now.may_count_as_collapsed()) answers.push_back({});
  return answers;
}

std::vector<ForceAnswer> hinge_answers(const Question& q) {
  constexpr double vertex_units = (compare::bending_block_tolerance + compare::per_vertex_additions) /
                                  compare::bending_force_tolerance;
  return over_angles(q, (q.term.stiffness * q.term.damping).value > 0, [&](const ByVertex& angle, const Input& start) {
    const HingeTermOf<Input> term = q.from(start);
    VertexSystemOf<Input> system;
    add_angle(term, angle, system);
    const SecondOrder left = second_order(q.inputs, term, angle);
    ForceAnswer result = q.by_vertex() ? damped_by_vertex(q.inputs, system, q.damping, q.moved)
                                       : answer(q.inputs, system);
    result.block_scale += q.by_vertex() ? (1 + q.damping.value) * left.block : left.block;
    result.force_scale += left.force;
    if (!q.by_vertex()) return result;
    result.force_scale += q.damping.value * left.block *
                          std::hypot(q.moved[0].value, q.moved[1].value, q.moved[2].value);
    return with_units(result, vertex_units, 1);
  });
}

std::vector<ForceAnswer> isometric_answers(Question& q) {
  constexpr double force_units = compare::isometric_force_tolerance / compare::bending_force_tolerance;
  constexpr double block_units = compare::isometric_block_tolerance / compare::bending_block_tolerance;
  constexpr double vertex_units = (compare::isometric_block_tolerance + compare::per_vertex_additions) /
                                  compare::bending_force_tolerance;
  for (std::size_t k = 0; k < 3; ++k) q.term.weight[k + 1] = q.inputs.number(q.asked.weight[k]);
  q.term.weight[0] = -q.term.weight[1] - q.term.weight[2] - q.term.weight[3];
  VertexSystemOf<Input> system;
  add_positions(q.term, q.x, system);
  if (q.by_vertex())
    return {with_units(damped_by_vertex(q.inputs, system, q.damping, q.moved), vertex_units, block_units)};
  const ForceAnswer elastic = with_units(answer(q.inputs, system), force_units, block_units);
  if (!q.term.has_angle()) return {elastic};
  std::vector<ForceAnswer> answers = over_angles(q, true, [&](const ByVertex& angle, const Input& start) {
    const HingeTermOf<Input> term = q.from(start);
    VertexSystemOf<Input> damping;
    add_angle(term, angle, damping);
    ForceAnswer result = answer(q.inputs, damping);
    const SecondOrder left = second_order(q.inputs, term, angle);
    result.force_scale += left.force;
    result.block_scale += left.block;
    return result;
  });
  for (ForceAnswer& one : answers) one = sum(one, elastic);
  return answers;
}

}  // namespace

std::vector<ForceAnswer> bending(const compare::BendingCase& asked) {
  Question q(asked);
  switch (asked.model) {
    case BendingModel::none: break;
    case BendingModel::discrete_hinge: return hinge_answers(q);
    case BendingModel::isometric_quadratic: return isometric_answers(q);
  }
  return {ForceAnswer{}};
}

compare::ForceTruth bending(const compare::BendingIn& in) {
  return for_all(in.cases, [](const compare::BendingCase& question) { return bending(question); });
}

}  // namespace ogc::reference
