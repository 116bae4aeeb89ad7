// Finds contacts with volumes of tetrahedra (§3.9, method.md §9, after Chen, Diaz and Yuksel 2023, "Shortest Path to
// Boundary for Self-Intersecting Meshes"). A point x may lie in several sheets of one body. A *way* of a sheet is the
// segment from x to the closest point c of a boundary triangle, if it can be traversed through tetrahedra. Each sheet
// has one contact, at the point c of its shortest way.
//
//   sheets   the tree of tetrahedra offers all tetrahedra whose boxes hold x. Signs of exact determinants decide which
//            of them hold x, and which of their simplices holds x in its interior. The lowest-numbered tetrahedron of
//            a sheet represents the sheet
//   ways     the nearest boundary triangle is tried first and usually has a way. If not, all triangles nearer than the
//            shortest way so far are tried
//   passing  the test of a way. It follows the segment from c to x through tetrahedra, in rounded double. Heights over
//            the sides of a tetrahedron are affine along the segment. A height below 2⁻³⁶ of the moduli of its terms
//            counts as zero: this is far above its rounding error, and far below the precision of the coordinates. If
//            the segment leaves through one side, the tetrahedron behind this side is next. If it leaves through an
//            edge or a vertex, all tetrahedra ahead that have this edge or vertex are next
//
// Tetrahedra without positive volume hold no point and are never traversed, and no way ends at their sides.
#pragma once

#include "fast/kernels/volume_depth.hpp"

namespace ogc::fast {

/// Holds four points; value() is positive if d lies on the side of triangle abc to which its right-hand normal points.
struct Orientation {
  /// ((b − a) × (c − a))·(d − a) [m³].
  static constexpr int degree = 3;
  Vec a, b, c, d;
  template <class N>
  OGC_HD N value() const {
    return dot(cross(difference<N>(b, a), difference<N>(c, a)), difference<N>(d, a));
  }
};

/// Returns corner i of the side opposite to corner k of a tetrahedron. The side's corners are ordered so that its
/// normal points outward if the volume is positive.
OGC_HD inline int side_corner(int k, int i) {
  constexpr int sides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  return sides[k][i];
}

/// Holds the result of a test of a point against a part of tetrahedra.
struct SolidAnswer {
  /// facet at the end of the first sheet's way, where the next search may begin; −1 if there is no way
  int facet = -1;
  VolumeSide side = VolumeSide::far;  ///< inside: at least one sheet holds the point
  int unresolved = 0;                 ///< number of sheets without a way
};

/// Finds where a point lies relative to a volume's parts of tetrahedra.
class SolidQuestion {
 public:
  /// `own`: the vertex whose position is `point`, if it belongs to the volume; else −1.
  OGC_HD SolidQuestion(const VolumeView& volume, const Vec& point, int own)
      : volume_(volume), solids_(volume.solids), faces_(volume, point), x_(point), own_(own) {}

  /// Calls visit(contact) for each contact with a part. If x lies in sheets, there is one contact for each sheet with a
  /// way. Otherwise there is one contact for each face that is nearer than r and whose outward block holds x. The
  /// search begins at facet `first` (−1: at no facet), which only changes the time.
  template <class Visit>
  OGC_HD SolidAnswer visit_contacts(int part, int first, Visit visit) const {
    SolidAnswer answer;
    int known[most_known], count = 0;
    for_each_sheet(part, [&](int element) {
      answer.side = VolumeSide::inside;
      const Way way = shortest_way(part, element, first);
      if (way.facet < 0) {
        ++answer.unresolved;
        return;
      }
      if (answer.facet < 0) answer.facet = way.facet;
      for (int k = 0; k < count; ++k)
        if (known[k] == way.face) return;
      if (count < most_known) known[count++] = way.face;
      visit(faces_.contact_at(way.face, true));
    });
    if (answer.side == VolumeSide::inside) return answer;
    const float limit = gap_limit(volume_.contact_radius);
    for_each_near(volume_.parts[part].facets.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      const int face = faces_.touched_face(offer.primitive);
      if (face < 0 || is_own(face) || !faces_.is_outside(face)) return;
      answer.side = VolumeSide::near;
      visit(faces_.contact_at(face, false));
    });
    return answer;
  }

