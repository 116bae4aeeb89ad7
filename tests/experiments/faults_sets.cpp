// Plants faults of the two detections, detect_vertex_facet and detect_edge_edge.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Returns a fault that changes the right answer by `spoil(in, authority, out)`.
template <class Out, class Spoil>
Fault set_fault(const std::string& name, Answering<Out, DetectIn> stage, Spoil spoil) {
  return {name, stage_of(name), [stage, spoil](Contestant& contestant, const Authority& authority) {
            contestant.*stage = [right = contestant.*stage, spoil, authority](const DetectIn& in) {
              Out out = right(in);
              spoil(in, authority, out);
              return out;
            };
          }};
}

template <class Spoil>
Fault facet_fault(const std::string& name, Spoil spoil) {
  return set_fault("detect_vertex_facet: " + name, &Contestant::detect_vertex_facet, spoil);
}
template <class Spoil>
Fault edge_fault(const std::string& name, Spoil spoil) {
  return set_fault("detect_edge_edge: " + name, &Contestant::detect_edge_edge, spoil);
}

bool has(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

bool rigid(const DetectIn& in, std::initializer_list<Index> vertices) {
  const Index group = in.exclusions.groups[*vertices.begin()];
  return group >= 0 &&
         std::all_of(vertices.begin(), vertices.end(), [&](Index v) { return in.exclusions.groups[v] == group; });
}

Face face_of(const Topology& topology, Index t, TriangleFeature feature) {
  const auto k = static_cast<std::size_t>(feature);
  if (k < 3) return {FaceKind::vertex, topology.triangles[t][k]};
  if (k < 6) return {FaceKind::edge, topology.triangle_edges[t][k - 3]};
  return {FaceKind::triangle, t};
}

/// Lists the closest face of every triangle within r without the block test. A vertex on the concave side of an edge
/// with k triangles then gets k contacts.
void without_feasible_region(const DetectIn& in, const Authority& authority, DetectVertexFacetOut& out) {
  const Topology& topology = *in.topology;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    ClosestFaceIn question;
    std::vector<Index> asked;
    for (Index t = 0; t < static_cast<Index>(topology.triangles.size()); ++t) {
      const Triangle& c = topology.triangles[t];
      if (has(c, v) || rigid(in, {v, c[0], c[1], c[2]})) continue;
      question.point.push_back(in.positions[v]);
      question.triangle.push_back({in.positions[c[0]], in.positions[c[1]], in.positions[c[2]]});
      asked.push_back(t);
    }
    const ClosestFaceOut answer = authority.closest_face(question).exact;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if (answer.distance[i] >= in.contact_radius) continue;
      const Face face = face_of(topology, asked[i], answer.feature[i]);
      if (std::none_of(out.contacts.begin(), out.contacts.end(),
                       [&](const auto& c) { return c.vertex == v && c.face == face; }))
        out.contacts.push_back({v, face, asked[i]});
    }
  }
}

/// All pairs of edges e < f that have no vertex in common and do not belong to one rigid group.
struct EdgePairs {
  ClosestPointsIn question;
  std::vector<std::array<Index, 2>> asked;
};

EdgePairs edge_pairs(const DetectIn& in) {
  const auto& edges = in.topology->edges;
  EdgePairs pairs;
  for (Index e = 0; e < static_cast<Index>(edges.size()); ++e)
    for (Index f = e + 1; f < static_cast<Index>(edges.size()); ++f) {
      const Edge &a = edges[e], &b = edges[f];
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1] || rigid(in, {a[0], a[1], b[0], b[1]})) continue;
      pairs.question.first.push_back({in.positions[a[0]], in.positions[a[1]]});
      pairs.question.second.push_back({in.positions[b[0]], in.positions[b[1]]});
      pairs.asked.push_back({e, f});
    }
  return pairs;
}

/// Accepts nearly parallel edges wherever they are nearer than r, so that a flat sheet at rest pushes itself.
void nearly_parallel_untested(const DetectIn& in, const Authority& authority, DetectEdgeEdgeOut& out) {
  const auto [question, asked] = edge_pairs(in);
  const ClosestPointsOut answer = authority.closest_points(question).exact;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (answer.nearly_parallel[i] == 0 || answer.distance_below[i] >= in.contact_radius) continue;
    const auto [e, f] = asked[i];
    const EdgeEdgeContact contact{{FaceKind::edge, e}, {FaceKind::edge, f}, e, f};
    if (std::ranges::find(out.contacts, contact) == out.contacts.end()) out.contacts.push_back(contact);
  }
}

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// An end of the overlap of two nearly parallel edges.
struct OverlapEnd {
  double squared_distance = 0;  ///< [m²]
  bool in_blocks = false;
};

