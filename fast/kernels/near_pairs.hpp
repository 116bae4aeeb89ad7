// Defines the searches of a detection that computes planes. Whether a pair has a plane depends on the N + 1 nearest
// pairs of each of its vertices. So the searches note all pairs of a vertex within r_q, or within a smaller distance if
// N + 1 of its pairs are known to lie within it (LimitSearches, plane_lists.hpp). No pair beyond that distance changes
// a result.
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// Searches the tree of facets, once for each vertex. It is a Query of search.hpp.
struct NearVertexFacet : DetectVertexFacet {
  /// Returns the search of the i-th vertex along the Hilbert curve. Its limit is the vertex's gap limit and does not
  /// fall.
  OGC_HD Search begin(int i) const {
    const int v = vertex_order[i];
    const Vec x = searched_from(v);
    return {{x, x}, v, 0, vertex_limit[v]};
  }

  /// Returns the larger gap limit of vertex and facet. The result is negative if the boxes are farther apart, or if
  /// vertex and facet form no pair (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    const float within = larger(search.limit, offer.reach);
    if (offer.gap > within) return -1.0F;
    const int v = search.owner;
    const Facet& facet = surface.facets[offer.primitive];
    if (facet.corner[0] == v || facet.corner[1] == v || facet.corner[2] == v || surface.left_out(v, facet))
      return -1.0F;
    return within;
  }

  /// Returns whether the pair may be within the limit; computes only a lower bound of its distance.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    if (within < 0) return false;
    return !is_beyond(separation(search.box.lower, corners(surface.facets[offer.primitive])), within);
  }

  /// Notes the pair, whose distance MeasurePairs computes. Returns the unchanged limit.
  OGC_HD float meet(const Search& search, int t, float) const {
    lists.note({~search.owner, t}, false);
    return search.limit;
  }
};

/// Searches the tree of edges, once for each edge. It meets each pair once, as DetectEdgeEdge does.
struct NearEdgeEdge : DetectEdgeEdge {
  /// Returns the search of the edge at place i of the tree. It covers the places after i. Its limit is the edge's gap
  /// limit and does not fall.
  OGC_HD Search begin(int i) const {
    const Child child = tree.node(0, i / 4).child[i % 4];
    return {child.box(), child.primitive, i + 1, child.reach};
  }

  /// Returns the larger gap limit of both edges. The result is negative if the boxes are farther apart, or if the edges
  /// form no pair (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    const float within = larger(search.limit, offer.reach);
    if (offer.gap > within) return -1.0F;
    const EdgeEnds p = surface.edges[search.owner], q = surface.edges[offer.primitive];
    if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b || surface.left_out(p, q)) return -1.0F;
    return within;
  }

  /// Returns whether the pair may be within the limit; computes only a lower bound of its distance.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    if (within < 0) return false;
    return !is_beyond(separation(ends(surface.edges[search.owner]), ends(surface.edges[offer.primitive])), within);
  }

  /// Returns false, because every pair is noted.
  OGC_HD bool is_idle(const Search&, const Offer&, float) const { return false; }

  /// Notes the pair, whose distance MeasurePairs computes. Returns the unchanged limit.
  OGC_HD float meet(const Search& search, int other, float) const {
    const int low = search.owner < other ? search.owner : other, high = search.owner < other ? other : search.owner;
    lists.note({low, high}, false);
    return search.limit;
  }
};

}  // namespace ogc::fast
