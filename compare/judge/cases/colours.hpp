// Colours for questions about a sweep: the judge's own, so that no contestant chooses its question.
#pragma once

#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Of the free vertices, -1 of all others; no two vertices of a triangle or hinge share one. Greedy in a random order:
/// few colours, so that contacts meet inside one; in one of eight a colour for each vertex: pure Gauss–Seidel.
std::vector<Index> random_colours(Random& random, const Scene& scene, const Topology& topology);

/// Of the segments of rods that nothing holds, −1 of all others; no two neighbours share one.
std::vector<Index> random_segment_colours(Random& random, const Scene& scene);

}  // namespace ogc::compare
