// Questions for stage block about a mesh: mostly of neighbours, where blocks end.
#pragma once

#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/mesh.hpp"
#include "compare/stages/block.hpp"

namespace ogc::compare {

/// Up to `count` legal questions (compare/stages/block.hpp); fewer where the mesh is too small to ask.
std::vector<BlockQuestion> block_questions(Random& random, const Topology& topology,
                                           const std::vector<Vec3f>& positions, int count);

}  // namespace ogc::compare
