// Stage sweep: Algorithm 4. Updates each vertex in double from the positions that the contestant's update reads: the
// answer's new positions of vertices with lower colours, and the old positions of all others.
#pragma once

#include "compare/stages/sweep.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {

/// Returns the truth about an answer, in parallel over the vertices (compare/stages/sweep.hpp). If a vertex's contacts
/// have several accepted answers, the truth uses the combination nearest to the answer.
compare::SweepTruth sweep(const compare::SweepIn& in, const compare::SweepOut& answer);

/// Computes the reference's own sweep: prescribed vertices first, then colour by colour, in parallel within a colour.
/// Positions are stored in single precision within their bounds. `stencils` must be constructed from `in`.
compare::SweepOut reference_sweep(const compare::SweepIn& in, const SweepStencils& stencils);

}  // namespace ogc::reference
