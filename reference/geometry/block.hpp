// Stage block: membership in the blocks of Eq. 8–10, 14 and 15.
#pragma once

#include "compare/stages/block.hpp"

namespace ogc::reference {

/// Returns the exact answers, and which of them a relative change of 16 u of the coordinates could turn. Answers all
/// questions, in parallel over them.
compare::BlockTruth block(const compare::BlockIn& in);

}  // namespace ogc::reference
