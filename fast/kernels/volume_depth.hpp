// Finds whether a point is inside a volume, or nearer to it than r (§3.9, method.md §9). Each connected part of the
// surface is tested separately: the point is inside if it lies on the inner side of the part's nearest face. The search
// starts with the distance to any facet of the part, so it finds this face at any depth.
//
// The side of x at a face, all in rounded double:
//
//   triangle   the side of its normal
//   edge       the side of the sum of its triangles' unit normals. Points whose closest point is on the edge are all
//              outside at a ridge and all inside at a valley; the line of the sum bisects the region of these points
//   vertex     the side at one edge of the vertex: the edge whose direction is nearest to the direction of x. On the
//              sphere about the vertex, the arc from x to this edge crosses no triangle: a crossing would be nearer
//   rim        outside: an edge of only one triangle, and a vertex of such an edge, have no inner side
//
// A point outside the box of a part is not inside the part, so for most points few parts are searched.
//
// A driven volume stands still between two detections of a step, and most points far from it move little. If a search
// finds that a point p in the part's box is far (outside, and not nearer than r), it also computes a radius ρ such that
// all points within ρ of p are far. Let D be the distance of p and c its closest point. Let d_t be a lower bound of the
// distance of p to facet t, and h_t the height of p over the plane of t. A point x within ρ < D − r of p is farther
// than r from the part, and its distance is at most D + ρ. So the facets around the nearest face of x are at most D + 2
// ρ from p. If (d_t − D)/2 > ρ or h_t > ρ for every facet t, x lies on the outer side of all these facets. Then x also
// lies on the outer side of an edge or vertex among them, unless two normals are nearly opposite. To exclude this, h_t
// is used only if the cosine between the normal of t and p − c exceeds 2⁻⁸.
//
// Rounding: the face that the search finds may be farther than the nearest one by two slacks of
// point_triangle_distance, each at most 2⁻²³ S, with S as defined there. For p and for x, S is at most six times the
// 1-norm L of the box's extent, so this is 2⁻¹⁹ L. Heights refer to the planes of is_outside, whose normals err by 2⁻³⁰
// unless the facet is a sliver. The squares in ClearBall::holds err by 2⁻²² ρ, ρ ≤ L. The code uses 2⁻¹⁸ L, which
// covers all of this.
#pragma once

#include "fast/kernels/block.hpp"
#include "fast/kernels/bvh.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/separation.hpp"

namespace ogc::fast {

/// Holds a tree and the data that its refit needs.
struct PartTree {
  TreeView tree;            ///< refitted at the positions of the volume's vertices
  int* arrivals = nullptr;  ///< counters of its nodes, as in RefitTrees
  int first_item = 0;       ///< index of its first item in a launch that refits all trees, each padded to whole warps
};

/// Holds the trees of one connected part of a volume, so that a search of this part meets no facet of another part.
struct VolumePart {
  PartTree facets;
  PartTree tetrahedra;  ///< empty if the part is a surface

  OGC_HD bool is_solid() const { return tetrahedra.tree.count > 0; }
};

/// Holds the tetrahedra of volumes on the backend.
struct SolidView {
  const SolidElement* elements = nullptr;  ///< by tetrahedron
  std::uint8_t* is_positive = nullptr;     ///< by tetrahedron: whether its volume is positive; written by the refit
  Rows vertex_elements;                    ///< by vertex: tetrahedra that contain it, ascending
  const int* owner = nullptr;              ///< by facet: the tetrahedron that has the facet as a side
};

/// Holds a volume, or all volumes of a scene, on the backend.
struct VolumeView {
  SurfaceView surface;
  PaddedVecs positions;               ///< by vertex [m]
  const VolumePart* parts = nullptr;  ///< by part
  int part_count = 0;
  float contact_radius = 0;  ///< r [m]
  SolidView solids{};        ///< for parts of tetrahedra
};

/// Position of a point relative to a part; `near`: outside, but nearer than r.
enum class VolumeSide : int { far, inside, near };

/// Holds the facet of a part that is nearest to a point. If the nearest face is an edge or a vertex, this is one of the
/// facets that contain it.
struct NearestFacet {
  int facet = -1;
  VolumeSide side = VolumeSide::far;  ///< far: outside, and not nearer than r
};

/// Holds one contact of a point with a part. c is the point of `face` that is closest to the point.
struct FoundVolumeContact {
  /// the lowest-numbered facet that contains the face; the face as one number (SurfaceView::edge_face)
  int triangle = -1, face = -1;
  bool inside = false;
  float weights[3] = {};  ///< barycentric weights of c in `triangle` [1]
  Vec direction;          ///< n, out of the part [1]
  float depth = 0;        ///< r − ‖x − c‖ outside, r + ‖x − c‖ inside [m]
};

/// Holds a ball around a point that was far from a part (outside, and not nearer than r). All points of the ball are
/// far until the volume moves.
struct alignas(16) ClearBall {
  /// Negative values of `radius`, which mean that there is no ball. `unasked`: the point was not tested since the
  /// volume moved. `asked`: the point was tested, but no ball is known. `refused`: a ball was sought, but there is
  /// none.
  static constexpr float unasked = -1, asked = -2, refused = -3;

