#include "reference/energies/membrane.hpp"

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
        area(inputs.number(q.area)), lambda(inputs.number(q.lame_lambda)), mu(inputs.number(q.lame_mu)), damping(inputs.number(q.damping)) {
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

/// ∂²ψ/∂G² contracted with the derivatives of G.
void add_material(Block& block, const Stencil& s, const Strain<ByVertex>& g) {
  Strain<ByStrainTwice> variable;
  for (std::size_t i = 0; i < 3; ++i) variable[i] = ByStrainTwice(ByStrain(g[i].value, i), i);
  const ByStrainTwice psi = density(variable, ByStrainTwice(ByStrain(s.lambda)), ByStrainTwice(ByStrain(s.mu)));
  const Input weight = s.area * (Input(1.0) + s.damping);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) add_outer(block, weight * psi.slope[i].slope[j], g[i], g[j]);
}

/// The elastic stress contracted with ∂²G/∂x²: a multiple of the identity, so that one coordinate tells it.
Input geometric_stiffness(const Stencil& s, const Strain<ByVertex>& g) {
  Strain<ByStrain> variable;
  for (std::size_t i = 0; i < 3; ++i) variable[i] = ByStrain(g[i].value, i);
  const ByStrain psi = density(variable, ByStrain(s.lambda), ByStrain(s.mu));
  const AlongTwice zero(Along(Input(0.0))), moving(Along(Input(0.0), 0), 0);
  const auto constant = [](const Triple<Input>& p) -> Triple<AlongTwice> { return {AlongTwice(Along(p[0])), AlongTwice(Along(p[1])), AlongTwice(Along(p[2]))}; };
  const Strain<AlongTwice> moved = strain<AlongTwice>({Triple<AlongTwice>{moving, zero, zero}, constant(s.to[0]), constant(s.to[1])}, s.gradients<AlongTwice>());
  Input sum;
  for (std::size_t i = 0; i < 3; ++i) sum = sum + psi.slope[i] * moved[i].slope[0].slope[0];
  return sum;
}

}  // namespace

compare::ForceAnswer membrane(const compare::MembraneCase& question) {
  Inputs inputs;
  const Stencil s(question, inputs);
  const Strain<ByVertex> g = strain<ByVertex>({own_vertex(), fixed(s.to[0]), fixed(s.to[1])}, s.gradients<ByVertex>());
  const Strain<Input> start = strain<Input>({Triple<Input>{}, s.to_start[0], s.to_start[1]}, s.gradient);
  const Strain<ByVertex> change{g[0] - ByVertex(start[0]), g[1] - ByVertex(start[1]), g[2] - ByVertex(start[2])};
  const ByVertex lambda(s.lambda), mu(s.mu);
  const ByVertex energy = ByVertex(s.area) * (density(g, lambda, mu) + ByVertex(s.damping) * density(change, lambda, mu));
  Block block;
  add_material(block, s, g);
  add_identity(block, s.area * positive_part(geometric_stiffness(s, g)));
  return answer(inputs, energy, block);
}

compare::ForceTruth membrane(const compare::MembraneIn& in) {
  return for_all(in.cases, [](const compare::MembraneCase& question) { return std::vector{membrane(question)}; });
}

}  // namespace ogc::reference