/// Returns the ends of the overlap, computed in double. Between exactly parallel edges, the line from an end to the
/// other edge is perpendicular to both edges. Its scalar product with an edge is 0 except for rounding, so the block
/// test allows slightly more than 0.
std::vector<OverlapEnd> ends_of_overlap(const DetectIn& in, const Edge& e, const Edge& f) {
  const auto at = [&](Index v) { return Vec3{in.positions[v].x, in.positions[v].y, in.positions[v].z}; };
  const auto in_block = [&](Index v, const Vec3& c) {
    return std::ranges::all_of(in.topology->vertex_neighbours[v], [&](Index w) {
      const Vec3 u = difference(c, at(v)), arm = difference(at(w), at(v));
      return dot(u, arm) <= 1e-12 * std::sqrt(dot(u, u) * dot(arm, arm));
    });
  };
  std::vector<OverlapEnd> ends;
  const auto add = [&](const Edge& of, const Edge& other, bool at_ends_too) {
    for (const Index v : of) {
      const Vec3 a = at(other[0]), along = difference(at(other[1]), a);
      const double t = dot(difference(at(v), a), along) / dot(along, along);
      if (t < 0 || t > 1 || (!at_ends_too && (t == 0 || t == 1))) continue;
      const Vec3 c{a.x + t * along.x, a.y + t * along.y, a.z + t * along.z};
      const bool theirs = (t > 0 && t < 1) || in_block(other[t == 0 ? 0 : 1], at(v));
      ends.push_back({dot(difference(c, at(v)), difference(c, at(v))), in_block(v, c) && theirs});
    }
  };
  add(e, f, true);
  add(f, e, false);
  return ends;
}

bool is_loose(const DetectIn& in, Index e) { return in.topology->edge_triangles[e].empty(); }

/// Applies the block test to loose edges, too. Strands side by side with a negligible tilt then lose nearly all
/// contacts.
void strands_tested(const DetectIn& in, const Authority& authority, DetectEdgeEdgeOut& out) {
  std::erase_if(out.contacts, [&](const EdgeEdgeContact& c) {
    if (c.first.kind != FaceKind::edge || !is_loose(in, c.first_edge) || !is_loose(in, c.second_edge)) return false;
    const Edge &e = in.topology->edges[c.first_edge], &f = in.topology->edges[c.second_edge];
    const auto& x = in.positions;
    const ClosestPointsIn pair{{{x[e[0]], x[e[1]]}}, {{x[f[0]], x[f[1]]}}};
    if (authority.closest_points(pair).exact.nearly_parallel[0] == 0) return false;
    const auto ends = ends_of_overlap(in, e, f);
    const auto nearest = std::ranges::min_element(ends, {}, &OverlapEnd::squared_distance);
    return nearest != ends.end() && !nearest->in_blocks;
  });
}

/// Drops a contact of an edge's end v if the distance increases only slightly along an edge at v. A block test in
/// single precision does this if its tolerance has the wrong sign.
void ends_passed_over(const DetectIn& in, const Authority&, DetectEdgeEdgeOut& out) {
  const auto at = [&](Index v) { return Vec3{in.positions[v].x, in.positions[v].y, in.positions[v].z}; };
  const auto is_passed = [&](const Face& own, const Edge& other) {
    if (own.kind != FaceKind::vertex) return false;
    const Vec3 v = at(own.index), a = at(other[0]), along = difference(at(other[1]), a);
    const double t = std::clamp(dot(difference(v, a), along) / dot(along, along), 0.0, 1.0);
    const Vec3 d = difference({a.x + t * along.x, a.y + t * along.y, a.z + t * along.z}, v);
    return std::ranges::any_of(in.topology->vertex_neighbours[own.index], [&](Index w) {
      const Vec3 arm = difference(at(w), v);
      return dot(d, arm) > -1e-6 * std::sqrt(dot(d, d) * dot(arm, arm));
    });
  };
  std::erase_if(out.contacts, [&](const EdgeEdgeContact& c) {
    const auto& edges = in.topology->edges;
    const Edge &e = edges[c.first_edge], &f = edges[c.second_edge];
    return is_passed(c.first, f) || is_passed(c.second, e);
  });
}

