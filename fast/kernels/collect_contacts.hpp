// Decides which of the noted pairs are contacts, one thread for each pair, after the searches have ended.
#pragma once

#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/kernels/detect_vertex_facet.hpp"

namespace ogc::fast {

/// Enters the contacts of noted pairs in the lists. Runs once for each noted pair.
struct CollectContacts {
  /// 4 blocks limit a thread to 128 registers; with 6 blocks, spilled registers cost more than the added warps gain
  /// (fast/PERFORMANCE.md)
  static constexpr int resident_blocks = 4;
  CollectVertexFacet vertex_facet;  ///< decides pairs with first = ~vertex < 0
  /// decides pairs of edges
  CollectEdgeEdge edge_edge;
  ListsView lists;  ///< contacts are entered here; nothing is done if the overflow flag is set
  /// distance of each noted pair, rounded down [m]; null unless the search also notes pairs beyond r, for their planes
  const float* distances = nullptr;

  /// A noted pair with its distance; without `distances` the distance is 0.
  struct Loaded {
    NotedPair pair;
    float distance;
  };

  OGC_HD Loaded load(int i) const { return {lists.noted[i], distances != nullptr ? distances[i] : 0.0f}; }
  OGC_HD void operator()(int i) const { (*this)(i, load(i)); }
  OGC_HD void operator()(int, const Loaded& noted) const {
    if (*lists.overflow != 0) return;
    const RawContact found = contact(noted);
    // one call for both kinds of pairs, so that threads of a warp execute it together
    if (found.bucket >= 0) lists.enter(found, {edge_edge.surface});
  }

  /// Returns the contact of the i-th pair; its bucket is −1 if there is none.
  OGC_HD RawContact contact(int i) const { return contact(load(i)); }

  /// Returns the vertices of both sides of the i-th pair.
  OGC_HD RoleVertices vertices(int i) const {
    const NotedPair pair = lists.noted[i];
    const int second = pair.second < 0 ? ~pair.second : pair.second;
    const SurfaceView& surface = edge_edge.surface;
    if (pair.first < 0) {
      const int* corner = surface.facets[second].corner;
      return {{~pair.first, corner[0], corner[1], corner[2]}};
    }
    const EdgeEnds p = surface.edges[pair.first], q = surface.edges[second];
    return {{p.a, p.b, q.a, q.b}};
  }

 private:
  OGC_HD RawContact contact(const Loaded& noted) const {
    if (!(noted.distance < edge_edge.contact_radius)) return {-1, -1, -1, -1};
    const NotedPair pair = noted.pair;
    const bool certain = pair.second < 0;
    const int second = certain ? ~pair.second : pair.second;
    return pair.first < 0 ? vertex_facet(~pair.first, second, certain) : edge_edge(pair.first, second, certain);
  }
};

}  // namespace ogc::fast
