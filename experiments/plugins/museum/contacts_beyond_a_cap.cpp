// Contacts dropped beyond a cap: each vertex has room for a fixed number of contacts, and the others are dropped
// without a message. (The public code has room for 32; here it is 4, so that small meshes overflow.) Where cloth folds,
// layers pass through each other because nothing separates them.
#include <vector>

#include "experiments/plugins/museum/geometry.h"

OGC_PLUGIN("contacts dropped beyond a cap", OGC_HOST_MEMORY)

namespace {

using namespace museum;

constexpr int slots = 4;

// Describes the point of a triangle that is closest to a vertex: the corner or edge that contains this point (-1:
// none), and its distance from the vertex.
struct Nearest {
  int corner = -1, edge = -1;
  double distance = INFINITY;
};

// Decides in which face's block a point lies. One function decides for all faces on which side of a plane a point lies.
// So rounding can't place the point between two blocks.
struct Question {
  const ogc_detect_in& in;
  const ogc_topology& mesh;

  Vec at(int v) const { return vec(in.positions[v]); }
  // Returns whether the plane through w, perpendicular to the edge from w to its neighbour, separates p from the
  // neighbour.
  bool is_beyond(Vec p, int w, int neighbour) const { return dot(p - at(w), at(neighbour) - at(w)) <= 0; }
  // Returns whether p and the vertex o lie on the same side of the edge.
  bool is_beside(Vec p, int edge, int o) const {
    const Vec a = at(mesh.edges[edge][0]), e = at(mesh.edges[edge][1]) - a, to = at(o) - a;
    return dot(cross(to, e), cross(p - a, e)) > 0;  // components along the edge cancel before they are multiplied
  }
  static bool has(const ogc_rows& rows, int row, int item) {
    return std::find(rows.items + rows.offsets[row], rows.items + rows.offsets[row + 1], item) !=
           rows.items + rows.offsets[row + 1];
  }
  // Returns whether the pair is excluded: the vertex belongs to the triangle, all four vertices are in one rigid group,
  // or a stitch joins them.
  bool is_left_out(int v, const int32_t* t) const {
    const int group = in.rigid_groups[v];
    bool rigid = group >= 0, excluded = false;
    for (int k = 0; k < 3; ++k) {
      rigid = rigid && in.rigid_groups[t[k]] == group;
      excluded = excluded || t[k] == v || has(in.excluded_partners, v, t[k]);
    }
    return rigid || excluded;
  }
  Nearest nearest(Vec p, int t) const {
    const int32_t* c = mesh.triangles[t];
    const Vec normal = cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
    bool inside = dot(normal, normal) > 0;
    for (int k = 0; k < 3; ++k) inside = inside && is_beside(p, mesh.triangle_edges[t][k], c[(k + 2) % 3]);
    if (inside) return {-1, -1, std::abs(dot(p - at(c[0]), normal)) / length(normal)};
    Nearest best;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, last = (k + 2) % 3;
      const Vec a = at(c[k]), b = at(c[next]);
      const bool beyond = is_beyond(p, c[k], c[next]);
      if (beyond && is_beyond(p, c[k], c[last])) keep_nearer(best, {k, -1, length(p - a)});
      if (beyond || is_beyond(p, c[next], c[k]) || is_beside(p, mesh.triangle_edges[t][k], c[last])) continue;
      keep_nearer(best, {-1, k, length(p - a - place_on(p, a, b) * (b - a))});
    }
    return best;
  }
  static void keep_nearer(Nearest& best, const Nearest& other) {
    if (other.distance < best.distance) best = other;
  }
  // is_before_vertex returns whether p is in the block of vertex w (Eq. 8). is_before_edge returns whether no triangle
  // of edge e lies on the same side of e as p (Eq. 9).
  bool is_before_vertex(Vec p, int w) const {
    for (int k = mesh.vertex_neighbours.offsets[w]; k < mesh.vertex_neighbours.offsets[w + 1]; ++k)
      if (!is_beyond(p, w, mesh.vertex_neighbours.items[k])) return false;
    return true;
  }
  bool is_before_edge(Vec p, int e) const {
    for (int k = mesh.edge_opposite.offsets[e]; k < mesh.edge_opposite.offsets[e + 1]; ++k)
      if (is_beside(p, e, mesh.edge_opposite.items[k])) return false;
    return true;
  }
  // Returns the contact of the vertex with the nearest face of triangle t; face -1 if there is none.
  ogc_vertex_facet_contact contact(int v, int t, const Nearest& near) const {
    const Vec p = at(v);
    if (near.corner >= 0) {
      const int w = mesh.triangles[t][near.corner];
      return {v, OGC_FACE_VERTEX, is_before_vertex(p, w) ? w : -1,
              mesh.vertex_triangles.items[mesh.vertex_triangles.offsets[w]]};
    }
    if (near.edge < 0) return {v, OGC_FACE_TRIANGLE, t, t};
    const int e = mesh.triangle_edges[t][near.edge];
    return {v, OGC_FACE_EDGE, is_before_edge(p, e) ? e : -1, mesh.edge_triangles.items[mesh.edge_triangles.offsets[e]]};
  }
};

bool holds(const std::vector<ogc_vertex_facet_contact>& all, const ogc_vertex_facet_contact& c) {
  return std::any_of(all.begin(), all.end(),
                     [&](const auto& other) { return other.kind == c.kind && other.face == c.face; });
}

}  // namespace

int ogc_detect_vertex_facet(const ogc_detect_in* in, ogc_detect_vertex_facet_out* out) {
  const ogc_topology& mesh = in->topology;
  const Question question{*in, mesh};
  out->count = 0;
  for (int t = 0; t < mesh.triangle_count; ++t) out->d_min_triangle[t] = in->query_radius;
  for (int v = 0; v < mesh.vertex_count; ++v) {
    out->d_min_vertex[v] = in->query_radius;
    std::vector<ogc_vertex_facet_contact> kept;
    for (int t = 0; t < mesh.triangle_count; ++t) {
      const int32_t* corners = mesh.triangles[t];
      if (question.is_left_out(v, corners)) continue;
      const Nearest near = question.nearest(question.at(v), t);
      const Vec a = question.at(corners[0]);
      const float low = below(near.distance, length(question.at(corners[1]) - a) + length(question.at(corners[2]) - a));
      out->d_min_vertex[v] = std::min(out->d_min_vertex[v], low);
      out->d_min_triangle[t] = std::min(out->d_min_triangle[t], low);
      if (near.distance >= in->contact_radius) continue;
      const auto contact = question.contact(v, t, near);
      if (contact.face >= 0 && !holds(kept, contact)) kept.push_back(contact);
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(slots, kept.size()); ++i) {  // the mistake
      if (out->count < out->capacity) out->contacts[out->count] = kept[i];
      ++out->count;
    }
  }
  return 0;
}
