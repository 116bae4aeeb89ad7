// Declares the results of a detection that the sweep reads. They are plain pointers, valid until the lists grow.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// A contact (v, a): corner[1] = corner[2] = -1 if a is a vertex, corner[2] = -1 if a is an edge.
struct alignas(16) VertexFacetRecord {
  int vertex;     ///< v
  int corner[3];  ///< vertices of a; a triangle's are in the order of the mesh
};

/// A contact {p, q}: first[1] = −1 if p is a vertex, second[1] = −1 if q is a vertex. If p and q are edges, first_edge
/// and second_edge are their indices, because the mollifier needs their rest lengths. For other contacts see
/// compare/stages/detect_edge_edge.hpp.
struct alignas(8) EdgeEdgeRecord {
  int first[2];   ///< vertices of p; of an edge, the smaller first
  int second[2];  ///< vertices of q; of an edge, the smaller first
  /// the edges that generate the contact: the first is p or ends at p, the second is q or ends at q
  int first_edge, second_edge;
};

/// A contact as one of its vertices sees it. Codes ascend within a vertex's row, so that sums have a fixed order.
/// Vertex–facet: role 0 is the vertex, roles 1 … 3 are the corners. Edge–edge: roles 0, 1 are the vertices of p, roles
/// 2, 3 those of q.
struct Incidence {
  std::uint32_t code;  ///< bit 31: edge–edge; bits 2 … 30: number of the record; bits 0, 1: role
};

/// Numbers the rows of incidences. A vertex has two rows: one for its vertex–facet contacts, one for its edge–edge
/// contacts. All rows of vertex–facet contacts come first.
struct RowNumbers {
  /// by vertex: the place of its rows among the rows of their kind, 0 … vertex_count − 1; null: its number
  const int* place = nullptr;
  int vertex_count = 0;

  /// Returns the number of a vertex's row.
  OGC_HD int operator()(int vertex, bool edge_edge) const {
    return (place != nullptr ? place[vertex] : vertex) + (edge_edge ? vertex_count : 0);
  }
  OGC_HD int count() const { return 2 * vertex_count; }  ///< number of rows
};

/// Holds the contacts of a detection. Records are in canonical order (compare/stages), so numbers and sums do not
/// depend on the order of atomics.
struct ContactView {
  /// All pointers are to the backend. After a detection that overflowed, their contents must not be used.
  const VertexFacetRecord* vertex_facet = nullptr;
  const EdgeEdgeRecord* edge_edge = nullptr;
  const int* vertex_facet_count = nullptr;  ///< number of records, unknown to the host
  const int* edge_edge_count = nullptr;     ///< number of records
  RowNumbers rows;                          ///< numbers of the rows of `incidences`
  const int* incidence_offsets = nullptr;   ///< rows.count() + 1
  const Incidence* incidences = nullptr;    ///< row k: from incidence_offsets[k]
  const float* bound = nullptr;             ///< b_v, Eq. 21 [m]
  /// by vertex: smallest distance (Eq. 22) [m], at most r_q; if bounds are planes, the smallest distance of all pairs
  /// that contain the vertex
  const float* d_min_vertex = nullptr;
};

}  // namespace ogc::fast
