// Runs Algorithm 2 once for each pair: the edge at place i of the tree order only searches later places, and a distance
// lowers the smallest distances of both edges. As in detect_vertex_facet.hpp, pairs may be skipped, and contacts are
// decided after the searches. Pairs that block.hpp proves to be no contact are not noted.
#pragma once

#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/block.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/search.hpp"
#include "fast/kernels/separation.hpp"

namespace ogc::fast {

/// Searches the tree of edges, once for each edge. It is a Query of search.hpp.
struct DetectEdgeEdge {
  SurfaceView surface;
  PaddedVecs positions;  ///< of the detection, by vertex [m]
  TreeView tree;         ///< of all edges, refitted at these positions
  ListsView lists;       ///< pairs are noted here; nothing is searched if its overflow flag is set
  float contact_radius;  ///< r, with the contact margin [m]
  float* d_min_edge;     ///< by edge: smallest distance [m], at most r_q before the launch; lowered

  /// Returns whether a list has overflowed.
  OGC_HD bool is_off() const { return *lists.overflow != 0; }

  /// Returns the search of the edge at place i in the order of the tree. It visits only the places after i.
  OGC_HD Search begin(int i) const {
    const Child child = tree.node(0, i / 4).child[i % 4];
    return {.box = child.box(),
            .owner = child.primitive,
            .from = i + 1,
            .limit = larger(gap_limit(contact_radius), child.reach),
            .reach = child.reach};
  }

  /// Returns the squared distance up to which the pair matters. The result is negative if the boxes are farther apart,
  /// or if the edges form no pair (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    const EdgeEnds p = surface.edges[search.owner], q = surface.edges[offer.primitive];
    if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b || surface.left_out(p, q)) return -1.0F;
    const float within = limit(search, offer);
    return offer.gap > within ? -1.0F : within;
  }

  /// Returns whether the distance of the pair must be computed.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    if (within < 0) return false;
    const int other = offer.primitive;
    const float apart = separation(ends(surface.edges[search.owner]), ends(surface.edges[other]));
    return !is_beyond(apart, within) && !is_idle(search, offer, apart);
  }

  /// Returns whether the distance of a pair is not needed: it lowers no smallest distance, and the pair is no contact.
  /// `apart` is a lower bound of the distance [m].
  OGC_HD bool is_idle(const Search& search, const Offer& offer, float apart) const {
    const float own = atomic_load(&d_min_edge[search.owner]), theirs = atomic_load(&d_min_edge[offer.primitive]);
    const float lowering = larger(smaller(search.reach, gap_limit(own)), smaller(offer.reach, gap_limit(theirs)));
    if (!(offer.gap > lowering) && !is_beyond(apart, lowering)) return false;
    return search.owner < offer.primitive ? is_none(search.owner, offer.primitive)
                                          : is_none(offer.primitive, search.owner);
  }

  /// Computes the distance of the pair, lowers the smallest distances of both edges, and returns the new limit of the
  /// search.
  OGC_HD float meet(const Search& search, int other, float gap) const {
    const int e = search.owner, low = e < other ? e : other, high = e < other ? other : e;
    return gap_limit(larger(contact_radius, measure(low, high, gap)));
  }

 protected:
  OGC_HD float limit(const Search& search, const Offer& offer) const {
    const float own = larger(contact_radius, atomic_load(&d_min_edge[search.owner])),
                theirs = atomic_load(&d_min_edge[offer.primitive]);
    return larger(smaller(search.limit, gap_limit(own)), smaller(offer.reach, gap_limit(theirs)));
  }

  /// Lowers the smallest distances of both edges to the distance of the pair, and notes the pair if it may be a
  /// contact. Returns a lower bound of the distance; low < high.
  OGC_HD float measure(int low, int high, float gap) const {
    const Distance d = edge_edge_distance(ends(surface.edges[low]), ends(surface.edges[high]));
    const float below = larger(d.below(), gap_below(gap));
    lower(&d_min_edge[low], below);
    lower(&d_min_edge[high], below);
    if (d.may_be_within(contact_radius) && !is_none(low, high))
      lists.note({low, high}, d.is_surely_within(contact_radius));
    return below;
  }

  /// Returns whether the pair is certainly no contact; low < high.
  OGC_HD bool is_none(int low, int high) const {
    return is_surely_no_contact(surface.edges[low], surface.edges[high], surface, positions);
  }

  OGC_HD Ends ends(const EdgeEnds& e) const { return {positions[e.a], positions[e.b]}; }
};

