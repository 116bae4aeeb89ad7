#include "reference/energies/tetrahedron.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"
#include "reference/energies/rest_builder.hpp"

namespace ogc::reference {
namespace {

/// The elastic energy in Input numbers; the own corner is the origin.
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

  /// Returns J = det(x₁ − x₀, x₂ − x₀, x₃ − x₀)/(6V), where V is the rest volume; `inverse` is 1/(6V).
  template <class T>
  T ratio(const std::array<Triple<T>, 4>& x) const {
    return inverse * dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]));
  }
  /// Returns force and block of the energy terms that depend on x₀.
  VertexSystemOf<Input> system() const {
    using T = ByOwnTwice<Input>;
    const std::array<Triple<T>, 4> x = with_own<T>(corner, 0);
    const Input volume = Input(1.0) / (Input(6.0) * inverse);
    const T grown = ratio(x) - T(1.0);
    T stretch;
    for (std::size_t k = 0; k < 3; ++k) {
      const Triple<T> to = x[k + 1] - x[0];
      stretch = stretch - 0.5 * weight[k] * dot(to, to);
    }
    VertexSystemOf<Input> sum;
    add_exactly(mu * (stretch - volume * grown) + 0.5 * (lambda + mu) * volume * (grown * grown), sum);
    return sum;
  }
};

double length_of(const Triple<Input>& v) { return std::hypot(v[0].value, v[1].value, v[2].value); }

/// Adds errors that the scales Σ ‖∂f/∂q‖ ‖q‖ (Inputs::condition) do not contain:
///  - The edges of the face opposite to the own corner are rounded separately. So the face's normal has an error of 6 u
///    (u = 2⁻²⁴) times the product of the two longest edges, from six roundings. If one corner of the face is far from
///    the others, Inputs::condition gives less than this error. J has this error times the longest distance from the
///    own corner to a corner of the face.
///  - If J − 1 and the normal nearly vanish together, the product of their errors remains
///    (compare/stages/tetrahedron.hpp). J − 1 has twelve roundings, the normal has six.
/// With damping by vertex, `resisted` is k_d/h ‖x − xᵗ‖, and the block is `grown` = 1 + k_d/h times the elastic block.
compare::ForceAnswer with_rounded_edges(const Elastic& elastic, compare::ForceAnswer answer, double resisted = 0,
                                        double grown = 1) {
  constexpr double u = compare::unit_roundoff, ratio_units = 12, normal_units = 6;
  const auto& x = elastic.corner;
  const Triple<Input> normal = cross(x[2] - x[1], x[3] - x[1]);
  std::array<double, 3> edge{length_of(x[2] - x[1]), length_of(x[3] - x[1]), length_of(x[3] - x[2])};
  std::ranges::sort(edge);
  const double farthest = std::max({length_of(x[1] - x[0]), length_of(x[2] - x[0]), length_of(x[3] - x[0])});
  const Input ratio = elastic.ratio(x);
  const double inverse = elastic.inverse.value, bulk = (elastic.lambda.value + elastic.mu.value) / 6;
  const double pull = std::abs(6 * bulk * (ratio.value - 1) - elastic.mu.value) / 6;
  const double of_edges = normal_units * u * edge[1] * edge[2], length = length_of(normal);
  const double of_normal = normal_units * u * elastic.inputs.condition(normal) + of_edges;
  const double of_ratio = ratio_units * u * elastic.inputs.condition({&ratio, 1}) + inverse * farthest * of_edges;
  const double force = pull * of_edges + bulk * inverse * farthest * of_edges * length + bulk * of_ratio * of_normal;
  const double block = bulk * inverse * (2 * length * of_edges + of_normal * of_normal);
  answer.force_scale += (force + resisted * block) / (compare::tetrahedron_force_tolerance * u);
  answer.block_scale += grown * block / (compare::tetrahedron_block_tolerance * u);
  return answer;
}

using Gradients = std::array<std::array<Input, 3>, 4>;

