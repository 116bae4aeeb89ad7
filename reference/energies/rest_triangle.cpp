#include <cmath>

#include "reference/energies/membrane.hpp"
#include "reference/energies/rest_builder.hpp"

namespace ogc::reference {
namespace {

template <class T>
T area_of(const Point<T>& normal) {
  using std::sqrt;
  return T(0.5) * sqrt(dot(normal, normal));
}

/// A triangle as polynomials of its coordinates: e = x1 − x0, n = e × (x2 − x0).
template <class T>
struct Shape {
  Point<T> edge, normal, across[2];  ///< across[k]: the edge opposite to corner k + 1, from its first end to its second

  Shape(const Point<T>& x0, const Point<T>& x1, const Point<T>& x2)
      : edge(x1 - x0), normal(cross(edge, x2 - x0)), across{x0 - x2, x1 - x0} {}
};

/// Returns ∇N of corner k + 1, which is n × (edge opposite to this corner)/‖n‖², as its components along e and n × e.
template <class T>
auto gradient(const Shape<T>& shape, std::size_t k) {
  using std::sqrt;
  const Point<T> slope = cross(shape.normal, shape.across[k]);
  const auto nn = number(dot(shape.normal, shape.normal)), ee = number(dot(shape.edge, shape.edge));
  const auto first = number(dot(slope, shape.edge)), second = number(dot(slope, cross(shape.normal, shape.edge)));
  const auto along_edge = first / (nn * sqrt(ee)), above = second / (nn * sqrt(nn * ee));
  return std::array{along_edge, above};
}

void add_triangle(RestBuilder& to, compare::Index t, compare::Index number_of_body) {
  const compare::Triangle& corners = to.scene.mesh.triangles[static_cast<std::size_t>(t)];
  const compare::Vec3 &x0 = to.at(corners[0]), &x1 = to.at(corners[1]), &x2 = to.at(corners[2]);
  const compare::Material& material = to.body(number_of_body).material;
  const Shape<Exact> shape(exact(x0), exact(x1), exact(x2));
  Inputs inputs;
  const Shape<Input> reacting(Point<Input>{}, input(inputs, x1, x0), input(inputs, x2, x0));
  const long double area = std::sqrt(number(dot(shape.normal, shape.normal))) / 2;
  const double area_scale = unit_of(inputs, area_of(reacting.normal));
  to.add_mass(corners, material.density, area, area_scale);
  if (material.membrane == compare::MembraneModel::none) return;
  compare::RestTriangle triangle{corners, number_of_body, static_cast<float>(area), {}};
  std::array<std::array<double, 2>, 2> gradients{};
  std::array<double, 2> scales{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto value = gradient(shape, k);
    scales[k] = inputs.condition(gradient(reacting, k));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      triangle.gradient[k][axis] = static_cast<float>(value[axis]);
      gradients[k][axis] = static_cast<double>(value[axis]);
    }
  }
  to.truth.exact.triangles.push_back(triangle);
  to.truth.area.push_back(static_cast<double>(area));
  to.truth.area_scale.push_back(area_scale);
  to.truth.gradient.push_back(gradients);
  to.truth.gradient_scale.push_back(scales);
}

}  // namespace

void add_triangles_at_rest(RestBuilder& to) {
  for (std::size_t b = 0; b < to.scene.bodies.size(); ++b) {
    const compare::Body& body = to.scene.bodies[b];
    if (body.fixed || body.is_solid()) continue;
    for (compare::Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
      add_triangle(to, t, static_cast<compare::Index>(b));
  }
}

}  // namespace ogc::reference
