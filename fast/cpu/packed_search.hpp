// Runs searches of one thread. They collect candidates and compute lower bounds of four distances at a time, which
// equal the bounds of `separation` (tests/fast/cpu/pack.cpp). No result depends on how many pairs these bounds reject.
#pragma once

#include "fast/cpu/local_lists.hpp"
#include "fast/cpu/packed_gaps.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast::packed {

/// Returns four positions, one in each lane.
inline Vector<Pack> gathered(PaddedVecs positions, int a, int b, int c, int d) {
  const PaddedVec* const vertex[4] = {&positions.at[a], &positions.at[b], &positions.at[c], &positions.at[d]};
  return transposed<Pack>(vertex);
}

/// Returns lower bounds of the distances of an edge from four others, equal to those of `separation` [m].
inline Pack separations(const DetectEdgeEdge& query, const Search& search, const int* primitive) {
  const EdgeEnds own = query.surface.edges[search.owner];
  EdgeEnds other[Pack::width];
  for (int k = 0; k < Pack::width; ++k) other[k] = query.surface.edges[primitive[k]];
  const PaddedVecs x = query.positions;
  return separation(EndsOf<Pack>{everywhere<Pack>(x[own.a]), everywhere<Pack>(x[own.b])},
                    EndsOf<Pack>{gathered(x, other[0].a, other[1].a, other[2].a, other[3].a),
                                 gathered(x, other[0].b, other[1].b, other[2].b, other[3].b)});
}

/// Returns lower bounds of the distances of a vertex from four facets [m].
inline Pack separations(const DetectVertexFacet& query, const Search& search, const int* primitive) {
  const int* corner[Pack::width];
  for (int k = 0; k < Pack::width; ++k) corner[k] = query.surface.facets[primitive[k]].corner;
  const auto at = [&](int i) {
    return gathered(query.positions, corner[0][i], corner[1][i], corner[2][i], corner[3][i]);
  };
  return separation(everywhere<Pack>(search.box.lower), CornersOf<Pack>{at(0), at(1), at(2)});
}

/// Collects candidates of a search until there are four.
template <class Query>
struct Waiting {
  const Query& query;                     ///< writes pairs to `notes`
  LocalNotes& notes;                      ///< notes of the thread
  Search& search;                         ///< search of the candidates; distances lower its limit
  int primitive[Pack::width], count = 0;  ///< the first `count` are used
  /// by candidate [m²]: Offer::gap, Offer::reach, and the result of candidate_limit
  float gap[Pack::width], reach[Pack::width], within[Pack::width];

  /// Adds a candidate. Tests all candidates when there are four.
  void take(const Offer& offer) {
    const float limit = query.candidate_limit(search, offer);
    if (limit < 0) return;
    primitive[count] = offer.primitive, gap[count] = offer.gap, reach[count] = offer.reach, within[count] = limit;
    if (++count == Pack::width) look();
  }

  /// Tests all candidates that have been collected.
  void look() {
    if (count == 0) return;
    notes.expect(count);
    for (int k = count; k < Pack::width; ++k) primitive[k] = primitive[0];
    float apart[Pack::width];
    separations(query, search, primitive).store(apart);
    for (int k = 0; k < count; ++k) {
      if (is_beyond(apart[k], within[k]) || query.is_idle(search, {primitive[k], gap[k], reach[k]}, apart[k])) continue;
      search.limit = smaller(search.limit, query.meet(search, primitive[k], gap[k]));
    }
    count = 0;
  }
};

/// Runs searches begin … end − 1 in this thread.
template <class Query>
void run_searches(const Searches<Query>& searches, int begin, int end) {
  if (searches.query.is_off()) return;
  LocalNotes notes(searches.query.lists);
  Query query = searches.query;
  query.lists = notes.view();
  for (int i = begin; i < end; ++i) {
    Search search = searches.begin(i);
    Waiting<Query> waiting{.query = query,
                           .notes = notes,
                           .search = search,
                           .primitive = {},
                           .count = 0,
                           .gap = {},
                           .reach = {},
                           .within = {}};
    for_each_near(searches.tree, search.box, search.from, search.limit,
                  [&](const Offer& offer) { waiting.take(offer); });
    waiting.look();
  }
}

}  // namespace ogc::fast::packed
