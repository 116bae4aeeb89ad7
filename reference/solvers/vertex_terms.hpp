// Converts the stencils of one vertex to cases of the force stages, so that the judged sweep sums exactly the answers
// of these stages.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "compare/stages/force.hpp"
#include "compare/stages/sweep.hpp"
#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {

/// One term of force and block. The tolerances of its stage are multiples of 2⁻²⁴ of the error scales. The spread is an
/// additional error that covers all accepted answers near the exact answer: their largest difference from it, plus one
/// tolerance, because their error scales may be twice as large.
struct Term {
  std::vector<compare::ForceAnswer> accepted;  ///< the exact answer first
  double force_tolerance = 0, block_tolerance = 0;
  double force_spread = 0, block_spread = 0;  ///< [N], [N/m]
};

/// Makes a term from the accepted answers of one energy. Answers within the tolerance of the exact answer only enlarge
/// the spread. `accepted` gets the exact answer and all others.
Term term_of(std::vector<compare::ForceAnswer> accepted, double force_tolerance, double block_tolerance);

/// All terms of a vertex except inertia.
struct VertexTerms {
  std::vector<Term> terms;
};

/// Elements by vertex: pairs (number of the element, place of the vertex in the element).
using ElementsOfVertex = std::vector<std::vector<std::pair<std::size_t, std::size_t>>>;

/// The elements and contacts of each vertex.
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
  /// Returns the new position if the vertex has a lower colour than `own`, otherwise the old position.
  const compare::Vec3f& operator[](compare::Index vertex) const {
    const auto i = static_cast<std::size_t>(vertex);
    return in_.colour[i] < in_.colour[static_cast<std::size_t>(own_)] ? answer_.position[i] : in_.old[i];
  }
  /// Returns the answer with the new positions and orientations.
  const compare::SweepOut& answer() const { return answer_; }

 private:
  const compare::SweepIn& in_;
  const compare::SweepOut& answer_;
  compare::Index own_;
};

/// Returns all terms of `vertex` except inertia, at the positions that the vertex's update reads.
VertexTerms terms_of_vertex(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                            compare::Index vertex);

/// Adds the terms of contacts: normal force, and friction if μ > 0. Both forces of a contact with a volume form one
/// term.
void add_contact_terms(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                       compare::Index vertex, VertexTerms& sum);

}  // namespace ogc::reference