  Vec centre;              ///< [m]
  float radius = unasked;  ///< [m]; negative: the ball is empty

  OGC_HD bool holds(const Vec& x) const {
    const Vec d = x - centre;
    return radius > 0 && add(add(mul(d.x, d.x), mul(d.y, d.y)), mul(d.z, d.z)) <= mul(radius, radius);
  }
};

/// Largest radius of a ClearBall, divided by D − r, where D is the distance of its centre from the part.
inline constexpr float clear_share = 0.125F;

class SolidQuestion;

/// Finds where a point lies relative to a volume, and the point's contacts with the volume.
class VolumeQuestion {
 public:
  OGC_HD VolumeQuestion(const VolumeView& volume, const Vec& point) : volume_(volume), x_(point) {}

  /// Returns the nearest facet of a part and the side of the point. The search starts at facet `first` of the part; it
  /// is faster if `first` is near. If the point is far but in the box of the part, a ball of far points is written to
  /// `*clear`, unless `clear` is null.
  OGC_HD NearestFacet nearest_of(int part, int first, ClearBall* clear = nullptr) const {
    const Box box = box_of(part);
    if (squared_gap(box, {x_, x_}) > gap_limit(volume_.contact_radius)) return {first, VolumeSide::far};
    const Nearest nearest = search(part, first);
    const bool in_box = is_in(box);
    if (in_box && !is_outside(nearest.face)) return {nearest.facet, VolumeSide::inside};
    if (is_near(nearest.facet, nearest.distance)) return {nearest.facet, VolumeSide::near};
    if (clear != nullptr && in_box) *clear = clear_ball(part, nearest, box);
    return {nearest.facet, VolumeSide::far};
  }

  /// Calls visit(contact) for each contact with a part; `nearest` is the result of nearest_of. A point inside has one
  /// contact, at the nearest face. A near point has one contact for each face that is nearer than r and whose outward
  /// block holds the point.
  template <class Visit>
  OGC_HD void visit_contacts(int part, const NearestFacet& nearest, Visit visit) const {
    if (nearest.side == VolumeSide::far) return;
    const int nearest_face = face_of(nearest.facet);
    if (nearest.side == VolumeSide::inside) {
      visit(contact_at(nearest_face, true));
      return;
    }
    // A near point has a contact with its nearest face, even if rounding puts it outside the face's block. Only a point
    // outside the part's box may be on the inner side of this face; such a point has no contact with the face.
    if (is_outside(nearest_face)) visit(contact_at(nearest_face, false));
    const float limit = gap_limit(volume_.contact_radius);
    for_each_near(volume_.parts[part].facets.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      const int face = touched_face(offer.primitive);
      if (face >= 0 && face != nearest_face && is_outside(face)) visit(contact_at(face, false));
    });
  }

 private:
  friend class SolidQuestion;  ///< uses the tests of faces below

  struct Nearest {
    Distance distance;
    int face = -1, facet = -1;
  };

  OGC_HD Corners corners(int t) const {
    const Facet& facet = volume_.surface.facets[t];
    return {volume_.positions[facet.corner[0]], volume_.positions[facet.corner[1]], volume_.positions[facet.corner[2]]};
  }

