#include "reference/energies/tetrahedron.hpp"

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"
#include "reference/energies/solid.hpp"

namespace ogc::reference {
namespace {

/// By two coordinates of the vertex.
using ByVertexTwice = Derivative<ByVertex, 3>;
using ByStrain = Derivative<Input, 6>;
using ByStrainTwice = Derivative<ByStrain, 6>;

template <class T>
Triple<T> constant(const Triple<Input>& p) {
  return {T(p[0]), T(p[1]), T(p[2])};
}
template <>
Triple<ByVertexTwice> constant(const Triple<Input>& p) {
  return {ByVertexTwice(ByVertex(p[0])), ByVertexTwice(ByVertex(p[1])), ByVertexTwice(ByVertex(p[2]))};
}

Triple<ByVertexTwice> own_vertex_twice() {
  Triple<ByVertexTwice> own;
  for (std::size_t i = 0; i < 3; ++i) own[i] = ByVertexTwice(ByVertex(Input(0.0), i), i);
  return own;
}

/// The elastic part as numbers that know their inputs; the corner asked about is the origin.
struct Elastic {
  Inputs inputs;
  std::array<Triple<Input>, 4> corner;
  std::array<Input, 3> weight;
  Input inverse, lambda, mu;

  explicit Elastic(const compare::TetrahedronCase& q)
      : corner(inputs.stencil(q.corner, 0)),
        weight{inputs.number(q.weight[0]), inputs.number(q.weight[1]), inputs.number(q.weight[2])},
        inverse(inputs.number(q.inverse)),
        lambda(inputs.number(q.lame_lambda)),
        mu(inputs.number(q.lame_mu)) {}

  /// i det(x₁ − x₀, x₂ − x₀, x₃ − x₀).
  template <class T>
  T ratio(const std::array<Triple<T>, 4>& x) const {
    return T(constant_of<T>(inverse)) * dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]));
  }
  /// What of the energy depends on x₀ [J].
  template <class T>
  T energy(const Triple<T>& own) const {
    const std::array<Triple<T>, 4> x{own, constant<T>(corner[1]), constant<T>(corner[2]), constant<T>(corner[3])};
    const T volume = constant_of<T>(Input(1.0) / (Input(6.0) * inverse)), one = constant_of<T>(Input(1.0)),
            half = constant_of<T>(Input(0.5)), grown = ratio(x) - one;
    T stretch;
    for (std::size_t k = 0; k < 3; ++k) {
      const Triple<T> to = x[k + 1] - x[0];
      stretch = stretch - half * constant_of<T>(weight[k]) * dot(to, to);
    }
    return constant_of<T>(mu) * (stretch - volume * grown) +
           half * constant_of<T>(lambda + mu) * volume * grown * grown;
  }
  Block block() const {
    const ByVertexTwice psi = energy<ByVertexTwice>(own_vertex_twice());
    Block result;
    for (std::size_t i = 0, k = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j, ++k) result[k] = psi.slope[i].slope[j];
    return result;
  }

 private:
  template <class T>
  static T constant_of(const Input& x) {
    if constexpr (std::is_same_v<T, ByVertexTwice>)
      return ByVertexTwice(ByVertex(x));
    else
      return T(x);
  }
};

/// What of J and of the normal is lost where both nearly vanish, beyond the first order: their errors, of 12 and 6
/// units (compare/stages/tetrahedron.hpp), meet. `resisted`: k ‖moved‖ of damping by vertex, whose block is `grown`
/// times the elastic one.
compare::ForceAnswer with_second_order(const Elastic& elastic, compare::ForceAnswer answer, double resisted = 0,
                                       double grown = 1) {
  constexpr double u = compare::unit_roundoff, ratio_units = 12, normal_units = 6;
  const auto& x = elastic.corner;
  const double normal = normal_units * u * elastic.inputs.condition(cross(x[2] - x[1], x[3] - x[1]));
  const Input ratio = elastic.ratio(x);
  const double of_ratio = ratio_units * u * elastic.inputs.condition({&ratio, 1});
  const double bulk = (elastic.lambda.value + elastic.mu.value) / 6;
  const double block = bulk * elastic.inverse.value * normal * normal;
  answer.force_scale += (bulk * of_ratio * normal + resisted * block) / (compare::tetrahedron_force_tolerance * u);
  answer.block_scale += grown * block / (compare::tetrahedron_block_tolerance * u);
  return answer;
}

