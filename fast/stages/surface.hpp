// The complex on the backend: uploaded once, read by every stage of a detection.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

inline Facet facet_of(const compare::Topology& topology, std::size_t t) {
  Facet facet{};
  for (std::size_t k = 0; k < 3; ++k) {
    facet.corner[k] = topology.triangles[t][k];
    facet.edge[k] = topology.triangle_edges[t][k];
    if (topology.triangles[t][k] > topology.triangles[t][(k + 1) % 3]) facet.descending |= 1U << k;
  }
  return facet;
}

/// Finds the seeds of fast/kernels/bvh.hpp: near neighbours in the mesh that are neither adjacent nor in one rigid group.
class SeedFinder {
 public:
  SeedFinder(const compare::Topology& topology, const std::vector<int>& groups) : topology_(topology), groups_(groups) {}

  EdgeSeeds of_edge(int e) const {
    EdgeSeeds seeds{{-1, -1}};
    const auto take = [&](std::span<const compare::Index> candidates) {
      for (const int v : candidates) {
        if (seeds.vertex[0] >= 0 && seeds.vertex[1] >= 0) return;
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

  /// v and the face do not touch, and not all of them are in one group.
  template <class Vertices>
  bool is_pair(int v, const Vertices& face) const {
    const auto group = [this](int i) { return groups_[static_cast<std::size_t>(i)]; };
    return !contains(face, v) && !(group(v) >= 0 && std::all_of(std::begin(face), std::end(face), [&](int i) { return group(i) == group(v); }));
  }

  /// Some edge at v forms a pair with e.
  bool has_pair(int e, int v) const {
    const auto& neighbours = topology_.vertex_neighbours[static_cast<std::size_t>(v)];
    return !contains(edge(e), v) && std::any_of(neighbours.begin(), neighbours.end(), [&](int w) {
      return !contains(edge(e), w) && (is_pair(v, edge(e)) || is_pair(w, edge(e)));
    });
  }

  /// Some triangle at e forms a pair with v.
  bool has_facet_pair(int v, int e) const {
    const auto triangles = topology_.edge_triangles[static_cast<std::size_t>(e)];
    return std::any_of(triangles.begin(), triangles.end(), [&](int t) { return is_pair(v, topology_.triangles[static_cast<std::size_t>(t)]); });
  }

  const compare::Topology& topology_;
  const std::vector<int>& groups_;
};

template <class Backend>
class Surface {
 public:
  /// `rigid_groups`: one number for each vertex, or empty where no pair is left out.
  Surface(const compare::Topology& topology, std::span<const compare::Index> rigid_groups)
      : vertex_count_(topology.vertex_count),
        edge_count_(static_cast<int>(topology.edges.size())),
        triangle_count_(static_cast<int>(topology.triangles.size())) {
    std::vector<Facet> facets(topology.triangles.size());
    for (std::size_t t = 0; t < facets.size(); ++t) facets[t] = facet_of(topology, t);
    std::vector<EdgeEnds> edges(topology.edges.size());
    std::transform(topology.edges.begin(), topology.edges.end(), edges.begin(), [](const compare::Edge& e) { return EdgeEnds{e[0], e[1]}; });
    facets_.upload(facets.data(), facets.size());
    edges_.upload(edges.data(), edges.size());
    neighbours_.upload(topology.vertex_neighbours);
    opposites_.upload(topology.edge_opposite);
    vertex_edges_.upload(topology.vertex_edges);
    vertex_triangles_.upload(topology.vertex_triangles);
    std::vector<int> groups(rigid_groups.begin(), rigid_groups.end());
    groups.resize(static_cast<std::size_t>(vertex_count_), -1);
    groups_.upload(groups.data(), groups.size());
    upload_seeds(SeedFinder(topology, groups), facets);
  }

  SurfaceView view() const {
    return {vertex_count_,        edge_count_,        triangle_count_,      facets_.data(),           edges_.data(),
            neighbours_.view(),   opposites_.view(),  vertex_edges_.view(), vertex_triangles_.view(), groups_.data(),
            edge_seeds_.data(),   facet_seeds_.data(), vertex_seeds_.data()};
  }

 private:
  void upload_seeds(const SeedFinder& seeds, const std::vector<Facet>& facets) {
    std::vector<EdgeSeeds> of_edges;
    std::vector<FacetSeeds> of_facets;
    std::vector<VertexSeeds> of_vertices;
    for (int e = 0; e < edge_count_; ++e) of_edges.push_back(seeds.of_edge(e));
    for (const Facet& facet : facets) of_facets.push_back(seeds.of_facet(facet));
    for (int v = 0; v < vertex_count_; ++v) of_vertices.push_back(seeds.of_vertex(v));
    edge_seeds_.upload(of_edges.data(), of_edges.size());
    facet_seeds_.upload(of_facets.data(), of_facets.size());
    vertex_seeds_.upload(of_vertices.data(), of_vertices.size());
  }

  struct RowBuffers {
    typename Backend::template Buffer<int> offsets, items;
    void upload(const compare::CompressedRows& rows) {
      offsets.upload(rows.offsets.data(), rows.offsets.size());
      items.upload(rows.items.data(), rows.items.size());
    }
    Rows view() const { return {offsets.data(), items.data()}; }
  };

  int vertex_count_, edge_count_, triangle_count_;
  typename Backend::template Buffer<Facet> facets_;
  typename Backend::template Buffer<EdgeEnds> edges_;
  RowBuffers neighbours_, opposites_, vertex_edges_, vertex_triangles_;
  typename Backend::template Buffer<int> groups_;
  typename Backend::template Buffer<EdgeSeeds> edge_seeds_;
  typename Backend::template Buffer<FacetSeeds> facet_seeds_;
  typename Backend::template Buffer<VertexSeeds> vertex_seeds_;
};

}  // namespace ogc::fast
