#include "reference/energies/membrane.hpp"

#include <optional>

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"
#include "reference/energies/strain.hpp"

namespace ogc::reference {
namespace {

/// The question as numbers that know their inputs.
struct Stencil {
  std::array<Triple<Input>, 2> to, to_start;
  std::array<std::array<Input, 2>, 3> gradient;
  Input area, lambda, mu, damping;

  Stencil(const compare::MembraneCase& q, Inputs& inputs)
      : to{inputs.vector(q.corner[1], q.corner[0]), inputs.vector(q.corner[2], q.corner[0])},
        to_start{inputs.vector(q.start[1], q.start[0]), inputs.vector(q.start[2], q.start[0])},
        area(inputs.number(q.area)),
        lambda(inputs.number(q.lame_lambda)),
        mu(inputs.number(q.lame_mu)),
        damping(inputs.number(q.damping)) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (std::size_t k = 0; k < 2; ++k) gradient[k + 1][axis] = inputs.number(q.gradient[k][axis]);
      gradient[0][axis] = -gradient[1][axis] - gradient[2][axis];
    }
  }

  /// The gradients as constants of another number type.
  template <class T>
  std::array<std::array<T, 2>, 3> gradients() const {
    std::array<std::array<T, 2>, 3> all;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 2; ++axis) all[k][axis] = T(decltype(T::value)(gradient[k][axis]));
    return all;
  }
};

using ByStrain = Derivative<Input, 3>;
using ByStrainTwice = Derivative<ByStrain, 3>;
/// Along one coordinate of the vertex, twice.
using Along = Derivative<Input, 1>;
using AlongTwice = Derivative<Along, 1>;

/// By two coordinates of the vertex.
using ByVertexTwice = Derivative<ByVertex, 3>;

Triple<ByVertexTwice> fixed_twice(const Triple<Input>& p) {
  return {ByVertexTwice(ByVertex(p[0])), ByVertexTwice(ByVertex(p[1])), ByVertexTwice(ByVertex(p[2]))};
}

/// weight · ∂²ϕ/∂G² contracted with the derivatives of G.
void add_material(Block& block, const Input& weight, const Stencil& s, const Strain<ByVertex>& g) {
  Strain<ByStrainTwice> variable;
  for (std::size_t i = 0; i < 3; ++i) variable[i] = ByStrainTwice(ByStrain(g[i].value, i), i);
  const ByStrainTwice psi = density(variable, ByStrainTwice(ByStrain(s.lambda)), ByStrainTwice(ByStrain(s.mu)));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) add_outer(block, weight * psi.slope[i].slope[j], g[i], g[j]);
}

/// The elastic stress contracted with ∂²G/∂x²: a multiple of the identity, so that one coordinate tells it.
Input geometric_stiffness(const Stencil& s, const Strain<ByVertex>& g) {
  Strain<ByStrain> variable;
  for (std::size_t i = 0; i < 3; ++i) variable[i] = ByStrain(g[i].value, i);
  const ByStrain psi = density(variable, ByStrain(s.lambda), ByStrain(s.mu));
  const AlongTwice zero(Along(Input(0.0))), moving(Along(Input(0.0), 0), 0);
  const auto constant = [](const Triple<Input>& p) -> Triple<AlongTwice> {
    return {AlongTwice(Along(p[0])), AlongTwice(Along(p[1])), AlongTwice(Along(p[2]))};
  };
  const Strain<AlongTwice> moved = strain(deformation<AlongTwice>(
      {Triple<AlongTwice>{moving, zero, zero}, constant(s.to[0]), constant(s.to[1])}, s.gradients<AlongTwice>()));
  Input sum;
  for (std::size_t i = 0; i < 3; ++i) sum = sum + psi.slope[i] * moved[i].slope[0].slope[0];
  return sum;
}

