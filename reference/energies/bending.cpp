#include "reference/energies/bending.hpp"

#include <numbers>
#include <vector>

#include "reference/energies/fold.hpp"
#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

Hinge<ByVertex> now_of(const compare::BendingCase& q, Inputs& inputs) {
  const auto own = static_cast<std::size_t>(q.own);
  const Hinge<Input> relative = inputs.stencil(q.vertex, own);
  Hinge<ByVertex> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = k == own ? own_vertex() : fixed(relative[k]);
  return x;
}

const Input& at_vertex(const ByVertex& x) { return x.value; }
const Input& at_vertex(const Input& x) { return x; }

/// The angle, and where it cannot be told from ±π also the one on the other side.
template <class T>
std::vector<T> with_turn(const Inputs& inputs, const T& angle) {
  const Input& value = at_vertex(angle);
  const double doubt = compare::bending_grey * compare::unit_roundoff * inputs.condition({&value, 1});
  if (std::abs(value.value) + doubt < std::numbers::pi) return {angle};
  return {angle, angle + T(Input(value.value > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi))};
}

/// What of a hinge's angle an energy holds: elastic/2 (θ − θ₀)² + damping/2 (θ − θᵗ)².
struct AngleTerms {
  Input elastic, rest_angle, damping;
};

struct Part {
  ByVertex energy;
  Block block;
};

Part at_angle(const AngleTerms& terms, const ByVertex& angle, const Input& start) {
  const ByVertex bent = angle - ByVertex(terms.rest_angle), moved = angle - ByVertex(start);
  Part part{ByVertex(Input(0.5) * terms.elastic) * bent * bent + ByVertex(Input(0.5) * terms.damping) * moved * moved,
            {}};
  add_outer(part.block, terms.elastic + terms.damping, angle, angle);
  return part;
}

/// What is left of the scales where first derivatives vanish: errors of n u · cond in the gradient, twice in the block,
/// and in the force beside one of the moment, which takes the other roundings of a force.
struct SecondOrder {
  double force, block;
};

SecondOrder second_order(const Inputs& inputs, const AngleTerms& terms, const ByVertex& angle, const Input& start) {
  constexpr double moment_share = (compare::bending_force_tolerance - compare::bending_gradient) /
                                  compare::bending_force_tolerance;
  const Input moment = terms.elastic * (angle.value - terms.rest_angle) + terms.damping * (angle.value - start);
  const double gradient = inputs.condition(angle.slope),
               error = compare::bending_gradient * compare::unit_roundoff * gradient;
  return {moment_share * error * inputs.condition({&moment, 1}),
          error * (terms.elastic.value + terms.damping.value) * gradient};
}

/// What is asked, as numbers that know their inputs.
struct Question {
  const compare::BendingCase& asked;
  Inputs inputs;
  Hinge<ByVertex> x;
  Fold<Input> before;
  Input stiffness, rest_angle, damping;
  Triple<Input> moved;  ///< of the vertex, with damping by vertex

  explicit Question(const compare::BendingCase& q)
      : asked(q),
        x(now_of(q, inputs)),
        before(inputs.stencil(q.start, 0)),
        stiffness(inputs.number(q.stiffness)),
        rest_angle(inputs.number(q.rest_angle)),
        damping(inputs.number(q.damping)) {
    const auto own = static_cast<std::size_t>(q.own);
    if (by_vertex()) moved = inputs.vector(q.vertex[own], q.start[own]);
  }
  bool by_vertex() const { return asked.damping_form == compare::DampingForm::per_vertex; }
};

/// The answers over the angles that are accepted now and at the start, and none where the hinge may count as collapsed.
template <class AnswerAt>
std::vector<compare::ForceAnswer> over_angles(const Question& q, bool damped, AnswerAt answer_at) {
  const Fold<ByVertex> now(q.x);
  if (now.collapsed()) return {compare::ForceAnswer{}};
  const std::vector<ByVertex> angles = with_turn(q.inputs, now.angle());
  std::vector<Input> starts = damped && !q.before.collapsed() ? with_turn(q.inputs, q.before.angle())
                                                              : std::vector{Input(0.0)};
  if (damped && !q.before.collapsed() && q.before.may_count_as_collapsed()) starts.push_back(Input(0.0));
  std::vector<compare::ForceAnswer> answers;
  for (const ByVertex& angle : angles)
    for (const Input& start : starts) answers.push_back(answer_at(angle, start));
  if (now.may_count_as_collapsed()) answers.push_back({});
  return answers;
}

