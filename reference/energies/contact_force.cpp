#include "reference/energies/contact_force.hpp"

#include "reference/energies/meeting.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

using ByDistance = Derivative<Input, 1>;
using ByDistanceTwice = Derivative<ByDistance, 1>;

/// d as a function of the vertex asked about, at the origin of its displacements.
ByVertex distance_of(const Meeting& meeting, std::size_t own) {
  Triple<ByVertex> apart = fixed(meeting.separation());
  apart = apart + ByVertex(meeting.weight[own]) * own_vertex();
  return sqrt(dot(apart, apart));
}

/// g' and g'' [N], [N/m].
struct Slopes {
  Input first, second;
};

Slopes slopes(const Meeting& meeting) {
  const Input d = meeting.acting_distance(meeting.distance);
  const ByDistanceTwice variable(ByDistance(d, 0), 0);
  const auto constant = [](const Input& x) { return ByDistanceTwice(ByDistance(x)); };
  const ByDistanceTwice energy = activation_energy(compare::ContactActivation::ogc, variable, constant(meeting.radius), constant(meeting.stiffness));
  return {energy.value.slope[0], energy.slope[0].slope[0]};
}

compare::ForceAnswer acting(const Meeting& meeting, std::size_t own) {
  const ByVertex distance = distance_of(meeting, own);
  const ByVertex energy = activation_energy(compare::ContactActivation::ogc, meeting.acting_distance(distance), ByVertex(meeting.radius),
                                            ByVertex(meeting.stiffness));
  const Slopes at = slopes(meeting);
  Block block;
  add_outer(block, at.second, distance, distance);
  compare::ForceAnswer result = answer(meeting.inputs, energy, block);
  add_weight_error(meeting, meeting.weight[own], reach(meeting.inputs, {&at.first, 1}), reach(meeting.inputs, {&at.second, 1}), result);
  return result;
}

/// −g' and g'' at 2⁻²³ r are k_c r 2²¹ and k_c 2⁴⁴.
compare::ForceAnswer largest(const compare::ContactForceCase& q) {
  compare::ForceAnswer bounds;
  bounds.force_scale = 0x1p21 * q.stiffness * q.contact_radius / compare::unit_roundoff;
  bounds.block_scale = 0x1p44 * q.stiffness / compare::unit_roundoff;
  return bounds;
}

}  // namespace

std::vector<compare::ForceAnswer> contact_force(const compare::ContactForceCase& question) {
  const auto own = static_cast<std::size_t>(question.own);
  return answers(meetings(question), largest(question), [&](const Meeting& meeting) { return acting(meeting, own); });
}

compare::ForceTruth contact_force(const compare::ContactForceIn& in) {
  return for_all(in.cases, [](const compare::ContactForceCase& question) { return contact_force(question); });
}

}  // namespace ogc::reference