 private:
  /// Number of faces that are remembered, so that several sheets whose ways end at the same face give only one contact.
  static constexpr int most_known = 8;

  /// The shortest way found so far: the distance, and the face and facet at its end.
  struct Way {
    double length = infinity;
    int face = -1, facet = -1;
  };

  /// Holds the heights of both ends of a segment over each side of a tetrahedron: `at_foot` of the first end c, `at_x`
  /// of the second end x. A height is positive inward and multiplied by twice the side's area. `zero`: limit below
  /// which a height counts as zero.
  struct Passage {
    double at_foot[4], at_x[4], zero[4];

    OGC_HD double at(int k, double s) const { return add(at_foot[k], mul(s, sub(at_x[k], at_foot[k]))); }
    /// Returns whether the height over side k does not decrease from c to x.
    OGC_HD bool rises(int k) const { return sub(at_x[k], at_foot[k]) >= -zero[k]; }
  };

  OGC_HD Vec position(int v) const { return volume_.positions[v]; }

  OGC_HD bool has(int element, int v) const {
    const int* corner = solids_.elements[element].corner;
    return corner[0] == v || corner[1] == v || corner[2] == v || corner[3] == v;
  }

  /// Returns whether `element` contains those corners of tetrahedron `of` whose bits are set in `corners`.
  OGC_HD bool has_all(int element, int of, unsigned corners) const {
    for (int k = 0; k < 4; ++k)
      if ((corners >> k & 1U) != 0 && !has(element, solids_.elements[of].corner[k])) return false;
    return true;
  }

  OGC_HD bool is_own(int face) const {
    if (own_ < 0) return false;
    const SurfaceView& surface = volume_.surface;
    if (faces_.is_vertex(face)) return face == own_;
    if (faces_.is_edge(face)) {
      const EdgeEnds& ends = surface.edges[face - surface.vertex_count];
      return ends.a == own_ || ends.b == own_;
    }
    const int* corner = surface.facets[face - surface.vertex_count - surface.edge_count].corner;
    return corner[0] == own_ || corner[1] == own_ || corner[2] == own_;
  }

  /// Returns one bit per corner: whether the corner's barycentric weight at x is positive. The corners with this bit
  /// span the simplex that holds x in its interior. Returns 0 if the tetrahedron does not hold x.
  OGC_HD unsigned carrier(int element) const {
    const int* corner = solids_.elements[element].corner;
    unsigned inside = 0;
    for (int k = 0; k < 4; ++k) {
      const int beyond = exact_sign(Orientation{position(corner[side_corner(k, 0)]),
                                                position(corner[side_corner(k, 1)]),
                                                position(corner[side_corner(k, 2)]), x_});
      if (beyond > 0) return 0;
      if (beyond < 0) inside |= 1U << k;
    }
    return inside;
  }

