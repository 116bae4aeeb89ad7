// Runs Algorithm 1. A pair's distance is taken as the larger of its computed lower bound and the gap of its boxes,
// which never exceeds the exact distance. If this gap reaches the smallest distances found so far, the pair cannot
// lower them, and may be skipped. So the order in which searches meet pairs changes no smallest distance.
//
// A search computes the smallest distances and notes each pair that may be nearer than r. Afterwards, one thread for
// each noted pair decides whether it is a contact, and with which face (collect_contacts.hpp). Few pairs need this
// decision, but its exact predicates are most of the code.
#pragma once

#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/block.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/search.hpp"
#include "fast/kernels/separation.hpp"

namespace ogc::fast {

/// Searches the tree of facets, once for each vertex. It is a Query of search.hpp.
struct DetectVertexFacet {
  SurfaceView surface;
  PaddedVecs positions;       ///< of the detection, by vertex [m]
  TreeView tree;              ///< of all facets, refitted at these positions
  const int* vertex_order;    ///< vertices in the order of a Hilbert curve
  const float* vertex_limit;  ///< by vertex: gap limit of its reach [m²]
  ListsView lists;            ///< pairs are noted here; nothing is searched if its overflow flag is set
  float contact_radius;       ///< r, with the contact margin [m]
  float* d_min_vertex;        ///< by vertex: smallest distance [m], at most r_q before the launch; lowered
  float* d_min_triangle;      ///< by triangle: smallest distance [m], at most r_q before the launch; lowered

  /// Returns whether a list has overflowed.
  OGC_HD bool is_off() const { return *lists.overflow != 0; }

  /// Returns the position from which v searches. A vertex that is not on the surface gets a point so far away that all
  /// boxes are beyond the limit, although squared gaps to the boxes are still finite.
  OGC_HD Vec searched_from(int v) const {
    return surface.is_off_surface(v) ? Vec{0x1p60f, 0x1p60f, 0x1p60f} : positions[v];
  }

  /// Returns the search of the i-th vertex along the Hilbert curve.
  OGC_HD Search begin(int i) const {
    const int v = vertex_order[i];
    const Vec x = searched_from(v);
    return {{x, x}, v, 0, larger(gap_limit(contact_radius), vertex_limit[v])};
  }

  /// Returns the squared distance up to which the pair matters. The result is negative if the boxes are farther apart,
  /// or if vertex and facet form no pair (method.md §2.3).
  OGC_HD float candidate_limit(const Search& search, const Offer& offer) const {
    const int v = search.owner;
    const Facet& facet = surface.facets[offer.primitive];
    if (facet.corner[0] == v || facet.corner[1] == v || facet.corner[2] == v || surface.left_out(v, facet))
      return -1.0F;
    const float within = limit(search, offer);
    return offer.gap > within ? -1.0F : within;
  }

  /// Returns whether the distance of the pair must be computed.
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    const float within = candidate_limit(search, offer);
    if (within < 0) return false;
    const int t = offer.primitive;
    return !is_beyond(separation(search.box.lower, corners(surface.facets[t])), within);
  }

  /// Returns false, because the distance of each pair is needed.
  OGC_HD bool is_idle(const Search&, const Offer&, float) const { return false; }

  /// Computes the distance of the pair, lowers the smallest distances of vertex and facet, and returns the new limit of
  /// the search.
  OGC_HD float meet(const Search& search, int t, float gap) const {
    return gap_limit(larger(contact_radius, measure(search.owner, t, gap)));
  }

 protected:
  OGC_HD float limit(const Search& search, const Offer& offer) const {
    const float own = larger(contact_radius, atomic_load(&d_min_vertex[search.owner])),
                theirs = atomic_load(&d_min_triangle[offer.primitive]);
    return larger(smaller(search.limit, gap_limit(own)), smaller(offer.reach, gap_limit(theirs)));
  }

  /// Lowers the smallest distances of vertex and facet to the distance of the pair, and notes the pair if it may be a
  /// contact. Returns a lower bound of the distance.
  OGC_HD float measure(int v, int t, float gap) const {
    const Distance d = point_triangle_distance(positions[v], corners(surface.facets[t]));
    const float below = larger(d.below(), gap_below(gap));
    lower(&d_min_vertex[v], below);
    lower(&d_min_triangle[t], below);
    if (d.may_be_within(contact_radius)) lists.note({~v, t}, d.is_surely_within(contact_radius));
    return below;
  }

  OGC_HD Corners corners(const Facet& t) const {
    return {positions[t.corner[0]], positions[t.corner[1]], positions[t.corner[2]]};
  }
};

/// Returns the contact of a vertex and a facet; its bucket is −1 if they have none. `certain`: they are certainly
/// nearer than r. If several facets share the closest face, each of them generates this contact, and the lists keep
/// one.
struct CollectVertexFacet {
  SurfaceView surface;
  PaddedVecs positions;  ///< of the detection, by vertex [m]
  float contact_radius;  ///< r, with the contact margin [m]

  OGC_HD RawContact operator()(int v, int t, bool certain) const {
    constexpr RawContact none{-1, -1, -1, -1};
    const Facet facet = surface.facets[t];
    const Vec x = positions[v];
    const Corners corners{positions[facet.corner[0]], positions[facet.corner[1]], positions[facet.corner[2]]};
    const TriangleFeature feature = closest_feature(x, corners, facet.descending);
    const auto is_near = [x, corners, feature, r = contact_radius] {
      return is_within(x, corners, feature, point_triangle_distance(x, corners), r);
    };
    if (!certain && !called(is_near)) return none;
    if (feature == TriangleFeature::interior) return {v, surface.triangle_face(t), -1, -1};
    if (feature <= TriangleFeature::corner_2) {
      const int a = facet.corner[static_cast<int>(feature)];
      return in_vertex_block(x, a, surface, positions) ? RawContact{v, surface.vertex_face(a), -1, -1} : none;
    }
    const int e = facet.edge[static_cast<int>(feature) - static_cast<int>(TriangleFeature::edge_01)];
    return in_edge_block(x, e, surface, positions) ? RawContact{v, surface.edge_face(e), -1, -1} : none;
  }
};

}  // namespace ogc::fast
