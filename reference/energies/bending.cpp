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

struct Material {
  Input stiffness, rest_angle, damping;
};

compare::ForceAnswer answer_at(const Inputs& inputs, const Material& m, const ByVertex& angle, const Input& start) {
  const ByVertex bent = angle - ByVertex(m.rest_angle), moved = angle - ByVertex(start);
  const ByVertex energy = ByVertex(Input(0.5) * m.stiffness) * (bent * bent + ByVertex(m.damping) * moved * moved);
  Block block;
  const Input weight = m.stiffness * (Input(1.0) + m.damping);
  add_outer(block, weight, angle, angle);
  compare::ForceAnswer result = answer(inputs, energy, block);
  // Where the gradient vanishes by cancellation, the block, its square, has no first derivative: an error of n u · cond in the gradient is all there is.
  const double gradient = inputs.condition(angle.slope);
  result.block_scale += compare::bending_gradient * compare::unit_roundoff * weight.value * gradient * gradient;
  return result;
}

}  // namespace

std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question) {
  Inputs inputs;
  const Fold<ByVertex> now(now_of(question, inputs));
  const Fold<Input> before(inputs.stencil(question.start, 0));
  const Material material{inputs.number(question.stiffness), inputs.number(question.rest_angle), inputs.number(question.damping)};
  if (now.collapsed()) return {compare::ForceAnswer{}};
  const bool damped = question.damping > 0;
  const std::vector<ByVertex> angles = with_turn(inputs, now.angle());
  std::vector<Input> starts = damped && !before.collapsed() ? with_turn(inputs, before.angle()) : std::vector{Input(0.0)};
  if (damped && !before.collapsed() && before.may_count_as_collapsed()) starts.push_back(Input(0.0));
  std::vector<compare::ForceAnswer> answers;
  for (const ByVertex& angle : angles)
    for (const Input& start : starts) answers.push_back(answer_at(inputs, material, angle, start));
  if (now.may_count_as_collapsed()) answers.push_back({});
  return answers;
}

compare::ForceTruth bending(const compare::BendingIn& in) {
  return for_all(in.cases, [](const compare::BendingCase& question) { return bending(question); });
}

}  // namespace ogc::reference
