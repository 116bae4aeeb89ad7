#include "reference/energies/spring.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

/// k_s (n nᵀ + max(0, 1 − l₀/l)(I − n nᵀ)) with n = ∂l/∂x₀.
Block elastic_block(const ByVertex& length, const Input& stiffness, const Input& rest_length) {
  Block block;
  const Input across = length.value.value > 0 ? positive_part(Input(1.0) - rest_length / length.value) : Input(rest_length.value > 0 ? 0.0 : 1.0);
  add_identity(block, stiffness * across);
  add_outer(block, stiffness * (Input(1.0) - across), length, length);
  return block;
}

}  // namespace

compare::ForceAnswer spring(const compare::SpringCase& q) {
  Inputs inputs;
  const Triple<Input> other = inputs.vector(q.vertex[1], q.vertex[0]), before = inputs.vector(q.start[1], q.start[0]);
  const Input stiffness = inputs.number(q.stiffness), rest_length = inputs.number(q.rest_length), damping = inputs.number(q.damping);
  const Triple<ByVertex> apart = own_vertex() - fixed(other);
  const ByVertex length = sqrt(dot(apart, apart));
  ByVertex energy = spring_energy(length, ByVertex(stiffness), ByVertex(rest_length));
  Block block = elastic_block(length, stiffness, rest_length);
  if (q.damping_form == compare::DampingForm::per_vertex) {
    constexpr double units = (compare::spring_block_tolerance + compare::per_vertex_additions) / compare::spring_force_tolerance;
    return with_units(damped_by_vertex(inputs, energy, block, damping, inputs.vector(q.vertex[0], q.start[0])), units, 1);
  }
  const Input resistance = damping * stiffness;
  energy = energy + spring_energy(length, ByVertex(resistance), ByVertex(sqrt(dot(before, before))));
  add_outer(block, resistance, length, length);
  return answer(inputs, energy, block);
}

compare::ForceTruth spring(const compare::SpringIn& in) {
  return for_all(in.cases, [](const compare::SpringCase& question) { return std::vector{spring(question)}; });
}

}  // namespace ogc::reference
