// Collects the rest state; each kind of element adds its own part. Each quantity is written once, as polynomials over a
// number type. Exact numbers give the value, so needles, flat hinges and folds lose no bit before the last root,
// quotient or angle. Input numbers give the unit of the value's error.
#pragma once

#include <CGAL/Mpzf.h>

#include "compare/stages/kinds.hpp"
#include "reference/energies/inputs.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// The numbers in which polynomials of coordinates are computed.
using Exact = CGAL::Mpzf;

/// Returns at least 64 bits of an exact number: a second double holds the rest of the first one.
inline long double number(const Exact& x) {
  const double high = x.to_double();
  return static_cast<long double>(high) + static_cast<long double>((x - Exact(high)).to_double());
}
/// Returns it unchanged.
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

/// Collects the truth about a scene.
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

  /// Adds an element's mass in equal parts to its vertices; `scale` is the unit of the error of `size`.
  template <class Vertices>
  void add_mass(const Vertices& vertices, double density, long double size, double scale) {
    for (const compare::Index vertex : vertices) {
      const auto v = static_cast<std::size_t>(vertex);
      mass[v] += density * size / vertices.size();
      mass_scale[v] += density * (scale + static_cast<double>(size)) / static_cast<double>(vertices.size());
    }
  }
};

// Each kind adds its elements, in the order of the contract, and their masses.
void add_rest(compare::TriangleKind, RestBuilder& to);
void add_rest(compare::HingeKind, RestBuilder& to);
void add_rest(compare::TetrahedronKind, RestBuilder& to);
void add_rest(compare::SegmentKind, RestBuilder& to);

}  // namespace ogc::reference