/// ∂²ψ/∂x₀² of the stable Neo-Hookean energy, with its eigenvalue along the normal as max(0, ·).
Block neo_hookean_block(const Stencil& s, const Triple<Input>& normal) {
  Triple<ByVertexTwice> moving;
  for (std::size_t i = 0; i < 3; ++i) moving[i] = ByVertexTwice(ByVertex(Input(0.0), i), i);
  const auto f = deformation<ByVertexTwice>({moving, fixed_twice(s.to[0]), fixed_twice(s.to[1])},
                                            s.gradients<ByVertexTwice>());
  const auto psi = neo_hookean_density(f, ByVertexTwice(ByVertex(s.lambda)), ByVertexTwice(ByVertex(s.mu)));
  Block block;
  Input along;
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Input& second = psi.slope[i].slope[j];
      along = along + normal[i] * second * normal[j];
      if (j >= i) block[k++] = s.area * second;
    }
  const Input raised = s.area * (positive_part(along) - along);
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j, ++k) block[k] = block[k] + raised * normal[i] * normal[j];
  return block;
}

struct Part {
  ByVertex energy;
  Block block;
};

Triple<Input> values(const Triple<ByVertex>& a) { return {a[0].value, a[1].value, a[2].value}; }

Part elastic(const compare::MembraneCase& q, const Stencil& s, const Deformation<ByVertex>& f,
             const Strain<ByVertex>& g) {
  Part result;
  const ByVertex lambda(s.lambda), mu(s.mu);
  if (q.model == compare::MembraneModel::st_venant_kirchhoff) {
    result.energy = ByVertex(s.area) * density(g, lambda, mu);
    add_material(result.block, s.area, s, g);
    add_identity(result.block, s.area * positive_part(geometric_stiffness(s, g)));
  } else {
    const Triple<Input> normal = cross(values(f[0]), values(f[1]));
    const Input length = sqrt(dot(normal, normal));
    const Triple<Input> unit = length.value > 0 ? Input(1.0) / length * normal : Triple<Input>{};
    result.energy = ByVertex(s.area) * neo_hookean_density(f, lambda, mu);
    result.block = neo_hookean_block(s, unit);
  }
  return result;
}

double length(const Triple<Input>& a) { return std::hypot(a[0].value, a[1].value, a[2].value); }

/// Where f₁ × f₂ cannot be told from 0: ψ without J, the rest is of unknown direction and at most A (λ + 2μ) t in the
/// force, A (μ b² + (λ + μ) t²) in the block. Empty elsewhere. Both a hundredth larger, for J is not quite 0.
std::optional<compare::ForceAnswer> any_normal(const Inputs& inputs, const Stencil& s, const Deformation<ByVertex>& f) {
  const Triple<Input> first = values(f[0]), second = values(f[1]), normal = cross(first, second);
  constexpr double u = compare::unit_roundoff;
  const double doubt = compare::neo_hookean_grey * u * inputs.condition(normal);
  if (length(normal) > 2 * doubt) return std::nullopt;
  const Triple<Input> t = s.gradient[0][0] * second - s.gradient[0][1] * first;
  const double reach = length(t) + compare::neo_hookean_grey * u * inputs.condition(t);
  const Input slope = s.gradient[0][0] * s.gradient[0][0] + s.gradient[0][1] * s.gradient[0][1];
  const ByVertex energy = ByVertex(Input(0.5) * s.area * s.mu) * (dot(f[0], f[0]) + dot(f[1], f[1]));
  Block block;
  add_identity(block, s.area * s.mu * slope);
  compare::ForceAnswer result = answer(inputs, energy, block);
  const double area = 1.01 * s.area.value, lambda = s.lambda.value, mu = s.mu.value;
  result.force_scale += area * (lambda + 2 * mu) * reach / (u * compare::neo_hookean_force_tolerance);
  result.block_scale += area * (mu * slope.value + (lambda + mu) * reach * reach) /
                        (u * compare::neo_hookean_block_tolerance);
  return result;
}

