// Triangles with a membrane.
#pragma once

#include "compare/stages/rest_state.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/energies/membrane.hpp"
#include "reference/energies/membrane_terms.hpp"
#include "reference/solvers/kinds/elements.hpp"

namespace ogc::reference {

/// See kinds.hpp.
struct TriangleKind : compare::TriangleKind {
  /// One element, over any number type and in double.
  template <class Number>
  using TermOf = MembraneTermOf<Number>;
  using Term = MembraneTerm;
  /// All elements of a scene.
  using List = Elements<TriangleKind>;
  /// Adds the rest data of a scene.
  static void add_at_rest(RestBuilder& to) { add_triangles_at_rest(to); }
  /// Tolerances of the kind's stage, as multiples of 2⁻²⁴ of the error scale.
  static constexpr double force_tolerance = compare::membrane_force_tolerance,
                          block_tolerance = compare::membrane_block_tolerance;

  /// Returns element i with the data of the rest state.
  static Term term(const compare::Scene& scene, const compare::RestStateOut& from, std::size_t i) {
    const compare::RestTriangle& rest = from.triangles[i];
    const compare::Material& material = scene.bodies[static_cast<std::size_t>(rest.body)].material;
    Term term;
    term.vertex = rest.corner;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (std::size_t k = 0; k < 2; ++k) term.gradient[k + 1][axis] = double{rest.gradient[k][axis]};
      term.gradient[0][axis] = -term.gradient[1][axis] - term.gradient[2][axis];
    }
    term.area = double{rest.area};
    term.lambda = material.lame_lambda;
    term.mu = material.lame_mu;
    term.damping = material.membrane_damping / scene.settings.time_step;
    term.model = material.membrane;
    return term;
  }
  /// Returns the positions of an element's vertices [m].
  static std::array<Triple<double>, 3> corners(const Term& term, const State& x) { return gathered<3>(term.vertex, x); }
  /// Sets Gᵗ, for damping, from the positions at the start of the step [m].
  static void begin(Term& term, const State& start) {
    term.start = strain(deformation<double>(corners(term, start), term.gradient));
  }

  /// Adds force and block of the vertex at a place.
  static void add(const List& list, std::size_t i, std::size_t place, const std::array<Triple<double>, 3>& corners,
                  VertexSystemOf<double>& sum) {
    const MembraneCorner<double> at(list.terms()[i], place, corners);
    add_damping(list.terms()[i], at, sum);
    add_elastic(list.terms()[i], at, sum);
  }

  /// Returns the question of the kind's stage about one corner; the other two follow in the order of the mesh. ∇N₀ is
  /// not stored and is rounded here.
  template <class Positions>
  static compare::MembraneCase question(const compare::SweepIn& in, std::size_t i, std::size_t corner,
                                        const Positions& x) {
    const compare::RestTriangle& triangle = in.rest->triangles[i];
    const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(triangle.body)].material;
    const auto rounded = [](double number) { return static_cast<float>(number); };
    const auto& g = triangle.gradient;
    const std::array<std::array<float, 2>, 3> gradient{
        {{rounded(-double{g[0][0]} - double{g[1][0]}), rounded(-double{g[0][1]} - double{g[1][1]})}, g[0], g[1]}};
    compare::MembraneCase question;
    for (std::size_t k = 0; k < 3; ++k) {
      const compare::Index v = triangle.corner[(corner + k) % 3];
      question.corner[k] = x[v];
      question.start[k] = in.start[static_cast<std::size_t>(v)];
      if (k > 0) question.gradient[k - 1] = gradient[(corner + k) % 3];
    }
    question.area = triangle.area;
    question.lame_lambda = rounded(material.lame_lambda);
    question.lame_mu = rounded(material.lame_mu);
    question.damping = rounded(material.membrane_damping / in.scene->settings.time_step);
    question.model = material.membrane;
    question.damping_form = in.scene->settings.damping;
    return question;
  }
  /// Returns all accepted answers, the exact one first.
  static std::vector<compare::ForceAnswer> answers(const compare::MembraneCase& question) { return membrane(question); }
};

}  // namespace ogc::reference
