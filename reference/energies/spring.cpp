#include "reference/energies/spring.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

/// k_s (n nᵀ + max(0, 1 − l₀/l)(w² I − n nᵀ)) with n = ∂l/∂x, and w that of x.
Block elastic_block(const ByVertex& length, const Input& weight, const Input& stiffness, const Input& rest_length) {
  Block block;
  const Input across = length.value.value > 0 ? positive_part(Input(1.0) - rest_length / length.value) : Input(rest_length.value > 0 ? 0.0 : 1.0);
  add_identity(block, weight * weight * stiffness * across);
  add_outer(block, stiffness * (Input(1.0) - across), length, length);
  return block;
}

/// Σ wᵢ xᵢ now and at the start, from the vertex asked about.
struct Separation {
  std::array<Input, 3> weight{Input(1.0), Input(-1.0), Input(0.0)};
  Triple<ByVertex> apart;
  Triple<Input> before;

  Separation(Inputs& inputs, const compare::SpringCase& q) {
    if (q.ratio == 0) {
      const auto own = static_cast<std::size_t>(q.own), other = 1 - own;
      apart = own_vertex() - fixed(inputs.vector(q.vertex[other], q.vertex[own]));
      before = inputs.vector(q.start[other], q.start[own]);
      return;
    }
    const Input ratio = inputs.number(q.ratio);
    weight = {Input(1.0), ratio - Input(1.0), -ratio};
    const auto now = inputs.stencil(q.vertex, static_cast<std::size_t>(q.own)), then = inputs.stencil(q.start, static_cast<std::size_t>(q.own));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      apart[axis] = ByVertex(weight[static_cast<std::size_t>(q.own)]) * own_vertex()[axis];
      before[axis] = Input(0.0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == static_cast<std::size_t>(q.own)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = apart[axis] + ByVertex(weight[k] * now[k][axis]);
        before[axis] = before[axis] + weight[k] * then[k][axis];
      }
    }
  }
};

}  // namespace

compare::ForceAnswer spring(const compare::SpringCase& q) {
  Inputs inputs;
  const auto own = static_cast<std::size_t>(q.own);
  const Separation ends(inputs, q);
  const Input stiffness = inputs.number(q.stiffness), rest_length = inputs.number(q.rest_length), damping = inputs.number(q.damping);
  const ByVertex length = sqrt(dot(ends.apart, ends.apart));
  ByVertex energy = spring_energy(length, ByVertex(stiffness), ByVertex(rest_length));
  Block block = elastic_block(length, ends.weight[own], stiffness, rest_length);
  const double force_tolerance = q.ratio > 0 ? compare::stitch_force_tolerance : compare::spring_force_tolerance;
  const double block_tolerance = q.ratio > 0 ? compare::stitch_block_tolerance : compare::spring_block_tolerance;
  const double block_units = block_tolerance / compare::spring_block_tolerance;
  if (q.damping_form == compare::DampingForm::per_vertex) {
    const double units = (block_tolerance + compare::per_vertex_additions) / compare::spring_force_tolerance;
    return with_units(damped_by_vertex(inputs, energy, block, damping, inputs.vector(q.vertex[own], q.start[own])), units, block_units);
  }
  const Input resistance = damping * stiffness;
  energy = energy + spring_energy(length, ByVertex(resistance), ByVertex(sqrt(dot(ends.before, ends.before))));
  add_outer(block, resistance, length, length);
  return with_units(answer(inputs, energy, block), force_tolerance / compare::spring_force_tolerance, block_units);
}

compare::ForceTruth spring(const compare::SpringIn& in) {
  return for_all(in.cases, [](const compare::SpringCase& question) { return std::vector{spring(question)}; });
}

}  // namespace ogc::reference
