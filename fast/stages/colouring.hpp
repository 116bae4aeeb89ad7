// Colours of the free vertices: no two vertices of one membrane or bending stencil, of a spring, a tetrahedron or a
// segment share one, nor do two segments of a rod that are neighbours, so that within a colour only contacts are Jacobi
// (method.md §7.3). Computed once on the host, deterministic. A colour costs a launch and a dependency chain whatever
// its size, so the number of colours counts first: DSATUR-like greedy, then greedy again class by class (which never
// adds a colour and often removes some), then balance.
#pragma once

#include <vector>

#include "compare/problem/mesh.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// The free vertices, or segments, colour by colour.
struct Colouring {
  int count = 0;              ///< number of colours
  std::vector<int> colour;    ///< of each vertex; -1 where it is not free
  std::vector<int> order;     ///< free vertices by colour, then number
  std::vector<int> begin{0};  ///< colour c is order[begin[c] .. begin[c + 1])
};

/// Returns in row v the free vertices that share a membrane or bending stencil, a spring, a tetrahedron or a segment
/// with v, ascending; rows of vertices that are not free are empty.
compare::CompressedRows conflict_graph(const RestState& rest);

/// Returns the number of passes that reduce the number of colours: as many as visit 2·10⁷ neighbours, which takes about
/// a second, but at least 4 and at most 100. `neighbours`: all neighbours of all vertices.
int colouring_passes(std::size_t neighbours);

/// Colours the vertices with Mobility::free.
Colouring colour_vertices(const RestState& rest);

/// Colours the segments that nothing holds: with two colours on an open chain, three on an odd ring, none if there are
/// none.
Colouring colour_segments(const RodsAtRest& rods);

}  // namespace ogc::fast