Gradients gradients_of(const compare::TetrahedronCase& q, Inputs& inputs) {
  Gradients gradient;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 1; k < 4; ++k) {
      gradient[k][axis] = inputs.number(q.gradient[k - 1][axis]);
      gradient[0][axis] = gradient[0][axis] - gradient[k][axis];
    }
  return gradient;
}

/// Returns the Green strain Gᵗ at the start of the step; each component is paired with its error scale.
std::array<std::pair<double, double>, 6> strain_at_start(const compare::TetrahedronCase& q) {
  Inputs inputs;
  const std::array<Triple<Input>, 4> x = inputs.stencil(q.start, 0);
  const SolidStrain<Input> strain = solid_strain(solid_deformation<Input>(x, gradients_of(q, inputs)));
  std::array<std::pair<double, double>, 6> result;
  for (std::size_t i = 0; i < 6; ++i)
    result[i] = {strain[i].value, std::max(std::abs(strain[i].value), inputs.condition({&strain[i], 1}))};
  return result;
}

/// Returns force and block of the damping energy V k ϕ(G − Gᵗ).
compare::ForceAnswer damping_of_strain(const compare::TetrahedronCase& q) {
  Inputs inputs;
  const std::array<Triple<Input>, 4> corner = inputs.stencil(q.corner, 0);
  TetrahedronTermOf<Input> term;
  term.gradient = gradients_of(q, inputs);
  term.volume = inputs.number(q.volume);
  term.lambda = inputs.number(q.lame_lambda);
  term.mu = inputs.number(q.lame_mu);
  term.damping = inputs.number(q.damping);
  const auto start = strain_at_start(q);
  for (std::size_t i = 0; i < 6; ++i) term.start[i] = inputs.number(start[i].first, start[i].second);
  VertexSystemOf<Input> sum;
  add_damping(term, TetrahedronCorner<Input>(term, 0, corner), sum);
  return with_units(answer(inputs, sum),
                    compare::tetrahedron_damping_force_tolerance / compare::tetrahedron_force_tolerance,
                    compare::tetrahedron_damping_block_tolerance / compare::tetrahedron_block_tolerance);
}

compare::ForceAnswer damped_by_motion(Elastic& elastic, const compare::TetrahedronCase& q) {
  const Triple<Input> moved = elastic.inputs.vector(q.corner[0], q.start[0]);
  const Input damping = elastic.inputs.number(q.damping);
  const double units = (compare::tetrahedron_block_tolerance + compare::per_vertex_additions) /
                       compare::tetrahedron_force_tolerance;
  const double distance = std::hypot(moved[0].value, moved[1].value, moved[2].value);
  return with_rounded_edges(elastic,
                            with_units(damped_by_vertex(elastic.inputs, elastic.system(), damping, moved), units, 1),
                            q.damping * distance, 1 + q.damping);
}

}  // namespace

compare::ForceAnswer tetrahedron(const compare::TetrahedronCase& q) {
  Elastic elastic(q);
  compare::ForceAnswer result;
  switch (q.damping_form) {
    case compare::DampingForm::strain:
      result = with_rounded_edges(elastic, answer(elastic.inputs, elastic.system()));
      if (q.damping > 0) result = sum(result, damping_of_strain(q));
      break;
    case compare::DampingForm::per_vertex: result = damped_by_motion(elastic, q); break;
  }
  return result;
}

compare::ForceTruth tetrahedron(const compare::TetrahedronIn& in) {
  return for_all(in.cases, [](const compare::TetrahedronCase& question) { return std::vector{tetrahedron(question)}; });
}

namespace {

/// Holds polynomials of a tetrahedron's coordinates: 6V, and for each corner k the inward normal n_k of the opposite
/// face. The length of n_k is twice the face's area, and ∇N_k = n_k/(6V).
template <class T>
struct SolidShape {
  Point<T> normal[4];
  T six_volumes;

  SolidShape(const Point<T>& a, const Point<T>& b, const Point<T>& c)
      : normal{cross(c - a, b - a), cross(b, c), cross(c, a), cross(a, b)}, six_volumes(dot(a, normal[1])) {}

