#include "reference/energies/rods/rod.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"
#include "reference/energies/rods/rod_terms.hpp"

namespace ogc::reference {
namespace {

FourOf<Input> given(Inputs& inputs, const compare::Quaternion& q) {
  return {inputs.number(q[0]), inputs.number(q[1]), inputs.number(q[2]), inputs.number(q[3])};
}

/// Holds a segment in Input numbers. The variable is the position of the segment's end `own`.
struct Segment {
  Inputs inputs;
  FourOf<Input> q, start;
  Triple<ByOwnTwice<Input>> apart;  ///< D, the vector from end 0 to end 1
  Triple<Input> before;             ///< D at the start of the step
  Input length, stretch, damping;

  explicit Segment(const compare::RodCase& c)
      : q(given(inputs, c.orientation)),
        start(given(inputs, c.orientation_start)),
        before(inputs.vector(c.start[1], c.start[0])),
        length(inputs.number(c.rest_length)),
        stretch(inputs.number(c.stretch)),
        damping(inputs.number(c.damping)) {
    const Triple<Input> now = inputs.vector(c.vertex[1], c.vertex[0]);
    const Input side(c.own == 1 ? 1.0 : -1.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
      apart[axis] = ByOwnTwice<Input>(now[axis]) + side * variable(Input(0.0), axis);
  }

  ByOwnTwice<Input> elastic() const {
    const Triple<Input> director = rotated(q, own_axis<Input>());
    Triple<ByOwnTwice<Input>> strain;
    for (std::size_t axis = 0; axis < 3; ++axis)
      strain[axis] = (Input(1.0) / length) * apart[axis] - ByOwnTwice<Input>(director[axis]);
    return stretch_energy(strain, stretch, length);
  }
  /// Returns the damping energy of the change D/l − R(q) R(qᵗ)ᵀ Dᵗ/l, as compare/stages/rod.hpp defines it. The change
  /// of the strain R(q)ᵀ D/l has the same norm only if the quaternions are unit.
  ByOwnTwice<Input> viscous() const {
    const Triple<Input> held = rotated(q, rotated(conjugate(start), before));
    Triple<ByOwnTwice<Input>> change;
    for (std::size_t axis = 0; axis < 3; ++axis)
      change[axis] = (Input(1.0) / length) * (apart[axis] - ByOwnTwice<Input>(held[axis]));
    return damping * stretch_energy(change, stretch, length);
  }
};

}  // namespace

compare::ForceAnswer rod(const compare::RodCase& c) {
  Segment segment(c);
  VertexSystemOf<Input> system;
  compare::ForceAnswer result;
  switch (c.damping_form) {
    case compare::DampingForm::strain:
      add_exactly(segment.elastic() + segment.viscous(), system);
      result = answer(segment.inputs, system);
      break;
    case compare::DampingForm::per_vertex: {
      const auto own = static_cast<std::size_t>(c.own);
      add_exactly(segment.elastic(), system);
      const Triple<Input> moved = segment.inputs.vector(c.vertex[own], c.start[own]);
      result = damped_by_vertex(segment.inputs, system, segment.damping, moved);
      break;
    }
  }
  return result;
}

compare::ForceTruth rod(const compare::RodIn& in) {
  return for_all(in.cases, [](const compare::RodCase& question) { return std::vector{rod(question)}; });
}

}  // namespace ogc::reference
