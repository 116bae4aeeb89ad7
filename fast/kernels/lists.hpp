// From raw contacts, appended in any order and more than once, to records in canonical order and to each vertex's incidences. A contact's bucket is its
// first face; inside a bucket each contact counts those before it, which costs far less than sorting all, and no thread waits for the longest bucket.
//
// Buckets: v for vertex–facet contacts of vertex v; V + p for edge–edge contacts whose first face is p. In this order buckets, and in a bucket the
// sorted seconds, have the canonical order of compare/stages. The searches note pairs that may be contacts: half as many again as the contacts where r is
// shorter than the edges, far more where it is longer. Where a list has no room nothing of the detection is used: all later kernels stop at the overflow
// flag, and the counts, which go on, say how much room the same detection needs.
#pragma once

#include "fast/contact_view.hpp"
#include "fast/kernels/atomic.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// A pair of edges first < second, or of vertex ~first and facet `second`.
struct alignas(8) NotedPair {
  int first, second;
};

/// `second` is the other face (SurfaceView's numbers); low < high the edges that generate an edge–edge pair, 0 for vertex–facet.
struct alignas(16) RawContact {
  int bucket, second, low, high;

  friend OGC_HD bool operator<(const RawContact& a, const RawContact& b) {
    return a.second != b.second ? a.second < b.second : (a.low != b.low ? a.low < b.low : a.high < b.high);
  }
};

OGC_HD inline bool operator<(const Incidence& a, const Incidence& b) { return a.code < b.code; }

struct ListsView {
  NotedPair* noted = nullptr;
  int noted_capacity = 0;
  int* noted_count = nullptr;       ///< also those that found no room
  RawContact* raw = nullptr;        ///< as appended; later those of `bucketed` at the same places, `bucket` -1 for what stands in its bucket twice
  RawContact* bucketed = nullptr;   ///< bucket by bucket
  int capacity = 0;                 ///< of raw, bucketed and both record arrays; incidences have four times as much
  int* cursor = nullptr;            ///< contacts appended, also those that found no room
  int* overflow = nullptr;          ///< sticky
  int buckets = 0;
  int* raw_counts = nullptr;        ///< by bucket
  int* raw_offsets = nullptr;       ///< buckets + 1
  int* raw_filled = nullptr;        ///< by bucket
  int* record_counts = nullptr;     ///< by bucket, without duplicates
  int* record_offsets = nullptr;    ///< buckets + 1
  int* edge_edge_count = nullptr;
  VertexFacetRecord* vertex_facet = nullptr;
  int* vertex_facet_face = nullptr;  ///< the second face of each record
  EdgeEdgeRecord* edge_edge = nullptr;
  int* incidence_counts = nullptr;   ///< by vertex
  int* incidence_offsets = nullptr;  ///< vertices + 1
  int* incidence_filled = nullptr;   ///< by vertex
  Incidence* incidences = nullptr;

  /// A pair closer than r, or, where not `certain`, too nearly so for a rounded distance to tell; the second number of a certain one is stored inverted.
  OGC_HD void note(NotedPair pair, bool certain) const {
    if (certain) pair.second = ~pair.second;
    const int place = atomic_add(noted_count, 1);
    if (place < noted_capacity) noted[place] = pair;
  }

  OGC_HD void append(const RawContact& contact) const {
    const int place = atomic_add(cursor, 1);
    if (place >= capacity) return;
    raw[place] = contact;
    atomic_add(&raw_counts[contact.bucket], 1);
  }
};

/// Start of a detection: index over the largest of buckets, vertices and primitives.
struct PrepareLists {
  ListsView lists;
  int vertices;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    if (i == 0) *lists.noted_count = *lists.cursor = *lists.edge_edge_count = 0;
    if (i < lists.buckets) lists.raw_counts[i] = lists.raw_filled[i] = lists.record_counts[i] = 0;
    if (i < vertices) lists.incidence_counts[i] = lists.incidence_filled[i] = 0;
  }
};

/// After the contacts are collected. Of pairs that found no room nobody knows which are contacts, so the contacts may want more in a second try.
struct CheckCapacity {
  ListsView lists;

  OGC_HD void operator()(int) const {
    if (*lists.overflow != 0 || (*lists.noted_count <= lists.noted_capacity && *lists.cursor <= lists.capacity)) return;
    *lists.overflow = 1;
  }
};

/// Beside CheckCapacity, so it may or may not see that there was no room: what it does then nobody reads, and it stays within the buckets as counted.
struct FillBuckets {
  ListsView lists;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const RawContact contact = lists.raw[i];
    lists.bucketed[lists.raw_offsets[contact.bucket] + atomic_add(&lists.raw_filled[contact.bucket], 1)] = contact;
  }
};

/// Of what stands in a bucket twice, the one with the lowest-numbered edges stays. Index over all contacts in their buckets.
struct DropDuplicates {
  ListsView lists;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    RawContact own = lists.bucketed[i];
    for (int k = lists.raw_offsets[own.bucket], end = lists.raw_offsets[own.bucket + 1]; k < end; ++k) {
      const RawContact other = lists.bucketed[k];
      if (other.second == own.second && (other < own || (!(own < other) && k < i))) {
        own.bucket = -1;
        break;
      }
    }
    lists.raw[i] = own;
    if (own.bucket >= 0) atomic_add(&lists.record_counts[own.bucket], 1);
  }
};