void fixed_capacity(const DetectIn&, const Authority&, DetectVertexFacetOut& out) {
  std::map<Index, int> by_owner;
  std::erase_if(out.contacts, [&](const VertexFacetContact& c) { return ++by_owner[c.owner] > 4; });
}

/// Imitates a lost update: the first minimum below r_q is reset to its initial value r_q.
void lost_update(std::vector<float>& minima, float query_radius) {
  const auto it = std::find_if(minima.begin(), minima.end(), [&](float d) { return d < query_radius; });
  if (it != minima.end()) *it = query_radius;
}

void highest_owner(const DetectIn& in, const Authority&, DetectVertexFacetOut& out) {
  for (VertexFacetContact& c : out.contacts) {
    if (c.face.kind == FaceKind::triangle) continue;
    const auto index = static_cast<std::size_t>(c.face.index);
    c.owner = (c.face.kind == FaceKind::edge ? in.topology->edge_triangles[index]
                                             : in.topology->vertex_triangles[index])
                  .back();
  }
}

/// Returns a change that replaces an answer's contacts by the contacts of the previous answer.
template <class Out>
auto stale() {
  return [last = std::make_shared<Out>()](const DetectIn&, const Authority&, Out& out) {
    std::swap(last->contacts, out.contacts);
  };
}

std::vector<Fault> facet_faults() {
  return {
      facet_fault("one contact dropped",
                  [](const auto&, const auto&, auto& out) {
                    if (!out.contacts.empty()) out.contacts.pop_back();
                  }),
      facet_fault("one contact twice",
                  [](const auto&, const auto&, auto& out) {
                    if (!out.contacts.empty()) out.contacts.push_back(out.contacts.front());
                  }),
      facet_fault("wrong owner", highest_owner),
      facet_fault("no feasible-region test", without_feasible_region),
      facet_fault("list of fixed capacity, overflow dropped", fixed_capacity),
      facet_fault("missing atomic at d_min of a triangle",
                  [](const auto& in, const auto&, auto& out) { lost_update(out.d_min_triangle, in.query_radius); }),
      facet_fault("stale list", stale<DetectVertexFacetOut>()),
      facet_fault("d_min of a vertex one ulp too large",
                  [](const auto&, const auto&, auto& out) {
                    for (float& d : out.d_min_vertex) d = std::nextafter(d, infinity);
                  }),
      facet_fault("d_min of a vertex always 0",
                  [](const auto&, const auto&, auto& out) {
                    std::fill(out.d_min_vertex.begin(), out.d_min_vertex.end(), 0.0f);
                  }),
  };
}

std::vector<Fault> edge_faults() {
  return {
      edge_fault("one contact dropped",
                 [](const auto&, const auto&, auto& out) {
                   if (!out.contacts.empty()) out.contacts.pop_back();
                 }),
      edge_fault("nearly parallel edges untested", nearly_parallel_untested),
      edge_fault("parallel loose edges tested", strands_tested),
      edge_fault("ends passed over where a neighbour is as near", ends_passed_over),
      edge_fault("edge ends swapped",
                 [](const auto& in, const auto&, auto& out) {
                   for (EdgeEdgeContact& c : out.contacts) {
                     if (c.first.kind != FaceKind::vertex) continue;
                     const Edge& e = in.topology->edges[c.first_edge];
                     c.first.index = e[0] == c.first.index ? e[1] : e[0];
                   }
                 }),
      edge_fault("missing atomic at d_min of an edge",
                 [](const auto& in, const auto&, auto& out) { lost_update(out.d_min_edge, in.query_radius); }),
      edge_fault("stale list", stale<DetectEdgeEdgeOut>()),
  };
}

}  // namespace

std::vector<Fault> set_faults() {
  std::vector<Fault> all = facet_faults();
  for (Fault& fault : edge_faults()) all.push_back(std::move(fault));
  return all;
}

}  // namespace ogc::tests