/// Returns the contact of two edges, low < high; its bucket is −1 if they have none. `certain`: they are certainly
/// nearer than r.
struct CollectEdgeEdge {
  SurfaceView surface;
  PaddedVecs positions;  ///< of the detection, by vertex [m]
  float contact_radius;  ///< r, with the contact margin [m]

  OGC_HD RawContact operator()(int low, int high, bool certain) const {
    constexpr RawContact none{-1, -1, -1, -1};
    const EdgeEnds p = surface.edges[low], q = surface.edges[high];
    const Ends first{positions[p.a], positions[p.b]}, second{positions[q.a], positions[q.b]};
    const EdgePairFeatures on = closest_edge_features(first, second);
    const auto is_near = [first, second, on, r = contact_radius] {
      return is_within(first, second, on, edge_edge_distance(first, second), r);
    };
    if (!certain && !called(is_near)) return none;
    const bool hit = is_hit(p, q, on);
    if (is_overlapping_parallel(first, second)) {
      const auto is_hit_elsewhere = [*this, p, q] { return is_hit_beside(p, q); };
      const bool counts = hit || (is_loose(low) && is_loose(high)) || called(is_hit_elsewhere);
      return counts ? contact(surface.edge_face(low), surface.edge_face(high), low, high) : none;
    }
    if (!hit) return none;
    const int v = end_of(p, on.first), w = end_of(q, on.second);
    return contact(v < 0 ? surface.edge_face(low) : v, w < 0 ? surface.edge_face(high) : w, low, high);
  }

 private:
  /// Returns whether no triangle contains the edge.
  OGC_HD bool is_loose(int e) const { return surface.opposites.offsets[e] == surface.opposites.offsets[e + 1]; }

  /// Returns the vertex of a feature; −1 for the interior.
  OGC_HD static int end_of(const EdgeEnds& e, EdgeFeature feature) {
    return feature == EdgeFeature::interior ? -1 : feature == EdgeFeature::end_0 ? e.a : e.b;
  }

  /// Returns whether the block of each side holds the closest point of the other side (Eq. 14, 15). `on` are the faces
  /// that hold these points. The block of an edge's interior always holds the other side's point.
  OGC_HD bool is_hit(const EdgeEnds& p, const EdgeEnds& q, EdgePairFeatures on) const {
    const int v = end_of(p, on.first), w = end_of(q, on.second);
    return (v < 0 || is_end_hit(v, w < 0, w, q)) && (w < 0 || is_end_hit(w, v < 0, v, p));
  }

  /// Returns whether is_hit is true for another pair of faces of two nearly parallel edges: for two ends, or for an end
  /// that projects into the interior of the other edge. If the edges are exactly parallel, these pairs include both
  /// ends of the overlap. If is_hit is true for such a pair, no other points of the edges are nearer. The reason is
  /// that the block of an end excludes all points that project onto the end's own edge.
  OGC_HD bool is_hit_beside(const EdgeEnds& p, const EdgeEnds& q) const {
    for (int i = 0; i < 2; ++i) {
      const auto end = static_cast<EdgeFeature>(i);
      if (is_hit(p, q, {end, EdgeFeature::end_0, true}) || is_hit(p, q, {end, EdgeFeature::end_1, true})) return true;
      if (is_beside(end_of(p, end), q) && is_hit(p, q, {end, EdgeFeature::interior, true})) return true;
      if (is_beside(end_of(q, end), p) && is_hit(p, q, {EdgeFeature::interior, end, true})) return true;
    }
    return false;
  }

  /// Returns whether the vertex projects into the interior of the edge.
  OGC_HD bool is_beside(int v, const EdgeEnds& e) const {
    const Vec x = positions[v], a = positions[e.a], b = positions[e.b];
    return exact_sign(End{x, a, b}) > 0 && exact_sign(End{x, b, a}) > 0;
  }

  /// Returns whether the point of edge `other` closest to v lies in the block of v (Eq. 15). If `is_other_inside` is
  /// true, this point is in the interior of `other`; otherwise this point is the end w of `other`.
  OGC_HD bool is_end_hit(int v, bool is_other_inside, int w, const EdgeEnds& other) const {
    return is_other_inside ? in_vertex_block(other, v, surface, positions)
                           : in_vertex_block(positions[w], v, surface, positions);
  }

  OGC_HD RawContact contact(int p, int q, int low, int high) const {
    const int first = p < q ? p : q, second = p < q ? q : p;
    return {surface.vertex_count + first, second, low, high};
  }
};

}  // namespace ogc::fast
