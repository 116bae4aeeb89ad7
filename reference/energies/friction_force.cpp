#include "reference/energies/friction_force.hpp"

#include "reference/energies/lagged_friction.hpp"
#include "reference/energies/meeting.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

using ByDistance = Derivative<Input, 1>;

/// Returns λ = −e_k g'(d).
Input normal_force(const Meeting& meeting) {
  const ByDistance d(meeting.acting_distance(meeting.distance), 0);
  return -meeting.energy(d).slope[0];
}

struct Friction {
  compare::ForceAnswer answer;
  bool near_limit = false;  ///< whether ‖u‖ is within near_factor of the slip limit ε
};

/// Returns Σ wᵢ (xᵢ − xᵢᵗ).
Triple<Input> moved_apart(Meeting& meeting, const compare::FrictionForceCase& q) {
  const auto count = static_cast<std::size_t>(vertex_count(q.contact.sides));
  Inputs& inputs = meeting.inputs;
  Triple<Input> moved;
  for (std::size_t k = 0; k < count; ++k)
    moved = moved + meeting.weight[k] * inputs.vector(q.contact.vertex[k], q.start[k]);
  return moved;
}

Friction acting(Meeting meeting, const compare::FrictionForceCase& q) {
  const auto own = static_cast<std::size_t>(q.contact.own);
  Inputs& inputs = meeting.inputs;
  const Triple<Input> moved = moved_apart(meeting, q);
  const Input limit = inputs.number(q.slip_limit), strength = inputs.number(q.friction) * normal_force(meeting);
  const Triple<Input> normal = Input(1.0) / meeting.distance * meeting.separation();
  const auto slip_of = [&](const Input& weight) {
    const Triple<ByVertex> all = fixed(moved) + ByVertex(weight) * own_vertex();
    return all - dot(fixed(normal), all) * fixed(normal);
  };
  const Triple<ByVertex> slip = slip_of(meeting.weight[own]), of_whole = slip_of(1.0);
  const Triple<Input> u{slip[0].value, slip[1].value, slip[2].value};
  const Input y = slip_length(inputs, u, compare::contact_grey), stiffness = strength * slope_over_slip(y, limit);
  const ByVertex energy = chained(Input(strength * lagged_potential(y, limit)), Input(Input(0.5) * stiffness),
                                  dot(slip, slip));
  Block block;
  for (const ByVertex& along : of_whole)
    add_outer(stiffness * meeting.majorant(q.contact), along.slope, along.slope, block);
  compare::ForceAnswer result = answer(inputs, energy, block);
  const double stiff = reach(inputs, {&stiffness, 1});
  add_weight_error(meeting, q.contact, stiff * reach(inputs, u), 2 * stiff, result);
  // If the normal force and the slip u are both 0 (d = r and no slip), the first-order error of their product is 0. The
  // product of their errors remains.
  result.force_scale += compare::contact_grey * compare::unit_roundoff * inputs.condition({&stiffness, 1}) *
                        inputs.condition(u);
  const double pull = q.friction * meeting.slope_doubt(), over_slip = slope_over_slip(y, limit).value;
  result.force_scale += pull * over_slip * reach(inputs, u) /
                        (compare::unit_roundoff * compare::friction_force_tolerance);
  result.block_scale += 2 * pull * over_slip / (compare::unit_roundoff * compare::friction_block_tolerance);
  const Input beyond = y - limit;
  return {result, std::abs(beyond.value) <= compare::near_factor * inputs.condition({&beyond, 1})};
}

/// Returns upper limits of force and block. They follow from f₁ ≤ 1, f₁/y ≤ 2/ε (method.md §4.4) and ‖I − n nᵀ‖ = √2.
compare::ForceAnswer largest(const compare::FrictionForceCase& q, double distance) {
  compare::ForceAnswer bounds;
  const double force = q.friction * largest_slopes(q.contact, distance).first;
  bounds.force_scale = force * units_of_whole(compare::friction_force_tolerance);
  bounds.block_scale = 2 * largest_majorant(q.contact) * std::sqrt(2.0) * force / q.slip_limit *
                       units_of_whole(compare::friction_block_tolerance);
  return bounds;
}

/// Returns the accepted answers of a case. The case has a near decision if a decision of the contact is near, or if the
/// contact acts and ‖u‖ is near the slip limit.
Accepted answers_of(const compare::FrictionForceCase& question, const std::vector<Meeting>& all) {
  bool near = is_near_decision(question.contact, all.front());
  std::vector<compare::ForceAnswer> accepted = answers(
      all, Ends::at_radius, [&](double distance) { return largest(question, distance); },
      [&](const Meeting& meeting) {
        const Friction friction = acting(meeting, question);
        near = near || (&meeting == &all.front() && friction.near_limit);
        return friction.answer;
      });
  return {std::move(accepted), near};
}

}  // namespace

std::vector<compare::ForceAnswer> friction_force(const compare::FrictionForceCase& question) {
  return answers_of(question, meetings(question.contact)).answers;
}

compare::ForceTruth friction_force(const compare::FrictionForceIn& in) {
  return for_all(in.cases, [](const compare::FrictionForceCase& question) {
    return answers_of(question, meetings(question.contact));
  });
}

}  // namespace ogc::reference
