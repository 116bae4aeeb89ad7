// Stage block: membership in the blocks of Eq. 8–10, 14 and 15.
#pragma once

#include "compare/stages/block.hpp"

namespace ogc::reference {

/// Answers all questions exactly, in parallel. Marks the answers that a relative change of the coordinates by 16 · 2⁻²⁴
/// could flip.
compare::BlockTruth block(const compare::BlockIn& in);

}  // namespace ogc::reference
