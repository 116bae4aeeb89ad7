#include <cmath>

#include "reference/energies/bending.hpp"
#include "reference/energies/rest_builder.hpp"

namespace ogc::reference {
namespace {

template <class T>
struct Fold {
  Point<T> edge, first, second;

  Fold(const Point<T>& x0, const Point<T>& x1, const Point<T>& o0, const Point<T>& o1)
      : edge(x1 - x0), first(cross(edge, o0 - x0)), second(cross(o1 - x0, edge)) {}

  /// Returns the angle from the first normal to the second, positive about the edge: tan θ = (n₀ × n₁)·e / (‖e‖ n₀·n₁).
  auto angle() const {
    using std::atan2, std::sqrt;
    const auto turned = number(dot(cross(first, second), edge)), length = sqrt(number(dot(edge, edge)));
    const auto same = number(dot(first, second)) * length;
    return atan2(turned, same);
  }
  /// Returns 3 ‖e‖²/(A₀ + A₁), with the areas A of both triangles.
  auto factor() const {
    using std::sqrt;
    const auto ee = number(dot(edge, edge)), twice_first = sqrt(number(dot(first, first))),
               twice_second = sqrt(number(dot(second, second)));
    return decltype(ee)(6.0) * ee / (twice_first + twice_second);
  }
  /// Returns the weights of x1, o0, o1: sums of cotangents, divided by the edge's length. Takes the vectors from x0 to
  /// the opposite vertices.
  auto weights(const Point<T>& to_first, const Point<T>& to_second) const {
    using std::sqrt;
    const auto length = sqrt(number(dot(edge, edge))), twice_first = sqrt(number(dot(first, first))),
               twice_second = sqrt(number(dot(second, second)));
    const auto cotangents = number(dot(edge, to_first)) / twice_first + number(dot(edge, to_second)) / twice_second;
    return std::array{decltype(length)(cotangents / length), decltype(length)(-length / twice_first),
                      decltype(length)(-length / twice_second)};
  }
};

/// Sets the weights of the last hinge in `truth`. They are 0 except in the isometric model.
void add_weights(compare::BendingModel model, const Fold<Exact>& fold, const Fold<Input>& reacting,
                 const std::array<Point<Exact>, 2>& opposite, const std::array<Point<Input>, 2>& reacting_opposite,
                 const Inputs& inputs, compare::RestStateTruth& truth) {
  std::array<double, 3> weight{};
  double scale = 0;
  switch (model) {
    case compare::BendingModel::none:
    case compare::BendingModel::discrete_hinge: break;
    case compare::BendingModel::isometric_quadratic: {
      const auto value = fold.weights(opposite[0], opposite[1]);
      for (std::size_t k = 0; k < 3; ++k) {
        weight[k] = static_cast<double>(value[k]);
        truth.exact.hinges.back().weight[k] = static_cast<float>(value[k]);
      }
      scale = inputs.condition(reacting.weights(reacting_opposite[0], reacting_opposite[1]));
    }
  }
  truth.weight.push_back(weight);
  truth.weight_scale.push_back(scale);
}

void add_hinge(RestBuilder& to, const compare::Hinge& hinge) {
  const compare::Edge& edge = to.topology.edges[static_cast<std::size_t>(hinge.edge)];
  const compare::Index number_of_body = to.body_of_vertex[static_cast<std::size_t>(edge[0])];
  const compare::Material& material = to.body(number_of_body).material;
  if (to.body(number_of_body).fixed || to.body(number_of_body).is_solid() ||
      material.bending == compare::BendingModel::none)
    return;
  const std::array<compare::Index, 4> vertex{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]};
  const compare::Vec3& from = to.at(vertex[0]);
  const Fold<Exact> fold(exact(from), exact(to.at(vertex[1])), exact(to.at(vertex[2])), exact(to.at(vertex[3])));
  Inputs inputs;
  const Point<Input> along = input(inputs, to.at(vertex[1]), from);
  const std::array<Point<Input>, 2> opposite{input(inputs, to.at(vertex[2]), from),
                                             input(inputs, to.at(vertex[3]), from)};
  const Fold<Input> reacting(Point<Input>{}, along, opposite[0], opposite[1]);
  const double angle_scale = unit_of(inputs, reacting.angle());
  const Input bending = inputs.number(material.bending_stiffness);
  const long double angle = fold.angle(), stiffness = material.bending_stiffness * fold.factor();
  to.truth.exact.hinges.push_back(
      {vertex, number_of_body, static_cast<float>(angle), static_cast<float>(stiffness), {}});
  add_weights(material.bending, fold, reacting,
              {exact(to.at(vertex[2])) - exact(from), exact(to.at(vertex[3])) - exact(from)}, opposite, inputs,
              to.truth);
  to.truth.rest_angle.push_back(static_cast<double>(angle));
  to.truth.rest_angle_scale.push_back(angle_scale);
  to.truth.stiffness.push_back(static_cast<double>(stiffness));
  to.truth.stiffness_scale.push_back(unit_of(inputs, bending * reacting.factor()));
}

}  // namespace

void add_hinges_at_rest(RestBuilder& to) {
  for (const compare::Hinge& hinge : to.topology.hinges) add_hinge(to, hinge);
}

}  // namespace ogc::reference