constexpr double force_units = compare::neo_hookean_force_tolerance / compare::membrane_force_tolerance;
constexpr double block_units = compare::neo_hookean_block_tolerance / compare::membrane_block_tolerance;

compare::ForceAnswer in_units_of_model(compare::MembraneModel model, const compare::ForceAnswer& answer) {
  return model == compare::MembraneModel::st_venant_kirchhoff ? answer : with_units(answer, force_units, block_units);
}

/// A k ϕ(G − Gᵗ).
Part damping_of_strain(const Stencil& s, const Strain<ByVertex>& g) {
  const Strain<Input> start = strain(deformation<Input>({Triple<Input>{}, s.to_start[0], s.to_start[1]}, s.gradient));
  const Strain<ByVertex> change{g[0] - ByVertex(start[0]), g[1] - ByVertex(start[1]), g[2] - ByVertex(start[2])};
  const Input weight = s.area * s.damping;
  Part result{ByVertex(weight) * density(change, ByVertex(s.lambda), ByVertex(s.mu)), {}};
  add_material(result.block, weight, s, g);
  return result;
}

Part both(Part a, const Part& b) {
  a.energy = a.energy + b.energy;
  for (std::size_t k = 0; k < 6; ++k) a.block[k] = a.block[k] + b.block[k];
  return a;
}

/// The force reaches farther than without: B moved is known as well as B.
compare::ForceAnswer with_vertex_units(const compare::MembraneCase& q, const compare::ForceAnswer& answer) {
  const bool neo_hookean = q.model == compare::MembraneModel::stable_neo_hookean;
  const double block = neo_hookean ? compare::neo_hookean_block_tolerance : compare::membrane_block_tolerance;
  return with_units(answer, (block + compare::per_vertex_additions) / compare::membrane_force_tolerance,
                    neo_hookean ? block_units : 1);
}

}  // namespace

std::vector<compare::ForceAnswer> membrane(const compare::MembraneCase& question) {
  if (question.model == compare::MembraneModel::none) return {compare::ForceAnswer{}};
  Inputs inputs;
  const Stencil s(question, inputs);
  const auto f = deformation<ByVertex>({own_vertex(), fixed(s.to[0]), fixed(s.to[1])}, s.gradients<ByVertex>());
  const Strain<ByVertex> g = strain(f);
  const Part exact = elastic(question, s, f, g);
  const bool neo_hookean = question.model == compare::MembraneModel::stable_neo_hookean;
  std::optional<compare::ForceAnswer> any = neo_hookean ? any_normal(inputs, s, f) : std::nullopt;
  if (question.damping_form == compare::DampingForm::per_vertex) {
    const Triple<Input> moved = inputs.vector(question.corner[0], question.start[0]);
    std::vector answers{
        with_vertex_units(question, damped_by_vertex(inputs, exact.energy, exact.block, s.damping, moved))};
    if (!any) return answers;
    // Whatever the block is, it is no larger than its center and its scale together.
    const double largest = std::hypot(any->block[0], any->block[3], any->block[5]) +
                           compare::neo_hookean_block_tolerance * compare::unit_roundoff * any->block_scale;
    any->force_scale += s.damping.value * largest * length(moved) /
                        (compare::unit_roundoff * compare::neo_hookean_force_tolerance);
    any->block_scale += s.damping.value * largest / (compare::unit_roundoff * compare::neo_hookean_block_tolerance);
    answers.push_back(with_vertex_units(question, *any));
    return answers;
  }
  const Part damping = damping_of_strain(s, g), all = both(exact, damping);
  std::vector answers{in_units_of_model(question.model, answer(inputs, all.energy, all.block))};
  if (any)
    answers.push_back(in_units_of_model(question.model, sum(*any, answer(inputs, damping.energy, damping.block))));
  return answers;
}

compare::ForceTruth membrane(const compare::MembraneIn& in) {
  return for_all(in.cases, [](const compare::MembraneCase& question) { return membrane(question); });
}

}  // namespace ogc::reference
