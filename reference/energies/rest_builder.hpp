// Holds the rest state to which each kind of element adds its own. Each quantity is written once, as polynomials over
// a number type: exact numbers give the value, so that no needle, flat hinge or fold loses a bit before the one root,
// quotient or angle at the end; numbers that know their inputs give the unit of its error.
#pragma once

#include <CGAL/Mpzf.h>

#include "compare/stages/rest_state.hpp"
#include "reference/energies/inputs.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// Polynomials of coordinates are computed in these numbers.
using Exact = CGAL::Mpzf;

/// Returns 64 bits or more of an exact number: a second double takes the rest that the first one leaves.
inline long double number(const Exact& x) {
  const double high = x.to_double();
  return static_cast<long double>(high) + static_cast<long double>((x - Exact(high)).to_double());
}
/// Returns it as it is.
inline Input number(const Input& x) { return x; }

/// Converts a vertex without loss.
inline Point<Exact> exact(const compare::Vec3& p) { return {Exact(p.x), Exact(p.y), Exact(p.z)}; }

/// Converts a vertex of a rounded scene without loss.
inline compare::Vec3f single(const compare::Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Returns p − from as one input.
inline Point<Input> input(Inputs& inputs, const compare::Vec3& p, const compare::Vec3& from) {
  const Triple<Input> v = inputs.vector(single(p), single(from));
  return {v[0], v[1], v[2]};
}

/// Returns the unit of the error of one number.
inline double unit_of(const Inputs& inputs, const Input& answer) { return inputs.condition({&answer, 1}); }

/// The truth about a scene while kinds add to it.
struct RestBuilder {
  const compare::Scene& scene;
  const compare::Topology& topology;
  std::vector<compare::Index> body_of_vertex = compare::body_of_vertex(scene);
  compare::RestStateTruth truth{};
  std::vector<long double> mass = std::vector<long double>(body_of_vertex.size());  ///< by vertex [kg]
  std::vector<double> mass_scale = std::vector<double>(body_of_vertex.size());      ///< its unit of error

  /// Returns the rest position of a vertex [m].
  const compare::Vec3& at(compare::Index v) const { return scene.rest_positions[static_cast<std::size_t>(v)]; }
  const compare::Body& body(compare::Index b) const { return scene.bodies[static_cast<std::size_t>(b)]; }

  /// Adds an element's mass in equal parts to its vertices; `scale` is the unit of the error of its size.
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
