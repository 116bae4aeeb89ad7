// Colours the free vertices once on the host; the result is deterministic. No two vertices of a membrane or bending
// stencil, a spring, a tetrahedron or a segment share a colour, and neither do neighbouring segments of a rod. So only
// contacts are Jacobi within a colour (method.md §7.3). A colour costs a launch and a dependency chain, whatever its
// size. So the number of colours is reduced first: greedily (DSATUR), then greedily class by class, which never adds a
// colour and often removes some. Balancing comes last.
#pragma once

#include <vector>

#include "compare/problem/mesh.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// The free vertices, or segments, by colour.
struct Colouring {
  int count = 0;              ///< number of colours
  std::vector<int> colour;    ///< by vertex; −1 if it is not free
  std::vector<int> order;     ///< free vertices, by colour, then by number
  std::vector<int> begin{0};  ///< colour c is order[begin[c] .. begin[c + 1])
};

/// Returns, by vertex, its index in `order`; vertices that are not free follow by number.
std::vector<int> row_places_of(const Colouring& colouring);

/// Returns the conflicts: row v has, ascending, the free vertices that share a membrane or bending stencil, a spring, a
/// tetrahedron or a segment with v. Rows of vertices that are not free are empty.
compare::CompressedRows conflict_graph(const RestState& rest);

/// Returns the number of passes that try to remove colours: 4 to 100, such that all passes together visit about 2·10⁷
/// neighbours, which takes a second. One pass visits `neighbours` neighbours, the length of all rows.
int colouring_passes(std::size_t neighbours);

/// Colours the vertices with Mobility::free.
Colouring colour_vertices(const RestState& rest);

/// Colours the free segments. The number of colours is two for open chains, three for an odd ring, and zero without
/// segments.
Colouring colour_segments(const RodsAtRest& rods);

}  // namespace ogc::fast
