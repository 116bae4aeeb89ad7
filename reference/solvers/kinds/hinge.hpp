// Hinges with a bending energy.
#pragma once

#include "compare/stages/rest_state.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/energies/bending.hpp"
#include "reference/energies/hinge_terms.hpp"
#include "reference/solvers/kinds/elements.hpp"

namespace ogc::reference {

/// See kinds.hpp.
struct HingeKind : compare::HingeKind {
  /// One element, over any number type and in double.
  template <class Number>
  using TermOf = HingeTermOf<Number>;
  using Term = HingeTerm;
  /// All elements of a scene.
  using List = Elements<HingeKind>;
  /// Adds the rest data of a scene.
  static void add_at_rest(RestBuilder& to) { add_hinges_at_rest(to); }
  /// Tolerances of the kind's stage, as multiples of 2⁻²⁴ of the error scale.
  static constexpr double force_tolerance = compare::bending_force_tolerance,
                          block_tolerance = compare::bending_block_tolerance;

  /// Returns element i with the data of the rest state.
  static Term term(const compare::Scene& scene, const compare::RestStateOut& from, std::size_t i) {
    const compare::RestHinge& rest = from.hinges[i];
    const compare::Material& material = scene.bodies[static_cast<std::size_t>(rest.body)].material;
    Term term{rest.vertex, double{rest.stiffness}, double{rest.rest_angle},
              material.bending_damping / scene.settings.time_step};
    term.model = material.bending;
    for (std::size_t k = 0; k < 3; ++k) {
      term.weight[k + 1] = double{rest.weight[k]};
      term.weight[0] -= term.weight[k + 1];
    }
    return term;
  }
  /// Returns the positions of an element's vertices [m].
  static std::array<Triple<double>, 4> corners(const Term& term, const State& x) { return gathered<4>(term.vertex, x); }
  /// Sets θᵗ, for damping, from the positions at the start of the step [m].
  static void begin(Term& term, const State& start) {
    const Fold<double> fold(corners(term, start));
    term.start = fold.collapsed() ? 0 : fold.angle();
  }

  /// Adds force and block of the vertex at a place.
  static void add(const List& list, std::size_t i, std::size_t place, const std::array<Triple<double>, 4>& corners,
                  VertexSystemOf<double>& sum) {
    const Term& term = list.terms()[i];
    const Hinge<ByOwn<double>> x = with_own<ByOwn<double>>(corners, place);
    add_positions(term, x, sum);
    if (!term.has_angle()) return;
    const Fold<ByOwn<double>> fold(x);
    if (!fold.collapsed()) add_angle(term, fold.angle(), sum);
  }

  /// Returns the question of the kind's stage about the vertex at a place.
  template <class Positions>
  static compare::BendingCase question(const compare::SweepIn& in, std::size_t i, std::size_t role,
                                       const Positions& x) {
    const compare::RestHinge& hinge = in.rest->hinges[i];
    const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(hinge.body)].material;
    compare::BendingCase question;
    for (std::size_t k = 0; k < 4; ++k) {
      question.vertex[k] = x[hinge.vertex[k]];
      question.start[k] = in.start[static_cast<std::size_t>(hinge.vertex[k])];
    }
    question.stiffness = hinge.stiffness;
    question.rest_angle = hinge.rest_angle;
    question.damping = static_cast<float>(material.bending_damping / in.scene->settings.time_step);
    question.model = material.bending;
    question.weight = hinge.weight;
    question.damping_form = in.scene->settings.damping;
    question.own = static_cast<std::int32_t>(role);
    return question;
  }
  /// Returns all accepted answers, the exact one first.
  static std::vector<compare::ForceAnswer> answers(const compare::BendingCase& question) { return bending(question); }
};

}  // namespace ogc::reference
