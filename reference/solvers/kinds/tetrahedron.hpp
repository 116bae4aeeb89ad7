// Tetrahedra of solids.
#pragma once

#include "compare/stages/rest_state.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/energies/tetrahedron.hpp"
#include "reference/solvers/kinds/elements.hpp"

namespace ogc::reference {

/// See kinds.hpp.
struct TetrahedronKind : compare::TetrahedronKind {
  /// One element, over any number type and in double.
  template <class Number>
  using TermOf = TetrahedronTermOf<Number>;
  using Term = TetrahedronTerm;
  /// All elements of a scene.
  using List = Elements<TetrahedronKind>;
  /// Adds the rest data of a scene.
  static void add_at_rest(RestBuilder& to) { add_tetrahedra_at_rest(to); }
  /// Tolerances of the kind's stage, as multiples of 2⁻²⁴ of the error scale.
  static constexpr double force_tolerance = compare::tetrahedron_force_tolerance,
                          block_tolerance = compare::tetrahedron_block_tolerance;

  /// Returns element i with the data of the rest state.
  static Term term(const compare::Scene& scene, const compare::RestStateOut& from, std::size_t i) {
    const compare::RestTetrahedron& rest = from.tetrahedra[i];
    const compare::Material& material = scene.bodies[static_cast<std::size_t>(rest.body)].material;
    Term term;
    term.vertex = rest.corner;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < 3; ++k) {
        term.gradient[k + 1][axis] = double{rest.gradient[k][axis]};
        term.gradient[0][axis] -= term.gradient[k + 1][axis];
      }
    term.volume = double{rest.volume};
    term.lambda = material.solid_lambda;
    term.mu = material.solid_mu;
    term.damping = material.solid_damping / scene.settings.time_step;
    return term;
  }
  /// Returns the positions of an element's vertices [m].
  static std::array<Triple<double>, 4> corners(const Term& term, const State& x) { return gathered<4>(term.vertex, x); }
  /// Sets Gᵗ, for damping, from the positions at the start of the step [m].
  static void begin(Term& term, const State& start) {
    term.start = solid_strain(solid_deformation<double>(corners(term, start), term.gradient));
  }

  /// Adds force and block of the vertex at a place.
  static void add(const List& list, std::size_t i, std::size_t place, const std::array<Triple<double>, 4>& corners,
                  VertexSystemOf<double>& sum) {
    const Term& term = list.terms()[i];
    const TetrahedronCorner<double> at(term, place, corners);
    add_exactly(term.elastic_of(at.f), sum);
    add_damping(term, at, sum);
  }

  /// Returns the question of the kind's stage about the vertex at a place.
  template <class Positions>
  static compare::TetrahedronCase question(const compare::SweepIn& in, std::size_t i, std::size_t corner,
                                           const Positions& x) {
    const compare::RestTetrahedron& rest = in.rest->tetrahedra[i];
    const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(rest.body)].material;
    compare::TetrahedronCase question;
    question.corner[0] = x[rest.corner[corner]];
    question.start[0] = in.start[static_cast<std::size_t>(rest.corner[corner])];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t other = seen_from[corner][k];
      question.corner[k + 1] = x[rest.corner[other]];
      question.start[k + 1] = in.start[static_cast<std::size_t>(rest.corner[other])];
      question.weight[k] = rest.weight[index_of_pair(corner, other)];
      question.gradient[k] = gradient_of(rest, other);
    }
    question.inverse = rest.inverse;
    question.volume = rest.volume;
    question.lame_lambda = static_cast<float>(material.solid_lambda);
    question.lame_mu = static_cast<float>(material.solid_mu);
    question.damping = static_cast<float>(material.solid_damping / in.scene->settings.time_step);
    question.damping_form = in.scene->settings.damping;
    return question;
  }
  /// Returns all accepted answers, the exact one first.
  static std::vector<compare::ForceAnswer> answers(const compare::TetrahedronCase& question) {
    return {reference::tetrahedron(question)};
  }

 private:
  /// Lists for each corner the corners of the opposite face. Corner and face, in this order, have a positive volume at
  /// rest.
  static constexpr std::array<std::array<std::size_t, 3>, 4> seen_from{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

  /// Returns the index of V ∇N_k·∇N_l among the weights of a tetrahedron.
  static std::size_t index_of_pair(std::size_t k, std::size_t l) {
    const auto [low, high] = std::minmax(k, l);
    return low == 0 ? high - 1 : low + high;
  }

  /// Returns ∇N of a corner. ∇N₀ is not stored; it is computed and rounded here.
  static std::array<float, 3> gradient_of(const compare::RestTetrahedron& rest, std::size_t corner) {
    if (corner > 0) return rest.gradient[corner - 1];
    std::array<float, 3> own;
    for (std::size_t axis = 0; axis < 3; ++axis)
      own[axis] = static_cast<float>(-double{rest.gradient[0][axis]} - double{rest.gradient[1][axis]} -
                                     double{rest.gradient[2][axis]});
    return own;
  }
};

}  // namespace ogc::reference