/// Gᵗ, and the unit of each component's error.
std::array<std::pair<double, double>, 6> strain_at_start(const compare::TetrahedronCase& q) {
  Inputs inputs;
  const std::array<Triple<Input>, 4> x = inputs.stencil(q.start, 0);
  std::array<std::array<Input, 3>, 4> gradient;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 1; k < 4; ++k) {
      gradient[k][axis] = inputs.number(q.gradient[k - 1][axis]);
      gradient[0][axis] = gradient[0][axis] - gradient[k][axis];
    }
  const SolidStrain<Input> strain = solid_strain(solid_deformation<Input>(x, gradient));
  std::array<std::pair<double, double>, 6> result;
  for (std::size_t i = 0; i < 6; ++i)
    result[i] = {strain[i].value, std::max(std::abs(strain[i].value), inputs.condition({&strain[i], 1}))};
  return result;
}

/// V k ϕ(G − Gᵗ) and its block.
compare::ForceAnswer damping_of_strain(const compare::TetrahedronCase& q) {
  Inputs inputs;
  const std::array<Triple<Input>, 4> corner = inputs.stencil(q.corner, 0);
  std::array<std::array<ByVertex, 3>, 4> gradient;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 1; k < 4; ++k) {
      gradient[k][axis] = ByVertex(inputs.number(q.gradient[k - 1][axis]));
      gradient[0][axis] = gradient[0][axis] - gradient[k][axis];
    }
  const Input weight = inputs.number(q.volume) * inputs.number(q.damping), lambda = inputs.number(q.lame_lambda),
              mu = inputs.number(q.lame_mu);
  const SolidStrain<ByVertex> g = solid_strain(
      solid_deformation<ByVertex>({own_vertex(), fixed(corner[1]), fixed(corner[2]), fixed(corner[3])}, gradient));
  const auto start = strain_at_start(q);
  SolidStrain<ByVertex> change;
  SolidStrain<ByStrainTwice> variable;
  for (std::size_t i = 0; i < 6; ++i) {
    change[i] = g[i] - ByVertex(inputs.number(start[i].first, start[i].second));
    variable[i] = ByStrainTwice(ByStrain(change[i].value, i), i);
  }
  const ByVertex energy = ByVertex(weight) * solid_quadratic(change, ByVertex(lambda), ByVertex(mu));
  const ByStrainTwice psi = solid_quadratic(variable, ByStrainTwice(ByStrain(lambda)), ByStrainTwice(ByStrain(mu)));
  Block block;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) add_outer(block, weight * psi.slope[i].slope[j], g[i], g[j]);
  return with_units(answer(inputs, energy, block),
                    compare::tetrahedron_damping_force_tolerance / compare::tetrahedron_force_tolerance,
                    compare::tetrahedron_damping_block_tolerance / compare::tetrahedron_block_tolerance);
}

}  // namespace

compare::ForceAnswer tetrahedron(const compare::TetrahedronCase& q) {
  Elastic elastic(q);
  const ByVertex energy = elastic.energy<ByVertex>(own_vertex());
  const Block block = elastic.block();
  if (q.damping_form == compare::DampingForm::per_vertex) {
    const Triple<Input> moved = elastic.inputs.vector(q.corner[0], q.start[0]);
    const Input damping = elastic.inputs.number(q.damping);
    const double units = (compare::tetrahedron_block_tolerance + compare::per_vertex_additions) /
                         compare::tetrahedron_force_tolerance;
    const double distance = std::hypot(moved[0].value, moved[1].value, moved[2].value);
    return with_second_order(elastic,
                             with_units(damped_by_vertex(elastic.inputs, energy, block, damping, moved), units, 1),
                             q.damping * distance, 1 + q.damping);
  }
  const compare::ForceAnswer undamped = with_second_order(elastic, answer(elastic.inputs, energy, block));
  return q.damping == 0 ? undamped : sum(undamped, damping_of_strain(q));
}

compare::ForceTruth tetrahedron(const compare::TetrahedronIn& in) {
  return for_all(in.cases, [](const compare::TetrahedronCase& question) { return std::vector{tetrahedron(question)}; });
}

}  // namespace ogc::reference