std::vector<compare::ForceAnswer> hinge_answers(const Question& q) {
  const AngleTerms terms{q.stiffness, q.rest_angle, q.by_vertex() ? Input(0.0) : q.stiffness * q.damping};
  constexpr double vertex_units = (compare::bending_block_tolerance + compare::per_vertex_additions) /
                                  compare::bending_force_tolerance;
  return over_angles(q, terms.damping.value > 0, [&](const ByVertex& angle, const Input& start) {
    const Part part = at_angle(terms, angle, start);
    const SecondOrder left = second_order(q.inputs, terms, angle, start);
    compare::ForceAnswer result = q.by_vertex()
                                      ? damped_by_vertex(q.inputs, part.energy, part.block, q.damping, q.moved)
                                      : answer(q.inputs, part.energy, part.block);
    result.block_scale += q.by_vertex() ? (1 + q.damping.value) * left.block : left.block;
    result.force_scale += left.force;
    if (!q.by_vertex()) return result;
    result.force_scale += q.damping.value * left.block *
                          std::hypot(q.moved[0].value, q.moved[1].value, q.moved[2].value);
    return with_units(result, vertex_units, 1);
  });
}

/// c/2 ‖ℓ‖².
Part isometric(Question& q) {
  std::array<Input, 4> weight;
  for (std::size_t k = 0; k < 3; ++k) weight[k + 1] = q.inputs.number(q.asked.weight[k]);
  weight[0] = -weight[1] - weight[2] - weight[3];
  Triple<ByVertex> curvature;
  for (std::size_t k = 0; k < 4; ++k) curvature = curvature + ByVertex(weight[k]) * q.x[k];
  Part part{ByVertex(Input(0.5) * q.stiffness) * dot(curvature, curvature), {}};
  for (const ByVertex& component : curvature) add_outer(part.block, q.stiffness, component, component);
  return part;
}

std::vector<compare::ForceAnswer> isometric_answers(Question& q) {
  constexpr double force_units = compare::isometric_force_tolerance / compare::bending_force_tolerance;
  constexpr double block_units = compare::isometric_block_tolerance / compare::bending_block_tolerance;
  constexpr double vertex_units = (compare::isometric_block_tolerance + compare::per_vertex_additions) /
                                  compare::bending_force_tolerance;
  const Part part = isometric(q);
  if (q.by_vertex())
    return {
        with_units(damped_by_vertex(q.inputs, part.energy, part.block, q.damping, q.moved), vertex_units, block_units)};
  const compare::ForceAnswer elastic = with_units(answer(q.inputs, part.energy, part.block), force_units, block_units);
  if (q.damping.value == 0) return {elastic};
  const AngleTerms terms{Input(0.0), Input(0.0), q.stiffness * q.damping};
  std::vector<compare::ForceAnswer> answers = over_angles(q, true, [&](const ByVertex& angle, const Input& start) {
    const Part damping = at_angle(terms, angle, start);
    compare::ForceAnswer result = answer(q.inputs, damping.energy, damping.block);
    const SecondOrder left = second_order(q.inputs, terms, angle, start);
    result.force_scale += left.force;
    result.block_scale += left.block;
    return result;
  });
  for (compare::ForceAnswer& one : answers) one = sum(one, elastic);
  return answers;
}

}  // namespace

std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question) {
  if (question.model == compare::BendingModel::none) return {compare::ForceAnswer{}};
  Question q(question);
  return question.model == compare::BendingModel::isometric_quadratic ? isometric_answers(q) : hinge_answers(q);
}

compare::ForceTruth bending(const compare::BendingIn& in) {
  return for_all(in.cases, [](const compare::BendingCase& question) { return bending(question); });
}

}  // namespace ogc::reference
