// The stencils of one vertex as questions of the force stages: what the sweep sums is exactly what those stages answer.
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
/// exact one by no more than these tolerances are not tried one by one: the largest such difference, and as much for
/// the scale, which may be twice the exact one's, is a spread.
struct Term {
  std::vector<compare::ForceAnswer> accepted;  ///< the exact one first
  double force_tolerance = 0, block_tolerance = 0;
  double force_spread = 0, block_spread = 0;  ///< [N], [N/m]
};

/// One energy's answers as a term: those near the exact one widen it, the others stand beside it.
Term term_of(std::vector<compare::ForceAnswer> accepted, double force_tolerance, double block_tolerance);

/// All terms of a vertex but inertia.
struct VertexTerms {
  std::vector<Term> terms;
};

/// By vertex: (number of the element, place of the vertex in it).
using ElementsOfVertex = std::vector<std::vector<std::pair<std::size_t, std::size_t>>>;

/// Which elements meet at which vertex.
struct SweepStencils {
  std::array<ElementsOfVertex, kind_count> elements;  ///< by kind
  ElementsOfVertex vertex_facet, edge_edge, volumes;
  std::vector<compare::Index> body;  ///< by vertex
  explicit SweepStencils(const compare::SweepIn& in);
};

/// Where each vertex is read while one of them is solved (method.md §7.2).
class SweepPositions {
 public:
  SweepPositions(const compare::SweepIn& in, const compare::SweepOut& answer, compare::Index own)
      : in_(in), answer_(answer), own_(own) {}
  /// The new position of a vertex of lower colour, the old one of any other.
  const compare::Vec3f& operator[](compare::Index vertex) const {
    const auto i = static_cast<std::size_t>(vertex);
    return in_.colour[i] < in_.colour[static_cast<std::size_t>(own_)] ? answer_.position[i] : in_.old[i];
  }
  /// Whose new positions and orientations are read.
  const compare::SweepOut& answer() const { return answer_; }

 private:
  const compare::SweepIn& in_;
  const compare::SweepOut& answer_;
  compare::Index own_;
};

/// Everything that acts on `vertex`, at the positions that its update reads.
VertexTerms terms_of_vertex(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                            compare::Index vertex);

/// The part of it that contacts add: normal force, and friction where μ > 0; those with volumes as one.
void add_contact_terms(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                       compare::Index vertex, VertexTerms& sum);

}  // namespace ogc::reference
