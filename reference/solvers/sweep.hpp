// Stage sweep: Algorithm 4, each vertex update in double from the answer's own positions at lower colours.
#pragma once

#include "compare/stages/sweep.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {

/// Returns the truth about an answer, computed in parallel over the vertices (compare/stages/sweep.hpp). Where a
/// vertex's contacts have several accepted answers, the truth is the combination nearest to the answer.
compare::SweepTruth sweep(const compare::SweepIn& in, const compare::SweepOut& answer);

/// Runs the reference's own sweep: prescribed vertices, then colour by colour, in parallel within a colour; positions
/// are stored in single precision within their bounds. `stencils`: those of `in`.
compare::SweepOut reference_sweep(const compare::SweepIn& in, const SweepStencils& stencils);

}  // namespace ogc::reference
