// Colours the questions about a sweep. The judge does it itself, so that no contestant chooses its question.
#pragma once

#include <set>
#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// For each vertex or segment, those that may not have its colour.
using Neighbours = std::vector<std::set<Index>>;

/// Returns, for each vertex, those that share an element with it, whatever the materials are.
Neighbours element_neighbours(const Scene& scene, const Topology& topology);
/// Returns the neighbours of each segment.
Neighbours segment_neighbours(const Scene& scene);

/// Returns colours of free vertices, −1 for all others; no two vertices of an element share one. Colours are greedy in
/// a random order: few, so that contacts meet inside one. In one of eight cases each vertex has its own colour: pure
/// Gauss–Seidel.
std::vector<Index> random_colours(Random& random, const Scene& scene, const Topology& topology);

/// Returns colours of the segments of rods that nothing holds, −1 for all others; no two neighbours share one.
std::vector<Index> random_segment_colours(Random& random, const Scene& scene);

}  // namespace ogc::compare
