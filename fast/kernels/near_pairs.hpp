// Defines the searches of a detection that computes planes. They note every pair within r_q, even if its vertices have
// nearer pairs: whether a pair has a plane depends on all pairs of its vertices.
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// Searches the tree of facets, once for each vertex. It is a Query of search.hpp.
struct NearVertexFacet : DetectVertexFacet {
  const float* query_radius;  ///< r_q [m], on the backend

  /// Returns the search of the i-th vertex along the Hilbert curve. Its limit is the gap limit of r_q and does not
  /// fall.
  OGC_HD Search begin(int i) const {
    const int v = vertex_order[i];
    const Vec x = searched_from(v);
    return {{x, x}, v, 0, gap_limit(*query_radius)};
  }

  /// Returns the gap limit of r_q. The result is negative if the boxes are farther apart, or if vertex and facet form
  /// no pair (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    if (offer.gap > search.limit) return -1.0F;
    const int v = search.owner;
    const Facet& facet = surface.facets[offer.primitive];
    if (facet.corner[0] == v || facet.corner[1] == v || facet.corner[2] == v || surface.left_out(v, facet))
      return -1.0F;
    return search.limit;
  }

  /// Returns whether the pair may be within r_q; computes only a lower bound of its distance.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    if (candidate_limit(search, offer) < 0) return false;
    return !is_beyond(separation(search.box.lower, corners(surface.facets[offer.primitive])), search.limit);
  }

  /// Notes the pair if it may be nearer than r_q. The pair is noted as certain if it is certainly nearer than r.
  /// Returns the unchanged limit.
  OGC_HD float meet(const Search& search, int t, float) const {
    const Distance d = point_triangle_distance(search.box.lower, corners(surface.facets[t]));
    if (d.may_be_within(*query_radius)) lists.note({~search.owner, t}, d.is_surely_within(contact_radius));
    return search.limit;
  }
};

/// Searches the tree of edges, once for each edge. It meets each pair once, as DetectEdgeEdge does.
struct NearEdgeEdge : DetectEdgeEdge {
  const float* query_radius;  ///< r_q [m], on the backend

  /// Returns the search of the edge at place i of the tree. It covers the places after i, and its limit does not fall.
  OGC_HD Search begin(int i) const {
    const Child child = tree.node(0, i / 4).child[i % 4];
    return {child.box(), child.primitive, i + 1, gap_limit(*query_radius)};
  }

  /// Returns the gap limit of r_q. The result is negative if the boxes are farther apart, or if the edges form no pair
  /// (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    if (offer.gap > search.limit) return -1.0F;
    const EdgeEnds p = surface.edges[search.owner], q = surface.edges[offer.primitive];
    if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b || surface.left_out(p, q)) return -1.0F;
    return search.limit;
  }

  /// Returns whether the pair may be within r_q; computes only a lower bound of its distance.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    if (candidate_limit(search, offer) < 0) return false;
    return !is_beyond(separation(ends(surface.edges[search.owner]), ends(surface.edges[offer.primitive])),
                      search.limit);
  }

  /// Returns false, because every pair is noted.
  OGC_HD bool is_idle(const Search&, const Offer&, float) const { return false; }

  /// Notes the pair if it may be nearer than r_q, as NearVertexFacet::meet does. Returns the unchanged limit.
  OGC_HD float meet(const Search& search, int other, float) const {
    const int low = search.owner < other ? search.owner : other, high = search.owner < other ? other : search.owner;
    const Distance d = edge_edge_distance(ends(surface.edges[low]), ends(surface.edges[high]));
    if (d.may_be_within(*query_radius)) lists.note({low, high}, d.is_surely_within(contact_radius));
    return search.limit;
  }
};

}  // namespace ogc::fast
