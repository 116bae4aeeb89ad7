#include "reference/energies/spring.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

/// max(0, 1 − l₀/l), 1 where l = 0.
Input across_spring(const Input& length, const Input& rest_length) {
  return length.value > 0 ? positive_part(Input(1.0) - rest_length / length) : Input(1.0);
}

/// k_s (n nᵀ + max(0, 1 − l₀/l)(w² I − n nᵀ)) with n = ∂l/∂x, and w that of x.
Block elastic_block(const ByVertex& length, const Input& weight, const Input& stiffness, const Input& rest_length) {
  Block block;
  const Input across = across_spring(length.value, rest_length);
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
    const auto now = inputs.stencil(q.vertex, static_cast<std::size_t>(q.own)),
               then = inputs.stencil(q.start, static_cast<std::size_t>(q.own));
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

/// What the block of a stitch may lack beyond the first order, where its length is lost in the error of Σ wᵢ xᵢ [N/m],
/// which is known to 4 units of u · cond (compare/stages/spring.hpp). Where l is more than twice that, its inverse is
/// known to twice its first order, for which the tolerances have room. Where it is less, l₀/l may come out as anything
/// up to 1: the block may then lack all of max(0, 1 − l₀/l)(I − n nᵀ) if l₀ > 0. What is lost of n, and of l₀/l where l
/// comes out as 0, is at most √2 l₀/l, and the first order accepts 44/8 of it.
double lost_block(const Inputs& inputs, const compare::SpringCase& q, const Separation& ends, const Input& length) {
  if (q.ratio == 0 || q.rest_length == 0) return 0;
  const Triple<Input> apart{ends.apart[0].value, ends.apart[1].value, ends.apart[2].value};
  const double known = 4 * compare::unit_roundoff * inputs.condition(apart);
  if (length.value > 2 * known) return 0;
  const double weight = ends.weight[static_cast<std::size_t>(q.own)].value;
  return std::sqrt(2.0) * weight * weight * q.stiffness * across_spring(length, Input(q.rest_length)).value;
}

compare::ForceAnswer with_lost(compare::ForceAnswer answer, double force, double block) {
  answer.force_scale += force / (compare::spring_force_tolerance * compare::unit_roundoff);
  answer.block_scale += block / (compare::spring_block_tolerance * compare::unit_roundoff);
  return answer;
}

}  // namespace

compare::ForceAnswer spring(const compare::SpringCase& q) {
  Inputs inputs;
  const auto own = static_cast<std::size_t>(q.own);
  const Separation ends(inputs, q);
  const Input stiffness = inputs.number(q.stiffness), rest_length = inputs.number(q.rest_length),
              damping = inputs.number(q.damping);
  const ByVertex length = sqrt(dot(ends.apart, ends.apart));
  ByVertex energy = spring_energy(length, ByVertex(stiffness), ByVertex(rest_length));
  Block block = elastic_block(length, ends.weight[own], stiffness, rest_length);
  const double force_tolerance = q.ratio > 0 ? compare::stitch_force_tolerance : compare::spring_force_tolerance;
  const double block_tolerance = q.ratio > 0 ? compare::stitch_block_tolerance : compare::spring_block_tolerance;
  const double block_units = block_tolerance / compare::spring_block_tolerance;
  const double lost = lost_block(inputs, q, ends, length.value);
  if (q.damping_form == compare::DampingForm::per_vertex) {
    const double units = (block_tolerance + compare::per_vertex_additions) / compare::spring_force_tolerance;
    const Triple<Input> moved = inputs.vector(q.vertex[own], q.start[own]);
    const double distance = sqrt(dot(moved, moved)).value;
    return with_lost(with_units(damped_by_vertex(inputs, energy, block, damping, moved), units, block_units),
                     q.damping * lost * distance, (1 + q.damping) * lost);
  }
  const Input resistance = damping * stiffness;
  energy = energy + spring_energy(length, ByVertex(resistance), ByVertex(sqrt(dot(ends.before, ends.before))));
  add_outer(block, resistance, length, length);
  return with_lost(
      with_units(answer(inputs, energy, block), force_tolerance / compare::spring_force_tolerance, block_units), 0,
      lost);
}

compare::ForceTruth spring(const compare::SpringIn& in) {
  return for_all(in.cases, [](const compare::SpringCase& question) { return std::vector{spring(question)}; });
}

}  // namespace ogc::reference
