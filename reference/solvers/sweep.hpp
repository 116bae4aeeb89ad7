// Stage sweep: Algorithm 4, each vertex update in double from what the answer holds at lower colours.
#pragma once

#include "compare/stages/sweep.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {

/// The truth about an answer, vertex by vertex and in parallel over them (compare/stages/sweep.hpp). Of a vertex whose
/// contacts have several accepted answers it is the combination that comes nearest to the answer.
compare::SweepTruth sweep(const compare::SweepIn& in, const compare::SweepOut& answer);

/// The reference's own sweep: prescribed vertices, then colour by colour, in parallel within one; positions are stored
/// in single precision within their bounds. `stencils`: those of the question.
compare::SweepOut reference_sweep(const compare::SweepIn& in, const SweepStencils& stencils);

}  // namespace ogc::reference