  /// Returns the face (vertex, edge or triangle) that holds the point of facet t closest to x, as one number.
  OGC_HD int face_of(int t) const {
    const Facet& facet = volume_.surface.facets[t];
    const TriangleFeature feature = closest_feature(x_, corners(t), facet.descending);
    const int f = static_cast<int>(feature);
    if (f < 3) return volume_.surface.vertex_face(facet.corner[f]);
    if (f < 6) return volume_.surface.edge_face(facet.edge[f - 3]);
    return volume_.surface.triangle_face(t);
  }

  /// Returns the nearest face. Among equally near faces the lowest-numbered one, which also has the lowest dimension,
  /// is taken. face_of is called only for ties and at the end, because its predicates are exact and slow.
  OGC_HD Nearest search(int part, int first) const {
    Nearest nearest;
    nearest.distance.value = infinity;
    float limit = infinity;
    const auto meet = [&](int t) {
      const Distance d = point_triangle_distance(x_, corners(t));
      if (d.value > nearest.distance.value) return;
      if (d.value == nearest.distance.value) {
        if (nearest.face < 0) nearest.face = face_of(nearest.facet);
        const int face = face_of(t);
        if (face < nearest.face) nearest.face = face, nearest.facet = t;
        return;
      }
      nearest = {d, -1, t};
      limit = gap_limit(round_up(add(d.value, d.slack)));
    };
    meet(first);
    for_each_near(volume_.parts[part].facets.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      if (offer.gap > limit || offer.primitive == first) return;
      if (!is_beyond(separation(x_, corners(offer.primitive)), limit)) meet(offer.primitive);
    });
    if (nearest.face < 0) nearest.face = face_of(nearest.facet);
    return nearest;
  }

  /// Returns a ball around x whose points are all far until the volume moves (see the head of this file); its radius is
  /// `refused` if there is none. x must be far, in the box, and on the outer side of the nearest face.
  OGC_HD ClearBall clear_ball(int part, const Nearest& nearest, const Box& box) const {
    const float doubt = mul(0x1p-18F, norm_1(box.upper - box.lower));
    const Corners at = corners(nearest.facet);
    const TriangleFeature feature = closest_feature(x_, at, volume_.surface.facets[nearest.facet].descending);
    const Real away = unit(feature == TriangleFeature::interior ? normal(nearest.facet) : from_foot(at, feature));
    const Distance& d = nearest.distance;
    const float above = round_up(add(d.value, d.slack)),
                free = sub(round_down(sub(d.value, d.slack)), volume_.contact_radius);
    float radius = smaller(mul(clear_share, free), sub(free, mul(2, doubt))), limit = -1;
    const auto set_limit = [&] {
      limit = radius > doubt ? gap_limit(add(above, mul(2 + 0x1p-20F, add(radius, mul(2, doubt))))) : -1;
    };
    set_limit();
    for_each_near(volume_.parts[part].facets.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      if (offer.gap > limit) return;
      const float by_distance = sub(mul(0.5F, sub(separation(x_, corners(offer.primitive)), above)), doubt);
      if (by_distance >= radius) return;
      const float by_height = sub(height_over(offer.primitive, away), doubt);
      if (by_height >= radius) return;
      radius = by_height > by_distance ? by_height : by_distance;
      set_limit();
    });
    return {x_, radius > doubt ? radius : ClearBall::refused};
  }

  /// Returns the height of x over the plane of a facet. Returns −∞ if the facet's normal is inaccurate, or if the
  /// cosine between the normal and `away` is at most 2⁻⁸.
  OGC_HD float height_over(int t, const Real& away) const {
    const Corners at = corners(t);
    const Real e = difference<Rounded>(at.b, at.a), f = difference<Rounded>(at.c, at.a), n = cross(e, f);
    const double nn = squared(n), size = square_root(nn);
    const bool is_known = nn > mul(0x1p-36, mul(squared(e), squared(f)));
    if (!is_known || !(dot(n, away).value > mul(0x1p-8, size))) return -infinity;
    return round_down(divide(dot(difference<Rounded>(x_, at.a), n).value, size));
  }

  /// Returns the box of all facets of a part, without any margin.
  OGC_HD Box box_of(int part) const {
    const TreeView& tree = volume_.parts[part].facets.tree;
    return tree.node(tree.levels - 1, 0).whole();
  }
  OGC_HD bool is_in(const Box& box) const {
    return box.lower.x <= x_.x && x_.x <= box.upper.x && box.lower.y <= x_.y && x_.y <= box.upper.y &&
           box.lower.z <= x_.z && x_.z <= box.upper.z;
  }

  /// Returns whether x is nearer than r to facet t; `d` is the computed distance. If d is within its slack of r, an
  /// exact predicate decides.
  OGC_HD bool is_near(int t, const Distance& d) const {
    const Corners at = corners(t);
    return is_within(x_, at, closest_feature(x_, at, volume_.surface.facets[t].descending), d, volume_.contact_radius);
  }

  /// Returns the face of facet t that holds the closest point to x, if x is nearer than r and in the block of this
  /// face. Returns −1 otherwise, and if a lower-numbered facet contains the face.
  OGC_HD int touched_face(int t) const {
    const SurfaceView& surface = volume_.surface;
    const Corners at = corners(t);
    const Facet& facet = surface.facets[t];
    const TriangleFeature feature = closest_feature(x_, at, facet.descending);
    const int f = static_cast<int>(feature);
    int face = surface.triangle_face(t);
    if (f < 3) face = surface.vertex_face(facet.corner[f]);
    if (f >= 3 && f < 6) face = surface.edge_face(facet.edge[f - 3]);
    if (owner_of(face) != t || !is_within(x_, at, feature, point_triangle_distance(x_, at), volume_.contact_radius))
      return -1;
    if (f < 3 && !in_vertex_block(x_, facet.corner[f], surface, volume_.positions)) return -1;
    if (f >= 3 && f < 6 && !in_edge_block(x_, facet.edge[f - 3], surface, volume_.positions)) return -1;
    return face;
  }

  OGC_HD bool is_vertex(int face) const { return face < volume_.surface.vertex_count; }
  OGC_HD bool is_edge(int face) const {
    return !is_vertex(face) && face < volume_.surface.vertex_count + volume_.surface.edge_count;
  }

  /// Calls visit(t) for each facet at an edge, ascending.
  template <class Visit>
  OGC_HD void for_each_at_edge(int e, Visit visit) const {
    const EdgeEnds& ends = volume_.surface.edges[e];
    const Rows& rows = volume_.surface.vertex_triangles;
    for (int k = rows.offsets[ends.a]; k < rows.offsets[ends.a + 1]; ++k) {
      const Facet& facet = volume_.surface.facets[rows.items[k]];
      if (facet.edge[0] == e || facet.edge[1] == e || facet.edge[2] == e) visit(rows.items[k]);
    }
  }

  OGC_HD int owner_of(int face) const {
    const SurfaceView& surface = volume_.surface;
    if (is_vertex(face)) return surface.vertex_triangles.items[surface.vertex_triangles.offsets[face]];
    if (!is_edge(face)) return face - surface.vertex_count - surface.edge_count;
    int owner = -1;
    for_each_at_edge(face - surface.vertex_count, [&](int t) { owner = owner < 0 ? t : owner; });
    return owner;
  }

  OGC_HD static Real scaled(double s, const Real& a) { return Rounded{s} * a; }
  OGC_HD static double length(const Real& a) { return square_root(squared(a)); }
  OGC_HD static Real unit(const Real& a) { return scaled(divide(1.0, length(a)), a); }
  OGC_HD Real normal(int t) const {
    const Corners at = corners(t);
    return cross(difference<Rounded>(at.b, at.a), difference<Rounded>(at.c, at.a));
  }

  /// Returns whether w, the vector from a point of the edge to x, points outward or along the surface. An edge of one
  /// facet has no inner side. If the sum of the normals is shorter than 2⁻¹⁰, they are nearly opposite and rounding may
  /// decide the sum's direction. Then every w points outward at a convex edge and inward at a concave one.
  OGC_HD bool is_outside_of_edge(int e, const Real& w) const {
    Real sum;
    int count = 0, facet[2] = {};
    for_each_at_edge(e, [&](int t) {
      sum = sum + unit(normal(t));
      facet[count++ & 1] = t;
    });
    if (count < 2) return true;
    if (squared(sum) > 0x1p-20) return dot(w, sum).value >= 0;
    const EdgeEnds& ends = volume_.surface.edges[e];
    int opposite = -1;
    for (const int v : volume_.surface.facets[facet[1]].corner) opposite = v == ends.a || v == ends.b ? opposite : v;
    return dot(normal(facet[0]), difference<Rounded>(volume_.positions[opposite], corners(facet[0]).a)).value <= 0;
  }

  OGC_HD bool is_outside_of_vertex(int v) const {
    const SurfaceView& surface = volume_.surface;
    const Real w = difference<Rounded>(x_, volume_.positions[v]);
    const Rows& rows = surface.vertex_edges;
    double steepest = -infinity;
    int edge = -1;
    for (int k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
      const int e = rows.items[k], other = surface.edges[e].a == v ? surface.edges[e].b : surface.edges[e].a;
      int count = 0;
      for_each_at_edge(e, [&](int) { ++count; });
      if (count < 2) return true;
      const Real along = difference<Rounded>(volume_.positions[other], volume_.positions[v]);
      const double cosine = divide(dot(w, along).value, length(along));
      if (cosine > steepest) steepest = cosine, edge = e;
    }
    return edge < 0 || is_outside_of_edge(edge, w);
  }

  OGC_HD bool is_outside(int face) const {
    const SurfaceView& surface = volume_.surface;
    if (is_vertex(face)) return is_outside_of_vertex(face);
    if (is_edge(face)) {
      const int e = face - surface.vertex_count;
      const EdgeEnds& ends = surface.edges[e];
      const Real u = difference<Rounded>(x_, volume_.positions[ends.a]),
                 along = difference<Rounded>(volume_.positions[ends.b], volume_.positions[ends.a]);
      return is_outside_of_edge(e, u - scaled(segment_parameter(u, along), along));
    }
    const int t = face - surface.vertex_count - surface.edge_count;
    return dot(difference<Rounded>(x_, corners(t).a), normal(t)).value >= 0;
  }

  /// Returns the contact with its weights, direction and depth. The direction is the facet's normal if c is in the
  /// facet's interior. It is also the normal if ‖x − c‖ is at most 2⁻⁴⁸ ‖x − a‖₁ for the facet's first corner a: then x
  /// − c is only rounding error. Otherwise the direction is along x − c, outward.
  OGC_HD FoundVolumeContact contact_at(int face, bool inside) const {
    const SurfaceView& surface = volume_.surface;
    FoundVolumeContact contact;
    contact.face = face;
    contact.inside = inside;
    contact.triangle = owner_of(face);
    const Facet& facet = surface.facets[contact.triangle];
    const Corners at = corners(contact.triangle);
    TriangleFeature feature = TriangleFeature::interior;
    for (int k = 0; k < 3; ++k) {
      if (is_vertex(face) && facet.corner[k] == face) feature = static_cast<TriangleFeature>(k);
      if (is_edge(face) && facet.edge[k] == face - surface.vertex_count) feature = static_cast<TriangleFeature>(3 + k);
    }
    const Vec weights = closest_weights(x_, at, feature);
    contact.weights[0] = weights.x, contact.weights[1] = weights.y, contact.weights[2] = weights.z;
    const Real n = normal(contact.triangle);
    double away = 0;
    Real direction = unit(n);
    if (feature == TriangleFeature::interior) {
      away = divide(modulus(dot(difference<Rounded>(x_, at.a), n).value), length(n));
    } else {
      const Real apart = from_foot(at, feature);
      away = length(apart);
      if (away > mul(0x1p-48, norm_1(difference<Rounded>(x_, at.a)))) {
        const Real outward = unit(apart);
        direction = inside ? -outward : outward;
      }
    }
    contact.direction = {static_cast<float>(direction.x.value), static_cast<float>(direction.y.value),
                         static_cast<float>(direction.z.value)};
    const auto radius = static_cast<double>(volume_.contact_radius);
    contact.depth = static_cast<float>(inside ? add(away, radius) : sub(radius, away));
    return contact;
  }

  /// Returns x − c, where c is the given corner, or the closest point on the given edge.
  OGC_HD Real from_foot(const Corners& at, TriangleFeature feature) const {
    const int f = static_cast<int>(feature);
    if (f < 3) return difference<Rounded>(x_, at[f]);
    const Vec &a = at[f - 3], &b = at[(f - 2) % 3];
    const Real u = difference<Rounded>(x_, a), along = difference<Rounded>(b, a);
    return u - scaled(segment_parameter(u, along), along);
  }

  const VolumeView& volume_;
  Vec x_;
};

}  // namespace ogc::fast
