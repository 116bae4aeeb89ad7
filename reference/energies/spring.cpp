#include "reference/energies/spring.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

/// The vector Σ wᵢ xᵢ now and at the start of the step, relative to the own vertex.
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

/// Returns an error of a stitch's block that first-order errors do not include [N/m]. The vector Σ wᵢ xᵢ of length l
/// has an error of 4 u · condition (u = 2⁻²⁴, compare/stages/spring.hpp).
///
///  - If l is more than twice this error, the tolerances cover the error of 1/l. The result is 0.
///  - Otherwise l₀/l may be anything up to 1. If l₀ > 0, the block may lack all of max(0, 1 − l₀/l)(I − n nᵀ). The
///    result is the norm of this term.
///  - The errors of n and l₀/l that remain are at most √2 l₀/l. The first-order tolerance of 44 u · condition covers
///    44/8 of them, because l is at most 8 u · condition.
double lost_block(const Inputs& inputs, const compare::SpringCase& q, const Separation& ends, const Input& length) {
  if (q.ratio == 0 || q.rest_length == 0) return 0;
  const Triple<Input> apart{ends.apart[0].value, ends.apart[1].value, ends.apart[2].value};
  const double known = 4 * compare::unit_roundoff * inputs.condition(apart);
  if (length.value > 2 * known) return 0;
  const double weight = ends.weight[static_cast<std::size_t>(q.own)].value;
  return std::sqrt(2.0) * weight * weight * q.stiffness * held_across(length, Input(q.rest_length)).value;
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
  SpringTermOf<Input> term;
  term.stiffness = inputs.number(q.stiffness);
  term.rest_length = inputs.number(q.rest_length);
  const Input damping = inputs.number(q.damping), length = sqrt(dot(ends.apart, ends.apart)).value;
  const double force_tolerance = q.ratio > 0 ? compare::stitch_force_tolerance : compare::spring_force_tolerance;
  const double block_tolerance = q.ratio > 0 ? compare::stitch_block_tolerance : compare::spring_block_tolerance;
  const double block_units = block_tolerance / compare::spring_block_tolerance;
  const double lost = lost_block(inputs, q, ends, length);
  VertexSystemOf<Input> system;
  compare::ForceAnswer result;
  switch (q.damping_form) {
    case compare::DampingForm::strain: {
      term.damping = damping;
      term.start = sqrt(dot(ends.before, ends.before));
      add_spring(term, ends.weight[own], ends.apart, system);
      const double units = force_tolerance / compare::spring_force_tolerance;
      result = with_lost(with_units(answer(inputs, system), units, block_units), 0, lost);
      break;
    }
    case compare::DampingForm::per_vertex: {
      add_spring(term, ends.weight[own], ends.apart, system);
      const double units = (block_tolerance + compare::per_vertex_additions) / compare::spring_force_tolerance;
      const Triple<Input> moved = inputs.vector(q.vertex[own], q.start[own]);
      const double distance = sqrt(dot(moved, moved)).value;
      result = with_lost(with_units(damped_by_vertex(inputs, system, damping, moved), units, block_units),
                         q.damping * lost * distance, (1 + q.damping) * lost);
      break;
    }
  }
  return result;
}

compare::ForceTruth spring(const compare::SpringIn& in) {
  return for_all(in.cases, [](const compare::SpringCase& question) { return std::vector{spring(question)}; });
}

}  // namespace ogc::reference
