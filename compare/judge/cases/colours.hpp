// Colours the vertices and segments of a sweep's question. The judge chooses the colours, so that no contestant
// influences the question.
#pragma once

#include <set>
#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// The vertices (or segments) that must differ in colour from each vertex (or segment).
using Neighbours = std::vector<std::set<Index>>;

/// Returns for each vertex all vertices that share an element with it; materials do not matter.
Neighbours element_neighbours(const Scene& scene, const Topology& topology);
/// Returns the neighbours of each segment. Two segments are neighbours if they share a vertex and no third segment has
/// this vertex.
Neighbours segment_neighbours(const Scene& scene);

/// Returns a colour for each free vertex and −1 for all others; no two vertices of an element share a colour. Colours
/// are assigned greedily in a random order. This gives few colours, so vertices of a contact may share one. In one of
/// eight cases each vertex has a colour of its own (pure Gauss–Seidel).
std::vector<Index> random_colours(Random& random, const Scene& scene, const Topology& topology);

/// Returns a colour for each free segment of a rod and −1 for all others; no two neighbours share a colour.
std::vector<Index> random_segment_colours(Random& random, const Scene& scene);

}  // namespace ogc::compare
