// Each quantity is written once, as polynomials over a number type: exact numbers give the value, so that no needle,
// flat hinge or fold loses a bit before the one root, quotient or angle at the end; numbers that know their inputs give
// the unit of its error.
#include "reference/energies/rest_state.hpp"

#include <CGAL/Mpzf.h>

#include <cmath>

#include "reference/energies/inputs.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {
namespace {

using Exact = CGAL::Mpzf;

/// 64 bits or more of an exact number: what a double leaves of it goes into a second one.
long double number(const Exact& x) {
  const double high = x.to_double();
  return static_cast<long double>(high) + static_cast<long double>((x - Exact(high)).to_double());
}
Input number(const Input& x) { return x; }

Point<Exact> exact(const compare::Vec3& p) { return {Exact(p.x), Exact(p.y), Exact(p.z)}; }

compare::Vec3f single(const compare::Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

Point<Input> input(Inputs& inputs, const compare::Vec3& p, const compare::Vec3& from) {
  const Triple<Input> v = inputs.vector(single(p), single(from));
  return {v[0], v[1], v[2]};
}

template <class T>
T area_of(const Point<T>& normal) {
  using std::sqrt;
  return T(0.5) * sqrt(dot(normal, normal));
}

/// A triangle by what its coordinates give before any root: e = x1 − x0, n = e × (x2 − x0).
template <class T>
struct Shape {
  Point<T> edge, normal, across[2];  ///< across[k]: the edge opposite corner k + 1, from its first end to its second

  Shape(const Point<T>& x0, const Point<T>& x1, const Point<T>& x2)
      : edge(x1 - x0), normal(cross(edge, x2 - x0)), across{x0 - x2, x1 - x0} {}
};

/// ∇N_k = n × (edge opposite k) / ‖n‖², in the frame of e and n × e.
template <class T>
auto gradient(const Shape<T>& shape, std::size_t k) {
  using std::sqrt;
  const Point<T> slope = cross(shape.normal, shape.across[k]);
  const auto nn = number(dot(shape.normal, shape.normal)), ee = number(dot(shape.edge, shape.edge));
  const auto first = number(dot(slope, shape.edge)), second = number(dot(slope, cross(shape.normal, shape.edge)));
  const auto along_edge = first / (nn * sqrt(ee)), above = second / (nn * sqrt(nn * ee));
  return std::array{along_edge, above};
}

/// The two normals of a hinge about its edge.
template <class T>
struct Fold {
  Point<T> edge, first, second;

  Fold(const Point<T>& x0, const Point<T>& x1, const Point<T>& o0, const Point<T>& o1)
      : edge(x1 - x0), first(cross(edge, o0 - x0)), second(cross(o1 - x0, edge)) {}

  /// From the first normal to the second, positive about the edge: tan θ = (n₀ × n₁)·e / (‖e‖ n₀·n₁).
  auto angle() const {
    using std::atan2, std::sqrt;
    const auto turned = number(dot(cross(first, second), edge)), length = sqrt(number(dot(edge, edge)));
    const auto same = number(dot(first, second)) * length;
    return atan2(turned, same);
  }
  /// 3 ‖e‖²/(A₀ + A₁).
  auto factor() const {
    using std::sqrt;
    const auto ee = number(dot(edge, edge)), twice_first = sqrt(number(dot(first, first))),
               twice_second = sqrt(number(dot(second, second)));
    return decltype(ee)(6.0) * ee / (twice_first + twice_second);
  }
  /// Sums of cotangents over the edge's length: of x1, o0, o1, given the vectors to the opposite vertices from x0.
  auto weights(const Point<T>& to_first, const Point<T>& to_second) const {
    using std::sqrt;
    const auto length = sqrt(number(dot(edge, edge))), twice_first = sqrt(number(dot(first, first))),
               twice_second = sqrt(number(dot(second, second)));
    const auto cotangents = number(dot(edge, to_first)) / twice_first + number(dot(edge, to_second)) / twice_second;
    return std::array{decltype(length)(cotangents / length), decltype(length)(-length / twice_first),
                      decltype(length)(-length / twice_second)};
  }
};

/// A tetrahedron by what its coordinates give before any quotient: normals of the faces opposite its corners, inward,
/// of twice the area, and 6V. ∇N_k = n_k/(6V).
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

double unit_of(const Inputs& inputs, const Input& answer) { return inputs.condition({&answer, 1}); }

/// Fills the answer stencil by stencil.
class Builder {
 public:
  explicit Builder(const compare::RestStateIn& in)
      : scene_(*in.scene),
        topology_(*in.topology),
        body_(compare::body_of_vertex(scene_)),
        mass_(body_.size()),
        mass_scale_(body_.size()) {}

  compare::RestStateTruth build() {
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      const compare::Body& body = scene_.bodies[b];
      if (body.fixed) continue;
      for (Index t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t)
        add_tetrahedron(t, static_cast<Index>(b));
      if (body.is_solid()) continue;
      for (Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
        add_triangle(t, static_cast<Index>(b));
    }
    add_segments({&scene_, &topology_}, truth_, mass_, mass_scale_);
    for (std::size_t v = 0; v < mass_.size(); ++v) {
      truth_.exact.mass.push_back(static_cast<float>(mass_[v]));
      truth_.mass.push_back(static_cast<double>(mass_[v]));
      truth_.mass_scale.push_back(mass_scale_[v]);
    }
    for (const compare::Hinge& hinge : topology_.hinges) add_hinge(hinge);
    for (const compare::Edge& edge : topology_.edges) add_edge(edge);
    for (const compare::Body& a : scene_.bodies)
      for (const compare::Body& b : scene_.bodies) add_meeting(a.material, b.material);
    return std::move(truth_);
  }

 private:
  using Index = compare::Index;

  const compare::Vec3& at(Index v) const { return scene_.rest_positions[static_cast<std::size_t>(v)]; }
  const compare::Body& body(Index b) const { return scene_.bodies[static_cast<std::size_t>(b)]; }

  void add_triangle(Index t, Index number_of_body) {
    const compare::Triangle& corners = scene_.mesh.triangles[static_cast<std::size_t>(t)];
    const compare::Vec3 &x0 = at(corners[0]), &x1 = at(corners[1]), &x2 = at(corners[2]);
    const compare::Material& material = body(number_of_body).material;
    const Shape<Exact> shape(exact(x0), exact(x1), exact(x2));
    Inputs inputs;
    const Shape<Input> reacting(Point<Input>{}, input(inputs, x1, x0), input(inputs, x2, x0));
    const long double area = std::sqrt(number(dot(shape.normal, shape.normal))) / 2;
    const double area_scale = unit_of(inputs, area_of(reacting.normal));
    for (const Index corner : corners) {
      const auto v = static_cast<std::size_t>(corner);
      mass_[v] += material.density * area / 3;
      mass_scale_[v] += material.density * (area_scale + static_cast<double>(area)) / 3;
    }
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
    truth_.exact.triangles.push_back(triangle);
    truth_.area.push_back(static_cast<double>(area));
    truth_.area_scale.push_back(area_scale);
    truth_.gradient.push_back(gradients);
    truth_.gradient_scale.push_back(scales);
  }

  void add_tetrahedron(Index t, Index number_of_body) {
    const compare::Tetrahedron& corners = scene_.mesh.tetrahedra[static_cast<std::size_t>(t)];
    const compare::Vec3& from = at(corners[0]);
    const Point<Exact> origin = exact(from);
    const SolidShape<Exact> shape(exact(at(corners[1])) - origin, exact(at(corners[2])) - origin,
                                  exact(at(corners[3])) - origin);
    Inputs inputs;
    const SolidShape<Input> reacting(input(inputs, at(corners[1]), from), input(inputs, at(corners[2]), from),
                                     input(inputs, at(corners[3]), from));
    const long double six_volumes = number(shape.six_volumes), volume = six_volumes / 6;
    const double volume_scale = unit_of(inputs, Input(1.0 / 6) * reacting.six_volumes);
    const double density = body(number_of_body).material.solid_density;
    for (const Index corner : corners) {
      const auto v = static_cast<std::size_t>(corner);
      mass_[v] += density * volume / 4;
      mass_scale_[v] += density * (volume_scale + static_cast<double>(volume)) / 4;
    }
    compare::RestTetrahedron rest{
        corners, number_of_body, static_cast<float>(volume), static_cast<float>(1 / six_volumes), {}, {}};
    truth_.volume.push_back(static_cast<double>(volume));
    truth_.volume_scale.push_back(volume_scale);
    truth_.inverse.push_back(static_cast<double>(1 / six_volumes));
    truth_.inverse_scale.push_back(unit_of(inputs, Input(1.0) / reacting.six_volumes));
    add_weights(shape, reacting, inputs, rest);
    add_gradients(shape, reacting, inputs, rest);
    truth_.exact.tetrahedra.push_back(rest);
  }

  void add_weights(const SolidShape<Exact>& shape, const SolidShape<Input>& reacting, const Inputs& inputs,
                   compare::RestTetrahedron& rest) {
    std::array<double, 6> weights{};
    std::vector<Input> all;
    for (std::size_t i = 0; i < corner_pairs.size(); ++i) {
      const auto [k, l] = corner_pairs[i];
      const long double weight = shape.weight(k, l);
      rest.weight[i] = static_cast<float>(weight);
      weights[i] = static_cast<double>(weight);
      all.push_back(reacting.weight(k, l));
    }
    truth_.tetrahedron_weight.push_back(weights);
    truth_.tetrahedron_weight_scale.push_back(inputs.condition(all));
  }

  void add_gradients(const SolidShape<Exact>& shape, const SolidShape<Input>& reacting, const Inputs& inputs,
                     compare::RestTetrahedron& rest) {
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
    truth_.tetrahedron_gradient.push_back(gradients);
    truth_.tetrahedron_gradient_scale.push_back(inputs.condition(all));
  }

  void add_hinge(const compare::Hinge& hinge) {
    const compare::Edge& edge = topology_.edges[static_cast<std::size_t>(hinge.edge)];
    const Index number_of_body = body_[static_cast<std::size_t>(edge[0])];
    const compare::Material& material = body(number_of_body).material;
    if (body(number_of_body).fixed || body(number_of_body).is_solid() ||
        material.bending == compare::BendingModel::none)
      return;
    const std::array<Index, 4> vertex{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]};
    const compare::Vec3& from = at(vertex[0]);
    const Fold<Exact> fold(exact(from), exact(at(vertex[1])), exact(at(vertex[2])), exact(at(vertex[3])));
    Inputs inputs;
    const Point<Input> along = input(inputs, at(vertex[1]), from);
    const std::array<Point<Input>, 2> opposite{input(inputs, at(vertex[2]), from), input(inputs, at(vertex[3]), from)};
    const Fold<Input> reacting(Point<Input>{}, along, opposite[0], opposite[1]);
    const double angle_scale = unit_of(inputs, reacting.angle());
    const Input bending = inputs.number(material.bending_stiffness);
    const long double angle = fold.angle(), stiffness = material.bending_stiffness * fold.factor();
    truth_.exact.hinges.push_back(
        {vertex, number_of_body, static_cast<float>(angle), static_cast<float>(stiffness), {}});
    add_weights(material.bending, fold, reacting,
                {exact(at(vertex[2])) - exact(from), exact(at(vertex[3])) - exact(from)}, opposite, inputs);
    truth_.rest_angle.push_back(static_cast<double>(angle));
    truth_.rest_angle_scale.push_back(angle_scale);
    truth_.stiffness.push_back(static_cast<double>(stiffness));
    truth_.stiffness_scale.push_back(unit_of(inputs, bending * reacting.factor()));
  }

  /// Adds the weights of the last hinge; they are 0 but in the isometric model.
  void add_weights(compare::BendingModel model, const Fold<Exact>& fold, const Fold<Input>& reacting,
                   const std::array<Point<Exact>, 2>& opposite, const std::array<Point<Input>, 2>& reacting_opposite,
                   const Inputs& inputs) {
    std::array<double, 3> weight{};
    double scale = 0;
    switch (model) {
      case compare::BendingModel::none:
      case compare::BendingModel::discrete_hinge: break;
      case compare::BendingModel::isometric_quadratic: {
        const auto value = fold.weights(opposite[0], opposite[1]);
        for (std::size_t k = 0; k < 3; ++k) {
          weight[k] = static_cast<double>(value[k]);
          truth_.exact.hinges.back().weight[k] = static_cast<float>(value[k]);
        }
        scale = inputs.condition(reacting.weights(reacting_opposite[0], reacting_opposite[1]));
      }
    }
    truth_.weight.push_back(weight);
    truth_.weight_scale.push_back(scale);
  }

  void add_edge(const compare::Edge& edge) {
    const Point<Exact> e = exact(at(edge[1])) - exact(at(edge[0]));
    Inputs inputs;
    const Point<Input> reacting = input(inputs, at(edge[1]), at(edge[0]));
    const long double squared = number(dot(e, e));
    truth_.exact.edge_length_squared.push_back(static_cast<float>(squared));
    truth_.edge_length_squared.push_back(static_cast<double>(squared));
    truth_.edge_length_squared_scale.push_back(unit_of(inputs, dot(reacting, reacting)));
  }

  /// The harmonic mean as the reciprocal of the mean reciprocal.
  void add_meeting(const compare::Material& a, const compare::Material& b) {
    const long double ka = a.contact_stiffness, kb = b.contact_stiffness;
    const long double stiffness = ka == 0 || kb == 0 ? 0 : 2 / (1 / ka + 1 / kb);
    const long double friction = (static_cast<long double>(a.friction) + b.friction) / 2;
    truth_.exact.meetings.push_back({static_cast<float>(stiffness), static_cast<float>(friction)});
    truth_.meeting_stiffness.push_back(static_cast<double>(stiffness));
    truth_.meeting_friction.push_back(static_cast<double>(friction));
  }

  const compare::Scene& scene_;
  const compare::Topology& topology_;
  std::vector<Index> body_;
  std::vector<long double> mass_;
  std::vector<double> mass_scale_;
  compare::RestStateTruth truth_;
};

}  // namespace

compare::RestStateTruth rest_state(const compare::RestStateIn& in) { return Builder(in).build(); }

}  // namespace ogc::reference
