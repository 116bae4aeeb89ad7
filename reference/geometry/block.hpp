// Stage block: membership in the blocks of Eq. 8–10, 14 and 15.
#pragma once

#include "compare/stages/block.hpp"

namespace ogc::reference {

/// Answers all questions exactly, in parallel, and marks the answers that a relative change of 16 u of the coordinates
/// could flip.
compare::BlockTruth block(const compare::BlockIn& in);

}  // namespace ogc::reference
