// Collects the rest state, to which each kind of element adds its quantities. A quantity is written once, as
// polynomials over a number type. Over exact numbers they give its value: even needles, flat hinges and folds lose no
// bit before the last root, quotient or angle. Over Input numbers they give the value's error scale.
#pragma once

#include <CGAL/Mpzf.h>

#include "compare/stages/rest_state.hpp"
#include "reference/energies/inputs.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// The exact number type for polynomials of coordinates.
using Exact = CGAL::Mpzf;

/// Returns an exact number rounded to at least 64 bits: the sum of its nearest double and of the remainder as a double.
inline long double number(const Exact& x) {
  const double high = x.to_double();
  return static_cast<long double>(high) + static_cast<long double>((x - Exact(high)).to_double());
}
/// Returns the Input number itself, so that one formula serves both number types.
inline Input number(const Input& x) { return x; }

/// Converts a vertex to exact numbers without loss.
inline Point<Exact> exact(const compare::Vec3& p) { return {Exact(p.x), Exact(p.y), Exact(p.z)}; }

/// Converts a vertex to single precision; without loss, because the scene is rounded.
inline compare::Vec3f single(const compare::Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Returns p − from as one input of `inputs`.
inline Point<Input> input(Inputs& inputs, const compare::Vec3& p, const compare::Vec3& from) {
  const Triple<Input> v = inputs.vector(single(p), single(from));
  return {v[0], v[1], v[2]};
}

/// Returns the error scale of one number.
inline double unit_of(const Inputs& inputs, const Input& answer) { return inputs.condition({&answer, 1}); }

/// Collects the truth about the rest state of a scene.
struct RestBuilder {
  const compare::Scene& scene;
  const compare::Topology& topology;
  std::vector<compare::Index> body_of_vertex = compare::body_of_vertex(scene);
  compare::RestStateTruth truth{};
  std::vector<long double> mass = std::vector<long double>(body_of_vertex.size());  ///< by vertex [kg]
  std::vector<double> mass_scale = std::vector<double>(body_of_vertex.size());  ///< unit of the mass's error, by vertex

  /// Returns the rest position of a vertex [m].
  const compare::Vec3& at(compare::Index v) const { return scene.rest_positions[static_cast<std::size_t>(v)]; }
  const compare::Body& body(compare::Index b) const { return scene.bodies[static_cast<std::size_t>(b)]; }

  /// Adds density · size, an element's mass, in equal parts to its vertices. `scale` is the error scale of `size`.
  template <class Vertices>
  void add_mass(const Vertices& vertices, double density, long double size, double scale) {
    for (const compare::Index vertex : vertices) {
      const auto v = static_cast<std::size_t>(vertex);
      mass[v] += density * size / vertices.size();
      mass_scale[v] += density * (scale + static_cast<double>(size)) / static_cast<double>(vertices.size());
    }
  }
};

}  // namespace ogc::reference
