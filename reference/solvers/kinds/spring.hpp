// Describes springs between two vertices, or between a vertex and a point on the line of two others.
#pragma once

#include "compare/stages/rest_state.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/energies/spring.hpp"
#include "reference/solvers/kinds/elements.hpp"

namespace ogc::reference {

/// See kinds.hpp.
struct SpringKind : compare::SpringKind {
  /// One element, over any number type and in double.
  template <class Number>
  using TermOf = SpringTermOf<Number>;
  using Term = SpringTerm;
  /// All elements of a scene.
  using List = Elements<SpringKind>;
  /// Tolerances of the kind's stage, as multiples of 2⁻²⁴ of the error scale.
  static constexpr double force_tolerance = compare::spring_force_tolerance,
                          block_tolerance = compare::spring_block_tolerance;

  /// Returns the vertices that a spring pulls. A third vertex of weight 0 is not pulled and is replaced by −1.
  static std::array<compare::Index, 3> pulled(const compare::Spring& spring) {
    if (spring.ratio > 0) return ends_of(spring);
    return {spring.first, spring.second, -1};
  }

  /// Returns element i of the scene.
  static Term term(const compare::Scene& scene, const compare::RestStateOut&, std::size_t i) {
    const compare::Spring& spring = scene.springs[i];
    const double s = spring.ratio;
    return {{spring.first, spring.second, spring.third, -1},
            {1, s - 1, -s, 0},
            spring.stiffness,
            spring.rest_length,
            spring.damping / scene.settings.time_step};
  }
  /// Returns the positions of a spring's vertices [m]. A missing vertex has the weight 0 and gets the origin as its
  /// position.
  static std::array<Triple<double>, 4> corners(const Term& term, const State& x) {
    std::array<Triple<double>, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k)
      if (term.vertex[k] >= 0) corners[k] = x[static_cast<std::size_t>(term.vertex[k])];
    return corners;
  }
  /// Sets lᵗ, for damping, from the positions at the start of the step [m].
  static void begin(Term& term, const State& start) {
    const Triple<double> apart = separation(term.weight, corners(term, start));
    term.start = std::hypot(apart[0], apart[1], apart[2]);
  }

  /// Adds force and block of the vertex at a place.
  static void add(const List& list, std::size_t i, std::size_t place, const std::array<Triple<double>, 4>& ends,
                  VertexSystemOf<double>& sum) {
    const Term& term = list.terms()[i];
    add_spring(term, term.weight[place], separation(term.weight, with_own<ByOwn<double>>(ends, place)), sum);
  }

  /// Returns the question of the kind's stage about the vertex at a place.
  template <class Positions>
  static compare::SpringCase question(const compare::SweepIn& in, std::size_t i, std::size_t place,
                                      const Positions& x) {
    const compare::Spring& spring = in.scene->springs[i];
    const std::array<compare::Index, 3> ends = ends_of(spring);
    compare::SpringCase question;
    question.own = static_cast<std::int32_t>(place);
    question.ratio = static_cast<float>(spring.ratio);
    for (std::size_t k = 0; k < 3; ++k) {
      question.vertex[k] = x[ends[k]];
      question.start[k] = in.start[static_cast<std::size_t>(ends[k])];
    }
    question.stiffness = static_cast<float>(spring.stiffness);
    question.rest_length = static_cast<float>(spring.rest_length);
    question.damping = static_cast<float>(spring.damping / in.scene->settings.time_step);
    question.damping_form = in.scene->settings.damping;
    return question;
  }
  /// Returns all accepted answers, the exact one first.
  static std::vector<compare::ForceAnswer> answers(const compare::SpringCase& question) {
    return {reference::spring(question)};
  }

 private:
  /// Returns the three vertices of a spring; a missing third vertex is replaced by the second.
  static std::array<compare::Index, 3> ends_of(const compare::Spring& spring) {
    return {spring.first, spring.second, spring.third < 0 ? spring.second : spring.third};
  }
};

}  // namespace ogc::reference
