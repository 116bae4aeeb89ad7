#include "reference/energies/contact_force.hpp"

#include "reference/energies/meeting.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

using ByDistance = Derivative<Input, 1>;
using ByDistanceTwice = Derivative<ByDistance, 1>;

/// Returns the distance d of the contact points with its derivatives by the own vertex's position. `weight` is the own
/// vertex's weight in the contact points.
ByVertex distance_of(const Meeting& meeting, const Input& weight) {
  Triple<ByVertex> apart = fixed(meeting.separation());
  apart = apart + ByVertex(weight) * own_vertex();
  return sqrt(dot(apart, apart));
}

/// g' and g'' [N], [N/m].
struct Slopes {
  Input first, second;
};

Slopes slopes(const Meeting& meeting) {
  // Activations that end flat have exactly 0 curvature at r, but in double the logarithm of r/r is not quite 0.
  if (meeting.is_beyond() && form_of(meeting.activation).ends_flat) return {};
  const ByDistanceTwice variable(ByDistance(meeting.acting_distance(meeting.distance), 0), 0);
  const ByDistanceTwice energy = meeting.energy(variable);
  return {energy.value.slope[0], energy.slope[0].slope[0]};
}

compare::ForceAnswer acting(const Meeting& meeting, const compare::ContactForceCase& question) {
  const ByVertex distance = distance_of(meeting, meeting.weight[static_cast<std::size_t>(question.own)]),
                 of_whole = distance_of(meeting, 1.0);
  const ByVertex energy = meeting.energy(meeting.acting_distance(distance));
  const Slopes at = slopes(meeting);
  Block block;
  add_outer(at.second * meeting.majorant(question), of_whole.slope, of_whole.slope, block);
  compare::ForceAnswer result = answer(meeting.inputs, energy, block);
  result.force_scale += meeting.slope_doubt() / (compare::unit_roundoff * compare::contact_force_tolerance);
  add_weight_error(meeting, question, reach(meeting.inputs, {&at.first, 1}), reach(meeting.inputs, {&at.second, 1}),
                   result);
  return result;
}

compare::ForceAnswer largest(const compare::ContactForceCase& q, double distance) {
  const LargestSlopes slopes = largest_slopes(q, distance);
  compare::ForceAnswer bounds;
  bounds.force_scale = slopes.first * units_of_whole(compare::contact_force_tolerance);
  bounds.block_scale = largest_majorant(q) * slopes.second * units_of_whole(compare::contact_block_tolerance);
  return bounds;
}

std::vector<compare::ForceAnswer> answers_of(const compare::ContactForceCase& question,
                                             const std::vector<Meeting>& all) {
  return answers(
      all, Ends::nowhere, [&](double distance) { return largest(question, distance); },
      [&](const Meeting& meeting) { return acting(meeting, question); });
}

}  // namespace

std::vector<compare::ForceAnswer> contact_force(const compare::ContactForceCase& question) {
  return answers_of(question, meetings(question));
}

compare::ForceTruth contact_force(const compare::ContactForceIn& in) {
  return for_all(in.cases, [](const compare::ContactForceCase& question) -> Accepted {
    const std::vector<Meeting> all = meetings(question);
    return {answers_of(question, all), is_near_decision(question, all.front())};
  });
}

}  // namespace ogc::reference
