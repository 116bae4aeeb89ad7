// Describes segments of rods. Their stencils depend on orientations, too (solvers/rods/rod_system.hpp).
#pragma once

#include "compare/stages/rest_state.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/energies/rods/rod.hpp"
#include "reference/solvers/rods/rod_system.hpp"
#include "reference/solvers/rods/segment_questions.hpp"

namespace ogc::reference {

/// See kinds.hpp.
struct SegmentKind : compare::SegmentKind {
  /// All elements of a scene.
  using List = RodSystem;
  /// Adds the rest data of a scene.
  static void add_at_rest(RestBuilder& to) { add_segments_at_rest(to); }
  /// Tolerances of the kind's stage, as multiples of 2⁻²⁴ of the error scale.
  static constexpr double force_tolerance = compare::rod_force_tolerance,
                          block_tolerance = compare::rod_block_tolerance;

  /// Adds force and block of the vertex at a place.
  static void add(const List& list, std::size_t i, std::size_t end, const std::array<Triple<double>, 2>& ends,
                  VertexSystemOf<double>& sum) {
    list.add_force(static_cast<compare::Index>(i), end, ends, sum);
  }

  /// Returns the question of the kind's stage about the vertex at a place.
  template <class Positions>
  static compare::RodCase question(const compare::SweepIn& in, std::size_t i, std::size_t end, const Positions& x) {
    const compare::Edge& ends = in.rest->segments[i].end;
    return rod_question(in, x.answer(), i, end, {x[ends[0]], x[ends[1]]});
  }
  /// Returns all accepted answers, the exact one first.
  static std::vector<compare::ForceAnswer> answers(const compare::RodCase& question) {
    return {reference::rod(question)};
  }
};

}  // namespace ogc::reference
