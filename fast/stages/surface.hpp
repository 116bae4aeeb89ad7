// Uploads the mesh's vertices, edges and triangles once; every stage of a detection reads them.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// Returns corners, edges and edge directions of triangle t for the kernels.
Facet facet_of(const compare::Topology& topology, std::size_t t);

/// The seeds of searches (fast/kernels/bvh.hpp): near neighbours in the mesh that are neither adjacent nor excluded.
/// Their distance limits a search.
struct Seeds {
  std::vector<EdgeSeeds> edges;       ///< by edge
  std::vector<FacetSeeds> facets;     ///< by triangle
  std::vector<VertexSeeds> vertices;  ///< by vertex
};

/// Returns the seeds. `groups`, `partners`: exclusions by vertex (compare/problem/exclusions.hpp); `partners` is null
/// if there are none.
Seeds find_seeds(const compare::Topology& topology, const std::vector<int>& groups,
                 const compare::CompressedRows* partners, const std::vector<Facet>& facets);

/// The primitives that searches visit (SurfaceView::searched), and the number of each kind. An empty list means all
/// primitives.
struct Searched {
  std::vector<int> numbers;  ///< numbers of vertices, then of edges, then of facets
  int vertices = 0, edges = 0, facets = 0;
};

/// Returns all primitives that do not belong to volumes.
Searched find_searched(const compare::Topology& topology);

/// Holds the vertices, edges and triangles of one mesh on the backend.
template <class Backend>
class Surface {
 public:
  Surface(const compare::Topology& topology, const compare::ExclusionView& exclusions)
      : vertex_count_(topology.vertex_count),
        edge_count_(static_cast<int>(topology.edges.size())),
        triangle_count_(static_cast<int>(topology.triangles.size())) {
    std::vector<Facet> facets(topology.triangles.size());
    for (std::size_t t = 0; t < facets.size(); ++t) facets[t] = facet_of(topology, t);
    std::vector<EdgeEnds> edges(topology.edges.size());
    std::transform(topology.edges.begin(), topology.edges.end(), edges.begin(), [](const compare::Edge& e) {
      return EdgeEnds{e[0], e[1]};
    });
    facets_.upload(facets.data(), facets.size());
    edges_.upload(edges.data(), edges.size());
    neighbours_.upload(topology.vertex_neighbours);
    opposites_.upload(topology.edge_opposite);
    vertex_edges_.upload(topology.vertex_edges);
    vertex_triangles_.upload(topology.vertex_triangles);
    off_surface_.upload(topology.off_surface.data(), topology.off_surface.size());
    std::vector<int> groups(exclusions.groups.begin(), exclusions.groups.end());
    groups.resize(static_cast<std::size_t>(vertex_count_), -1);
    groups_.upload(groups.data(), groups.size());
    if (exclusions.partners != nullptr) partners_.upload(*exclusions.partners);
    has_partners_ = exclusions.partners != nullptr;
    upload_seeds(find_seeds(topology, groups, exclusions.partners, facets));
    searched_ = find_searched(topology);
    searched_numbers_.upload(searched_.numbers.data(), searched_.numbers.size());
  }

  /// Returns SurfaceView::searched on the host; empty if searches visit all primitives.
  const std::vector<int>& searched() const { return searched_.numbers; }

  /// Returns the surface as kernels see it.
  SurfaceView view() const {
    return {.vertex_count = vertex_count_,
            .edge_count = edge_count_,
            .triangle_count = triangle_count_,
            .facets = facets_.data(),
            .edges = edges_.data(),
            .neighbours = neighbours_.view(),
            .opposites = opposites_.view(),
            .vertex_edges = vertex_edges_.view(),
            .vertex_triangles = vertex_triangles_.view(),
            .off_surface = off_surface_.size() > 0 ? off_surface_.data() : nullptr,
            .groups = groups_.data(),
            .edge_seeds = edge_seeds_.data(),
            .facet_seeds = facet_seeds_.data(),
            .vertex_seeds = vertex_seeds_.data(),
            .partners = has_partners_ ? partners_.view() : Rows{},
            .searched = searched_numbers_.size() > 0 ? searched_numbers_.data() : nullptr,
            .searched_vertices = searched_.vertices,
            .searched_edges = searched_.edges,
            .searched_facets = searched_.facets};
  }

 private:
  void upload_seeds(const Seeds& seeds) {
    edge_seeds_.upload(seeds.edges.data(), seeds.edges.size());
    facet_seeds_.upload(seeds.facets.data(), seeds.facets.size());
    vertex_seeds_.upload(seeds.vertices.data(), seeds.vertices.size());
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
  Searched searched_;
  typename Backend::template Buffer<int> searched_numbers_;
  typename Backend::template Buffer<Facet> facets_;
  typename Backend::template Buffer<EdgeEnds> edges_;
  RowBuffers neighbours_, opposites_, vertex_edges_, vertex_triangles_, partners_;
  bool has_partners_ = false;
  typename Backend::template Buffer<std::uint8_t> off_surface_;
  typename Backend::template Buffer<int> groups_;
  typename Backend::template Buffer<EdgeSeeds> edge_seeds_;
  typename Backend::template Buffer<FacetSeeds> facet_seeds_;
  typename Backend::template Buffer<VertexSeeds> vertex_seeds_;
};

}  // namespace ogc::fast