  /// V ∇N_k·∇N_l.
  auto weight(std::size_t k, std::size_t l) const {
    const auto sixth = number(six_volumes);
    return number(dot(normal[k], normal[l])) / (decltype(sixth)(6.0) * sixth);
  }
  auto gradient(std::size_t k) const {
    const auto sixth = number(six_volumes);
    return std::array{decltype(sixth)(number(normal[k].x) / sixth), decltype(sixth)(number(normal[k].y) / sixth),
                      decltype(sixth)(number(normal[k].z) / sixth)};
  }
};

constexpr std::array<std::array<std::size_t, 2>, 6> corner_pairs{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

void add_weights(const SolidShape<Exact>& shape, const SolidShape<Input>& reacting, const Inputs& inputs,
                 compare::RestTetrahedron& rest, compare::RestStateTruth& truth) {
  std::array<double, 6> weights{};
  std::vector<Input> all;
  for (std::size_t i = 0; i < corner_pairs.size(); ++i) {
    const auto [k, l] = corner_pairs[i];
    const long double weight = shape.weight(k, l);
    rest.weight[i] = static_cast<float>(weight);
    weights[i] = static_cast<double>(weight);
    all.push_back(reacting.weight(k, l));
  }
  truth.tetrahedron_weight.push_back(weights);
  truth.tetrahedron_weight_scale.push_back(inputs.condition(all));
}

void add_gradients(const SolidShape<Exact>& shape, const SolidShape<Input>& reacting, const Inputs& inputs,
                   compare::RestTetrahedron& rest, compare::RestStateTruth& truth) {
  std::array<std::array<double, 3>, 3> gradients{};
  std::vector<Input> all;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<long double, 3> gradient = shape.gradient(k + 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rest.gradient[k][axis] = static_cast<float>(gradient[axis]);
      gradients[k][axis] = static_cast<double>(gradient[axis]);
    }
    const std::array<Input, 3> reaction = reacting.gradient(k + 1);
    all.insert(all.end(), reaction.begin(), reaction.end());
  }
  truth.tetrahedron_gradient.push_back(gradients);
  truth.tetrahedron_gradient_scale.push_back(inputs.condition(all));
}

void add_tetrahedron(RestBuilder& to, compare::Index t, compare::Index number_of_body) {
  const compare::Tetrahedron& corners = to.scene.mesh.tetrahedra[static_cast<std::size_t>(t)];
  const compare::Vec3& from = to.at(corners[0]);
  const Point<Exact> origin = exact(from);
  const SolidShape<Exact> shape(exact(to.at(corners[1])) - origin, exact(to.at(corners[2])) - origin,
                                exact(to.at(corners[3])) - origin);
  Inputs inputs;
  const SolidShape<Input> reacting(input(inputs, to.at(corners[1]), from), input(inputs, to.at(corners[2]), from),
                                   input(inputs, to.at(corners[3]), from));
  const long double six_volumes = number(shape.six_volumes), volume = six_volumes / 6;
  const double volume_scale = unit_of(inputs, Input(1.0 / 6) * reacting.six_volumes);
  const double density = to.body(number_of_body).material.solid_density;
  to.add_mass(corners, density, volume, volume_scale);
  compare::RestTetrahedron rest{
      corners, number_of_body, static_cast<float>(volume), static_cast<float>(1 / six_volumes), {}, {}};
  to.truth.volume.push_back(static_cast<double>(volume));
  to.truth.volume_scale.push_back(volume_scale);
  to.truth.inverse.push_back(static_cast<double>(1 / six_volumes));
  to.truth.inverse_scale.push_back(unit_of(inputs, Input(1.0) / reacting.six_volumes));
  add_weights(shape, reacting, inputs, rest, to.truth);
  add_gradients(shape, reacting, inputs, rest, to.truth);
  to.truth.exact.tetrahedra.push_back(rest);
}

}  // namespace

void add_tetrahedra_at_rest(RestBuilder& to) {
  for (std::size_t b = 0; b < to.scene.bodies.size(); ++b) {
    const compare::Body& body = to.scene.bodies[b];
    if (body.fixed) continue;
    for (compare::Index t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t)
      add_tetrahedron(to, t, static_cast<compare::Index>(b));
  }
}

}  // namespace ogc::reference
