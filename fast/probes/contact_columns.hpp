// Writes what a detection found into the columns of ContactColumns, where the detection ran.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "fast/contact_columns.hpp"
#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/probes/download.hpp"
#include "fast/stages/detection.hpp"

namespace ogc::fast {

/// What the host must know of a detection.
struct ContactSummary {
  int vertex_facet = 0, edge_edge = 0;  ///< numbers of records
  float smallest_distance = 0;          ///< of all pairs [m]; r_q if none is nearer
};

/// Begins a summary; runs once.
struct BeginSummary {
  const int *vertex_facet_count, *edge_edge_count;  ///< as in ContactView
  const float* query_radius;                        ///< r_q [m]
  ContactSummary* summary;                          ///< written

  OGC_HD void operator()(int) const { *summary = {*vertex_facet_count, *edge_edge_count, *query_radius}; }
};

/// The results of a detection by vertex, edge and triangle.
struct FoundDistances {
  int vertices = 0, edges = 0, triangles = 0;
  const float *d_min_vertex, *d_min_edge, *d_min_triangle, *bound;  ///< as in ContactColumns [m]

  int largest_count() const { return std::max({vertices, edges, triangles}); }
};

/// Finds the smallest distance. Runs once for each i that is an index of a vertex, an edge or a triangle.
struct FindSmallest {
  FoundDistances found;
  const float* query_radius;  ///< r_q [m]
  ContactSummary* summary;    ///< its distance is lowered

  OGC_HD void operator()(int i) const {
    float least = *query_radius;
    if (i < found.vertices) least = smaller(least, found.d_min_vertex[i]);
    if (i < found.edges) least = smaller(least, found.d_min_edge[i]);
    if (i < found.triangles) least = smaller(least, found.d_min_triangle[i]);
    lower(&summary->smallest_distance, least);
  }
};

/// Writes all columns. Runs once for each i that is an index of a vertex, an edge, a triangle or a record.
struct WriteColumns {
  FoundDistances found;
  int vertex_facets = 0, edge_edges = 0;  ///< numbers of records
  const VertexFacetRecord* vertex_facet_from;
  const int* faces;   ///< by vertex–facet record: number of the face, as SurfaceView numbers them
  const int* owners;  ///< by vertex, then by edge: the lowest-numbered triangle that contains it
  const EdgeEdgeRecord* edge_edge_from;
  float *d_min_vertex, *d_min_edge, *d_min_triangle, *bound;  ///< written, as the following
  std::array<compare::Index, 3>* vertex_facet;
  std::array<compare::Index, 4>* edge_edge;
  std::uint8_t* vertex_facet_kind;
  std::array<std::uint8_t, 2>* edge_edge_kind;

  OGC_HD void operator()(int i) const {
    if (i < found.vertices) d_min_vertex[i] = found.d_min_vertex[i], bound[i] = found.bound[i];
    if (i < found.edges) d_min_edge[i] = found.d_min_edge[i];
    if (i < found.triangles) d_min_triangle[i] = found.d_min_triangle[i];
    if (i < vertex_facets) write_vertex_facet(i);
    if (i < edge_edges) write_edge_edge(i);
  }

 private:
  OGC_HD void write_vertex_facet(int i) const {
    const int face = faces[i], edge = face - found.vertices, triangle = edge - found.edges;
    const int kind = triangle >= 0 ? 2 : (edge >= 0 ? 1 : 0);
    vertex_facet[i] = {vertex_facet_from[i].vertex, kind == 2 ? triangle : (kind == 1 ? edge : face),
                       kind == 2 ? triangle : owners[face]};
    vertex_facet_kind[i] = static_cast<std::uint8_t>(kind);
  }
  OGC_HD void write_edge_edge(int i) const {
    const EdgeEdgeRecord record = edge_edge_from[i];
    const bool first_is_edge = record.first[1] >= 0, second_is_edge = record.second[1] >= 0;
    edge_edge[i] = {first_is_edge ? record.first_edge : record.first[0],
                    second_is_edge ? record.second_edge : record.second[0], record.first_edge, record.second_edge};
    edge_edge_kind[i] = {static_cast<std::uint8_t>(first_is_edge), static_cast<std::uint8_t>(second_is_edge)};
  }
};

/// Memory of a backend.
template <class Backend>
class BackendMemory : public ColumnMemory {
 public:
  explicit BackendMemory(std::size_t count) { bytes_.resize(count); }
  const std::byte* data() const override { return bytes_.data(); }
  void download(std::byte* to, std::size_t count) const override { bytes_.download(to, count); }

