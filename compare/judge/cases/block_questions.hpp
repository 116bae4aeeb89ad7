// Makes questions about a mesh for stage block. Most concern neighbouring faces, where blocks end.
#pragma once

#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/mesh.hpp"
#include "compare/stages/block.hpp"

namespace ogc::compare {

/// Returns up to `count` legal questions (compare/stages/block.hpp), fewer if the mesh is too small.
std::vector<BlockQuestion> block_questions(Random& random, const Topology& topology,
                                           const std::vector<Vec3f>& positions, int count);

}  // namespace ogc::compare
