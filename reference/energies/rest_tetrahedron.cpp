// Computes rest data of tetrahedra.
#include <cmath>

#include "reference/energies/rest_builder.hpp"

namespace ogc::reference {
namespace {

/// A tetrahedron as polynomials of its coordinates. `six_volumes` is 6V. `normal` holds the inward normals n_k of the
/// faces opposite to the corners; ‖n_k‖ is twice the face's area. ∇N_k = n_k/(6V).
template <class T>
struct SolidShape {
  Point<T> normal[4];
  T six_volumes;

  SolidShape(const Point<T>& a, const Point<T>& b, const Point<T>& c)
      : normal{cross(c - a, b - a), cross(b, c), cross(c, a), cross(a, b)}, six_volumes(dot(a, normal[1])) {}

  /// Returns V ∇N_k·∇N_l.
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

void add_rest(compare::TetrahedronKind, RestBuilder& to) {
  for (std::size_t b = 0; b < to.scene.bodies.size(); ++b) {
    const compare::Body& body = to.scene.bodies[b];
    if (body.fixed) continue;
    for (compare::Index t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t)
      add_tetrahedron(to, t, static_cast<compare::Index>(b));
  }
}

}  // namespace ogc::reference