/// Writes the record of each contact that stayed; index over all contacts in their buckets.
struct WriteRecords {
  ListsView lists;
  SurfaceView surface;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const int edge_edge_start = lists.record_offsets[surface.vertex_count];
    if (i == 0) *lists.edge_edge_count = lists.record_offsets[lists.buckets] - edge_edge_start;
    const RawContact own = lists.raw[i];
    if (own.bucket < 0) return;
    const int record = lists.record_offsets[own.bucket] + rank(own);
    if (own.bucket < surface.vertex_count) {
      write_vertex_facet(own, record);
    } else {
      write_edge_edge(own, record - edge_edge_start);
    }
  }

 private:
  /// Those of the bucket that stayed and come before it.
  OGC_HD int rank(const RawContact& own) const {
    int before = 0;
    for (int k = lists.raw_offsets[own.bucket], end = lists.raw_offsets[own.bucket + 1]; k < end; ++k) {
      before += lists.raw[k].bucket >= 0 && lists.raw[k].second < own.second ? 1 : 0;
    }
    return before;
  }
  OGC_HD void count(int vertex) const {
    if (vertex >= 0) atomic_add(&lists.incidence_counts[vertex], 1);
  }
  OGC_HD void write_vertex_facet(const RawContact& contact, int record) const {
    VertexFacetRecord out{contact.bucket, {-1, -1, -1}};
    const int e = contact.second - surface.vertex_count, t = e - surface.edge_count;
    if (e < 0) {
      out.corner[0] = contact.second;
    } else if (t < 0) {
      out.corner[0] = surface.edges[e].a, out.corner[1] = surface.edges[e].b;
    } else {
      for (int k = 0; k < 3; ++k) out.corner[k] = surface.facets[t].corner[k];
    }
    lists.vertex_facet[record] = out;
    lists.vertex_facet_face[record] = contact.second;
    count(out.vertex);
    for (const int corner : out.corner) count(corner);
  }
  /// Of the two generating edges, `first_edge` is the one that holds the first face; the edges share no vertex, so only one does.
  OGC_HD void write_edge_edge(const RawContact& contact, int record) const {
    const int first = contact.bucket - surface.vertex_count;
    EdgeEdgeRecord out{{-1, -1}, {-1, -1}, contact.low, contact.high};
    write_face(first, out.first);
    write_face(contact.second, out.second);
    const EdgeEnds& low = surface.edges[contact.low];
    const bool is_low_first = first < surface.vertex_count ? (low.a == first || low.b == first) : first == surface.edge_face(contact.low);
    if (!is_low_first) out.first_edge = contact.high, out.second_edge = contact.low;
    lists.edge_edge[record] = out;
    for (int k = 0; k < 2; ++k) count(out.first[k]), count(out.second[k]);
  }
  OGC_HD void write_face(int face, int (&vertices)[2]) const {
    if (face < surface.vertex_count) {
      vertices[0] = face;
    } else {
      vertices[0] = surface.edges[face - surface.vertex_count].a;
      vertices[1] = surface.edges[face - surface.vertex_count].b;
    }
  }
};

/// Index over all records: first the vertex–facet, then the edge–edge ones.
struct FillIncidences {
  ListsView lists;
  SurfaceView surface;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const int edge_edge_start = lists.record_offsets[surface.vertex_count];
    if (i < edge_edge_start) {
      const VertexFacetRecord& record = lists.vertex_facet[i];
      const std::uint32_t code = static_cast<std::uint32_t>(i) << 2;
      add(record.vertex, code);
      for (int k = 0; k < 3; ++k) add(record.corner[k], code | static_cast<std::uint32_t>(k + 1));
    } else {
      const EdgeEdgeRecord& record = lists.edge_edge[i - edge_edge_start];
      const std::uint32_t code = 0x80000000U | static_cast<std::uint32_t>(i - edge_edge_start) << 2;
      for (int k = 0; k < 2; ++k) {
        add(record.first[k], code | static_cast<std::uint32_t>(k));
        add(record.second[k], code | static_cast<std::uint32_t>(k + 2));
      }
    }
  }

 private:
  OGC_HD void add(int vertex, std::uint32_t code) const {
    if (vertex < 0) return;
    lists.incidences[lists.incidence_offsets[vertex] + atomic_add(&lists.incidence_filled[vertex], 1)] = {code};
  }
};

/// Each row in ascending order, from rows in another array; index over all incidences. Each counts those of its row that come before it: rows are short, and
/// no thread waits for the longest of them.
struct RankIncidences {
  ListsView lists;
  const Incidence* unordered;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const Incidence own = unordered[i];
    const int v = vertex_of(own), begin = lists.incidence_offsets[v], end = lists.incidence_offsets[v + 1];
    int before = 0;
    for (int k = begin; k < end; ++k) before += unordered[k] < own ? 1 : 0;
    lists.incidences[begin + before] = own;
  }

 private:
  OGC_HD int vertex_of(const Incidence& incidence) const {
    const std::uint32_t record = (incidence.code & 0x7fffffffU) >> 2, role = incidence.code & 3U;
    if (incidence.code >> 31 != 0) return role < 2 ? lists.edge_edge[record].first[role] : lists.edge_edge[record].second[role - 2];
    return role == 0 ? lists.vertex_facet[record].vertex : lists.vertex_facet[record].corner[role - 1];
  }
};

}  // namespace ogc::fast
