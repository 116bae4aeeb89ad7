// This host code has its own file, compiled by g++ alone. nvcc lays out the captures of a lambda in another order than
// g++. If both compile an inline function, the linker keeps one copy. So an inline function with a capturing lambda
// must not be in a header that both compile.
#include "fast/stages/surface.hpp"

#include <algorithm>

namespace ogc::fast {
namespace {

class SeedFinder {
 public:
  SeedFinder(const compare::Topology& topology, const std::vector<int>& groups, const compare::CompressedRows* partners)
      : topology_(topology), groups_(groups), partners_(partners) {}

  EdgeSeeds of_edge(int e) const {
    EdgeSeeds seeds{{-1, -1}};
    const auto take = [&](std::span<const compare::Index> candidates) {
      for (const int v : candidates) {
        if (seeds.vertex[1] >= 0) return;
        if (v != seeds.vertex[0] && has_pair(e, v)) seeds.vertex[seeds.vertex[0] < 0 ? 0 : 1] = v;
      }
    };
    take(topology_.edge_opposite[static_cast<std::size_t>(e)]);
    for (const int end : edge(e)) take(topology_.vertex_neighbours[static_cast<std::size_t>(end)]);
    return seeds;
  }

  FacetSeeds of_facet(const Facet& facet) const {
    FacetSeeds seeds{{-1, -1, -1}};
    for (int k = 0; k < 3; ++k) {
      for (const int v : topology_.edge_opposite[static_cast<std::size_t>(facet.edge[k])]) {
        if (is_pair(v, facet.corner)) seeds.vertex[k] = v;
      }
    }
    return seeds;
  }

  VertexSeeds of_vertex(int v) const {
    VertexSeeds seeds{{-1, -1}};
    for (const int t : topology_.vertex_triangles[static_cast<std::size_t>(v)]) {
      for (const int e : topology_.triangle_edges[static_cast<std::size_t>(t)]) {
        if (contains(edge(e), v) || !has_facet_pair(v, e)) continue;
        if (seeds.edge[0] >= 0) return {{seeds.edge[0], e}};
        seeds.edge[0] = e;
      }
    }
    return seeds;
  }

 private:
  const compare::Edge& edge(int e) const { return topology_.edges[static_cast<std::size_t>(e)]; }

  template <class Vertices>
  static bool contains(const Vertices& vertices, int v) {
    return std::find(std::begin(vertices), std::end(vertices), v) != std::end(vertices);
  }

  /// Checks that v and the face share no vertex, and that no stitch joins them.
  template <class Vertices>
  bool is_apart(int v, const Vertices& face) const {
    if (contains(face, v)) return false;
    if (partners_ == nullptr) return true;
    const auto& row = (*partners_)[static_cast<std::size_t>(v)];
    return std::none_of(row.begin(), row.end(), [&](int partner) { return contains(face, partner); });
  }

  /// Checks whether v and all vertices of the face are in one group.
  template <class Vertices>
  bool is_rigid(int v, const Vertices& face) const {
    const auto group = [this](int i) { return groups_[static_cast<std::size_t>(i)]; };
    return group(v) >= 0 && std::all_of(std::begin(face), std::end(face), [&](int i) { return group(i) == group(v); });
  }

  template <class Vertices>
  bool is_pair(int v, const Vertices& face) const {
    return is_apart(v, face) && !is_rigid(v, face);
  }

  /// Checks whether some edge at v forms a pair with e.
  bool has_pair(int e, int v) const {
    const auto& neighbours = topology_.vertex_neighbours[static_cast<std::size_t>(v)];
    return is_apart(v, edge(e)) && std::any_of(neighbours.begin(), neighbours.end(), [&](int w) {
             return is_apart(w, edge(e)) && !(is_rigid(v, edge(e)) && is_rigid(w, edge(e)));
           });
  }

  /// Checks whether some triangle at e forms a pair with v.
  bool has_facet_pair(int v, int e) const {
    const auto triangles = topology_.edge_triangles[static_cast<std::size_t>(e)];
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](int t) { return is_pair(v, topology_.triangles[static_cast<std::size_t>(t)]); });
  }

  const compare::Topology& topology_;
  const std::vector<int>& groups_;
  const compare::CompressedRows* partners_;
};

}  // namespace

Facet facet_of(const compare::Topology& topology, std::size_t t) {
  Facet facet{};
  for (std::size_t k = 0; k < 3; ++k) {
    facet.corner[k] = topology.triangles[t][k];
    facet.edge[k] = topology.triangle_edges[t][k];
    if (topology.triangles[t][k] > topology.triangles[t][(k + 1) % 3]) facet.descending |= 1U << k;
  }
  return facet;
}

Searched find_searched(const compare::Topology& topology) {
  Searched searched;
  const auto take = [&](int number, const auto& vertices) {
    if (!topology.on_surface(vertices)) return 0;
    searched.numbers.push_back(number);
    return 1;
  };
  for (int v = 0; v < topology.vertex_count; ++v) searched.vertices += take(v, v);
  for (int e = 0; e < static_cast<int>(topology.edges.size()); ++e)
    searched.edges += take(e, topology.edges[static_cast<std::size_t>(e)]);
  for (int t = 0; t < static_cast<int>(topology.triangles.size()); ++t)
    searched.facets += take(t, topology.triangles[static_cast<std::size_t>(t)]);
  // A list is needed only if edges are left out: searches skip vertices inside solids by themselves.
  if (static_cast<std::size_t>(searched.edges) < topology.edges.size()) return searched;
  // If there is no facet, no vertex searches, because vertices search for facets.
  return {{}, topology.triangles.empty() ? 0 : topology.vertex_count, searched.edges, searched.facets};
}

Seeds find_seeds(const compare::Topology& topology, const std::vector<int>& groups,
                 const compare::CompressedRows* partners, const std::vector<Facet>& facets) {
  const SeedFinder finder(topology, groups, partners);
  Seeds seeds;
  for (int e = 0; e < static_cast<int>(topology.edges.size()); ++e) seeds.edges.push_back(finder.of_edge(e));
  for (const Facet& facet : facets) seeds.facets.push_back(finder.of_facet(facet));
  for (int v = 0; v < topology.vertex_count; ++v) seeds.vertices.push_back(finder.of_vertex(v));
  return seeds;
}

}  // namespace ogc::fast
