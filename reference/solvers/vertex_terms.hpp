// The stencils of one vertex as questions to the force stages: what the sweep sums is exactly what those stages answer.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "compare/stages/force.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {

/// One term of force and block, with the tolerances of its stage in units of u · scale. Answers that differ from the
/// exact one by no more than these tolerances are not tried one by one. They make a spread instead: the largest such
/// difference, plus as much again for the scale, which may be twice the exact one's.
struct Term {
  std::vector<compare::ForceAnswer> accepted;  ///< the exact answer first
  double force_tolerance = 0, block_tolerance = 0;
  double force_spread = 0, block_spread = 0;  ///< [N], [N/m]
};

/// Makes a term of one energy's answers: those near the exact one widen its spread, the others stay beside it.
Term term_of(std::vector<compare::ForceAnswer> accepted, double force_tolerance, double block_tolerance);

/// All terms of a vertex except inertia.
struct VertexTerms {
  std::vector<Term> terms;
};

/// By vertex: (number of the element, place of the vertex in it).
using ElementsOfVertex = std::vector<std::vector<std::pair<std::size_t, std::size_t>>>;

/// Lists the elements and contacts of each vertex.
struct SweepStencils {
  std::array<ElementsOfVertex, kind_count> elements;  ///< by kind
  ElementsOfVertex vertex_facet, edge_edge, volumes;
  std::vector<compare::Index> body;  ///< by vertex
  explicit SweepStencils(const compare::SweepIn& in);
};

/// The positions that the update of one vertex reads (method.md §7.2).
class SweepPositions {
 public:
  SweepPositions(const compare::SweepIn& in, const compare::SweepOut& answer, compare::Index own)
      : in_(in), answer_(answer), own_(own) {}
  /// Returns the new position of a vertex of lower colour, the old one of any other.
  const compare::Vec3f& operator[](compare::Index vertex) const {
    const auto i = static_cast<std::size_t>(vertex);
    return in_.colour[i] < in_.colour[static_cast<std::size_t>(own_)] ? answer_.position[i] : in_.old[i];
  }
  /// Returns the answer whose new positions and orientations are read.
  const compare::SweepOut& answer() const { return answer_; }

 private:
  const compare::SweepIn& in_;
  const compare::SweepOut& answer_;
  compare::Index own_;
};

/// Returns everything that acts on `vertex`, at the positions that its update reads.
VertexTerms terms_of_vertex(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                            compare::Index vertex);

/// Adds the terms of contacts alone: normal force, and friction where μ > 0; a contact with a volume is one term.
void add_contact_terms(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                       compare::Index vertex, VertexTerms& sum);

}  // namespace ogc::reference
