// Computes normal force and friction from separate inputs. In friction, the normal force λ is one input, with an error
// of 2⁻²⁴ times its condition.
#include "reference/energies/volume_force.hpp"

#include "reference/energies/lagged_friction.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

/// Returns n as one given vector; its error is 2⁻²⁴ of its length.
Triple<Input> direction_of(Inputs& inputs, const compare::VolumeForceCase& q) {
  return inputs.vector({q.direction[0], q.direction[1], q.direction[2]}, {});
}

/// Returns the frozen weights by vertex with their signs (1, −w₁, −w₂, −w₃).
std::array<Input, 4> weights_of(Inputs& inputs, const compare::VolumeForceCase& q) {
  std::array<Input, 4> weight{Input(1.0)};
  for (std::size_t k = 0; k < 3; ++k) weight[k + 1] = -inputs.number(q.weights[k]);
  return weight;
}

/// The normal force of one contact, computed as if the contact acted (r − φ > 0).
struct Pressed {
  Inputs inputs;
  Input overlap;  ///< r − φ [m]
  ByVertex energy;
  Block block;
  double force = 0, doubt = 0;  ///< λ, and its single-precision error in units of 2⁻²⁴ [N]

  explicit Pressed(const compare::VolumeForceCase& q) {
    const Input radius = inputs.number(q.contact_radius), stiffness = inputs.number(q.stiffness);
    const auto weight = weights_of(inputs, q);
    const Triple<Input> n = direction_of(inputs, q);
    Triple<Input> apart;
    for (std::size_t k = 1; k < 4; ++k) apart = apart - weight[k] * inputs.vector(q.vertex[0], q.vertex[k]);
    overlap = radius - dot(n, apart);
    const ByVertex deeper = ByVertex(overlap) -
                            ByVertex(weight[static_cast<std::size_t>(q.own)]) * dot(fixed(n), own_vertex());
    energy = ByVertex(Input(0.5) * stiffness) * deeper * deeper;
    add_outer(stiffness, deeper.slope, deeper.slope, block);
    const Input lambda = stiffness * overlap;
    force = lambda.value;
    doubt = inputs.condition({&lambda, 1});
  }
  /// Returns |r − φ| in units of 2⁻²⁴ · condition.
  double distance_from_end() const {
    const double size = inputs.condition({&overlap, 1});
    return std::abs(overlap.value) / (compare::unit_roundoff * size);
  }
};

/// The friction of one contact with a known normal force.
struct Rubbed {
  compare::ForceAnswer answer;
  bool near_limit = false;  ///< whether ‖u‖ is within near_factor of the slip limit ε
};

Rubbed rubbed(const compare::VolumeForceCase& q, const Pressed& pressed) {
  Inputs inputs;
  const Input normal_force = inputs.number(pressed.force, pressed.doubt), limit = inputs.number(q.slip_limit),
              strength = inputs.number(q.friction) * normal_force;
  const auto weight = weights_of(inputs, q);
  const Triple<Input> n = direction_of(inputs, q);
  Triple<Input> moved;
  for (std::size_t k = 0; k < 4; ++k) moved = moved + weight[k] * inputs.vector(q.vertex[k], q.start[k]);
  const auto tangential = [&](const Triple<ByVertex>& all) { return all - dot(fixed(n), all) * fixed(n); };
  const ByVertex own_weight(weight[static_cast<std::size_t>(q.own)]);
  const Triple<ByVertex> step = own_weight * own_vertex();
  const Triple<ByVertex> slip = tangential(fixed(moved) + step);
  const Triple<Input> u{slip[0].value, slip[1].value, slip[2].value};
  constexpr double slip_units = 10;  // roundings of the slip, as in volume_force_tolerance
  const Input y = slip_length(inputs, u, slip_units), stiffness = strength * slope_over_slip(y, limit);
  const ByVertex energy = chained(Input(strength * lagged_potential(y, limit)), Input(Input(0.5) * stiffness),
                                  dot(slip, slip));
  Block block;
  // The derivative of the slip is D = w (I − n nᵀ). For a unit vector n, D Dᵀ = w² (I − n nᵀ).
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j, ++k) {
      const Input plane = (i == j ? Input(1.0) : Input(0.0)) - n[i] * n[j];
      block[k] = stiffness * own_weight.value * own_weight.value * plane;
    }
  Rubbed result{answer(inputs, energy, block), false};
  // Adds errors that first-order errors do not include. If the normal force λ and the slip u both vanish, the product
  // of their errors remains. If u may be 0 within rounding, f₁/y may be anything up to 2/ε (y = ‖u‖, ε is the slip
  // limit).
  const double unit = compare::unit_roundoff, w = std::abs(own_weight.value.value),
               doubt_of_force = compare::volume_force_grey * unit * pressed.doubt,
               doubt_of_slip = slip_units * unit * inputs.condition(u),
               steepest = 2 * q.friction * (std::abs(pressed.force) + doubt_of_force) / q.slip_limit;
  const double over_slip = std::abs(slope_over_slip(y, limit).value);
  result.answer.force_scale += q.friction * doubt_of_force * std::min(over_slip * doubt_of_slip, 1.0) * w /
                               (unit * compare::volume_force_tolerance);
  if (y.value <= 2 * doubt_of_slip) {
    result.answer.force_scale += w * std::min(steepest * doubt_of_slip, 2 * q.friction * std::abs(pressed.force)) /
                                 (unit * compare::volume_force_tolerance);
    result.answer.block_scale += std::sqrt(2.0) * w * w * steepest / (unit * compare::volume_block_tolerance);
  }
  const Input beyond = y - limit;
  result.near_limit = std::abs(beyond.value) <= compare::near_factor * inputs.condition({&beyond, 1});
  return result;
}

Accepted answers_of(const compare::VolumeForceCase& q) {
  const Pressed pressed(q);
  const double distance = pressed.distance_from_end();
  const bool acts = pressed.overlap.value > 0, grey = distance <= compare::volume_force_grey;
  bool near = distance * compare::unit_roundoff <= compare::near_factor;
  std::vector<compare::ForceAnswer> accepted;
  if (acts || grey) {
    const Rubbed friction = rubbed(q, pressed);
    accepted.push_back(sum(answer(pressed.inputs, pressed.energy, pressed.block), friction.answer));
    near = near || (acts && friction.near_limit);
  }
  if (!acts || grey) accepted.insert(acts ? accepted.end() : accepted.begin(), compare::ForceAnswer{});
  return {std::move(accepted), near};
}

}  // namespace

std::vector<compare::ForceAnswer> volume_force(const compare::VolumeForceCase& question) {
  return answers_of(question).answers;
}

compare::ForceTruth volume_force(const compare::VolumeForceIn& in) { return for_all(in.cases, answers_of); }

}  // namespace ogc::reference