 private:
  typename Backend::template Buffer<std::byte> bytes_;
};

/// Copies the results of detections over one surface into columns.
template <class Backend>
class ColumnWriter {
 public:
  ColumnWriter(Backend& backend, const compare::Topology& topology) : backend_(backend) {
    std::vector<int> owners;
    owners.reserve(topology.vertex_triangles.rows() + topology.edge_triangles.rows());
    for (const auto* rows : {&topology.vertex_triangles, &topology.edge_triangles})
      for (std::size_t i = 0; i < rows->rows(); ++i) owners.push_back((*rows)[i].empty() ? -1 : (*rows)[i].front());
    owners_.upload(owners.data(), owners.size());
    summary_.resize(1);
  }

  /// Returns the contacts, smallest distances and bounds of the last detection, whose r_q is *query_radius, on the
  /// backend; complete on return. Throws compare::ResourceError if there is no memory for them.
  ContactColumns columns_of(Detection<Backend>& detection, const float* query_radius) {
    const ContactView view = detection.view();
    const SurfaceView surface = detection.surface();
    const FoundDistances found{surface.vertex_count,
                               surface.edge_count,
                               surface.triangle_count,
                               view.d_min_vertex,
                               detection.d_min_edge(),
                               detection.d_min_triangle(),
                               view.bound};
    const ContactSummary summary = summarise(found, view, query_radius);
    const ColumnLengths lengths{static_cast<std::size_t>(found.vertices), static_cast<std::size_t>(found.edges),
                                static_cast<std::size_t>(found.triangles),
                                static_cast<std::size_t>(summary.vertex_facet),
                                static_cast<std::size_t>(summary.edge_edge)};
    ContactColumns columns(std::make_shared<BackendMemory<Backend>>(lengths.bytes()), lengths);
    columns.smallest_distance = summary.smallest_distance;
    columns.device = backend_.device();
    const WriteColumns write{.found = found,
                             .vertex_facets = summary.vertex_facet,
                             .edge_edges = summary.edge_edge,
                             .vertex_facet_from = view.vertex_facet,
                             .faces = detection.vertex_facet_faces(),
                             .owners = owners_.data(),
                             .edge_edge_from = view.edge_edge,
                             .d_min_vertex = writable(columns.d_min_vertex),
                             .d_min_edge = writable(columns.d_min_edge),
                             .d_min_triangle = writable(columns.d_min_triangle),
                             .bound = writable(columns.bound),
                             .vertex_facet = writable(columns.vertex_facet),
                             .edge_edge = writable(columns.edge_edge),
                             .vertex_facet_kind = writable(columns.vertex_facet_kind),
                             .edge_edge_kind = writable(columns.edge_edge_kind)};
    backend_.for_each(std::max({found.largest_count(), summary.vertex_facet, summary.edge_edge}), write);
    backend_.synchronize();
    return columns;
  }

 private:
  /// Returns the first row of a column for the writer, which alone has it until the columns are returned.
  template <class T>
  static T* writable(std::span<const T> column) {
    return const_cast<T*>(column.data());
  }

  ContactSummary summarise(const FoundDistances& found, const ContactView& view, const float* query_radius) {
    backend_.for_each(1, BeginSummary{view.vertex_facet_count, view.edge_edge_count, query_radius, summary_.data()});
    backend_.for_each(found.largest_count(), FindSmallest{found, query_radius, summary_.data()});
    backend_.synchronize();
    ContactSummary summary;
    summary_.download(&summary, 1);
    return summary;
  }

  Backend& backend_;
  typename Backend::template Buffer<int> owners_;
  typename Backend::template Buffer<ContactSummary> summary_;
};

}  // namespace ogc::fast