  /// Calls visit(element) once for each sheet that holds x; `element` is the sheet's lowest-numbered tetrahedron.
  template <class Visit>
  OGC_HD void for_each_sheet(int part, Visit visit) const {
    const float limit = 0;
    for_each_near(volume_.parts[part].tetrahedra.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      const int element = offer.primitive;
      if (solids_.is_positive[element] == 0 || (own_ >= 0 && has(element, own_))) return;
      const unsigned inside = carrier(element);
      if (inside == 0) return;
      const int* corner = solids_.elements[element].corner;
      const int v = corner[lowest_bit(inside)];
      for (int i = solids_.vertex_elements.offsets[v]; i < solids_.vertex_elements.offsets[v + 1]; ++i) {
        const int other = solids_.vertex_elements.items[i];
        if (other >= element) break;
        if (solids_.is_positive[other] != 0 && has_all(other, element, inside)) return;
      }
      visit(element);
    });
  }

  OGC_HD Way shortest_way(int part, int element, int first) const {
    Way way;
    int failed = -1;  // face at the end of a segment that cannot be traversed
    if (first < 0) {
      const Way nearest = search(part, element, way, first, false, failed);
      if (nearest.facet < 0) return way;
      if (passes(part, element, nearest.facet, nearest.face)) return nearest;
      failed = nearest.face;
    }
    return search(part, element, way, first, true, failed);
  }

  /// Returns the shortest way of the sheet of `element`; `way` if none is shorter. If `must_pass` is false, segments to
  /// facets that cannot be traversed count, too. `first` is a facet to try first, `failed` a face to skip; −1: none.
  OGC_HD Way search(int part, int element, Way way, int first, bool must_pass, int failed) const {
    float limit = 0x1p126F;  // excludes only empty children, whose boxes lie at infinity
    const auto meet = [&](int t) {
      if (solids_.is_positive[solids_.owner[t]] == 0) return;
      const Distance d = point_triangle_distance(x_, faces_.corners(t));
      if (d.value > way.length) return;
      const int face = faces_.face_of(t);
      if ((d.value == way.length && face >= way.face) || face == failed || is_own(face)) return;
      if (must_pass && !passes(part, element, t, face)) return;
      way = {d.value, face, t};
      limit = gap_limit(round_up(add(d.value, d.slack)));
    };
    if (first >= 0) meet(first);
    for_each_near(volume_.parts[part].facets.tree, Box{x_, x_}, 0, limit, [&](const Offer& offer) {
      if (offer.gap > limit || offer.primitive == first) return;
      if (!is_beyond(separation(x_, faces_.corners(offer.primitive)), limit)) meet(offer.primitive);
    });
    return way;
  }

  /// Returns x − c for the closest point c of a facet.
  OGC_HD Real from_facet(int t) const {
    const Corners at = faces_.corners(t);
    const TriangleFeature feature = closest_feature(x_, at, volume_.surface.facets[t].descending);
    if (feature != TriangleFeature::interior) return faces_.from_foot(at, feature);
    const Real n = faces_.normal(t);
    return VolumeQuestion::scaled(divide(dot(difference<Rounded>(x_, at.a), n).value, squared(n)), n);
  }

  OGC_HD static Real moduli(const Real& a) {
    return {{modulus(a.x.value)}, {modulus(a.y.value)}, {modulus(a.z.value)}};
  }

  OGC_HD Passage passage(int element, const Real& apart) const {
    Passage passage;
    const int* corner = solids_.elements[element].corner;
    for (int k = 0; k < 4; ++k) {
      const Vec a = position(corner[side_corner(k, 0)]);
      const Real e = difference<Rounded>(position(corner[side_corner(k, 1)]), a),
                 f = difference<Rounded>(position(corner[side_corner(k, 2)]), a), u = difference<Rounded>(x_, a);
      const Real n = cross(e, f), p = moduli(e), q = moduli(f),
                 terms{p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
      passage.at_x[k] = -dot(u, n).value;
      passage.at_foot[k] = add(passage.at_x[k], dot(apart, n).value);
      passage.zero[k] = mul(0x1p-36, dot(moduli(u) + moduli(apart), terms).value);
    }
    return passage;
  }

  /// Holds the tetrahedra that are still to be traversed (`waiting`), and the last ones that were reached (`met`).
  struct Front {
    static constexpr int most = 32;  ///< capacity of both arrays
    int waiting[most], met[most], waiting_count = 0, met_count = 0;

    OGC_HD void reach(int element) {
      const int known = met_count < most ? met_count : most;
      for (int i = 0; i < known; ++i)
        if (met[i] == element) return;
      met[met_count++ % most] = element;
      if (waiting_count < most) waiting[waiting_count++] = element;
    }
  };

  /// Adds to the front the tetrahedra that contain all `count` vertices of `vertex` and lie ahead on the segment.
  OGC_HD void go_on(const int* vertex, int count, const Real& apart, Front& front) const {
    const Rows& rows = solids_.vertex_elements;
    for (int i = rows.offsets[vertex[0]]; i < rows.offsets[vertex[0] + 1]; ++i) {
      const int element = rows.items[i];
      if (solids_.is_positive[element] == 0) continue;
      bool lies_ahead = true;
      for (int k = 1; k < count; ++k) lies_ahead = lies_ahead && has(element, vertex[k]);
      if (!lies_ahead) continue;
      const Passage own = passage(element, apart);
      for (int k = 0; k < 4; ++k) {
        bool is_on_it = false;
        for (int m = 0; m < count; ++m) is_on_it = is_on_it || solids_.elements[element].corner[k] == vertex[m];
        lies_ahead = lies_ahead && (is_on_it || own.rises(k));
      }
      if (lies_ahead) front.reach(element);
    }
  }

  /// Returns whether the segment from c to x can be traversed through tetrahedra and ends in the given sheet. c is the
  /// point of facet t closest to x, `face` is the face that holds c, and `sheet` is the sheet's lowest-numbered
  /// tetrahedron.
  OGC_HD bool passes(int part, int sheet, int t, int face) const {
    const Real apart = from_facet(t);
    Front front;
    int vertex[4];
    go_on(vertex, vertices_of(face, vertex), apart, front);
    // Limits the loop, because `met` holds only the last Front::most tetrahedra that were reached. In a body with any
    // thickness each tetrahedron is met only once.
    const int most = 4 * volume_.parts[part].tetrahedra.tree.count + Front::most;
    while (front.waiting_count > 0 && front.met_count < most) {
      const int element = front.waiting[--front.waiting_count];
      const Passage own = passage(element, apart);
      double low = 0, high = 1;
      for (int k = 0; k < 4; ++k) {
        const double slope = sub(own.at_x[k], own.at_foot[k]);
        if (slope == 0) {
          if (own.at_x[k] < -own.zero[k]) high = -1;
          continue;
        }
        const double root = divide(sub(-own.zero[k], own.at_foot[k]), slope);
        if (slope > 0)
          low = larger(low, root);
        else
          high = smaller(high, root);
      }
      if (!(low <= high)) continue;
      // bit k: at the segment's end in this tetrahedron, the height over the side opposite to corner k is zero
      unsigned left_by = 0;
      for (int k = 0; k < 4; ++k)
        if (own.at(k, high) <= own.zero[k]) left_by |= 1U << k;
      const unsigned stays = ~left_by & 15U;
      if (high == 1) {
        if (has_all(sheet, element, stays)) return true;
        continue;
      }
      const SolidElement& at = solids_.elements[element];
      if ((left_by & (left_by - 1)) == 0 || stays == 0) {
        for (unsigned sides = left_by; sides != 0; sides &= sides - 1) {
          const int next = at.behind[lowest_bit(sides)];
          if (next >= 0 && solids_.is_positive[next] != 0) front.reach(next);
        }
        continue;
      }
      int count = 0;
      for (unsigned corners = stays; corners != 0; corners &= corners - 1)
        vertex[count++] = at.corner[lowest_bit(corners)];
      go_on(vertex, count, apart, front);
    }
    return false;
  }

  /// Writes the vertices of a face, and returns how many it has.
  OGC_HD int vertices_of(int face, int* vertex) const {
    const SurfaceView& surface = volume_.surface;
    if (faces_.is_vertex(face)) {
      vertex[0] = face;
      return 1;
    }
    if (faces_.is_edge(face)) {
      const EdgeEnds& ends = surface.edges[face - surface.vertex_count];
      vertex[0] = ends.a, vertex[1] = ends.b;
      return 2;
    }
    for (int k = 0; k < 3; ++k) vertex[k] = surface.facets[face - surface.vertex_count - surface.edge_count].corner[k];
    return 3;
  }

  const VolumeView& volume_;
  SolidView solids_;
  VolumeQuestion faces_;
  Vec x_;
  int own_;
};

}  // namespace ogc::fast
