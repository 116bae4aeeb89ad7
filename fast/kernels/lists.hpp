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

/// An incidence that has no order yet, and whose it is.
struct alignas(8) LooseIncidence {
  std::uint32_t code;
  int vertex;
};

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
  LooseIncidence* loose = nullptr;   ///< row by row, in any order within one
  Incidence* incidences = nullptr;   ///< row by row, ascending

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

/// The vertices of a contact by role (contact_view.hpp); −1: nobody has it.
struct RoleVertices {
  int role[4] = {-1, -1, -1, -1};
};

/// What a raw contact stands for.
struct ContactFaces {
  SurfaceView surface;

  OGC_HD bool is_vertex_facet(const RawContact& contact) const { return contact.bucket < surface.vertex_count; }

  OGC_HD RoleVertices vertices(const RawContact& contact) const {
    RoleVertices of;
    if (is_vertex_facet(contact)) {
      of.role[0] = contact.bucket;
      const int e = contact.second - surface.vertex_count, t = e - surface.edge_count;
      if (t < 0) {
        write_face(contact.second, of.role + 1);
      } else {
        for (int k = 0; k < 3; ++k) of.role[1 + k] = surface.facets[t].corner[k];
      }
    } else {
      write_face(contact.bucket - surface.vertex_count, of.role);
      write_face(contact.second, of.role + 2);
    }
    return of;
  }

 private:
  OGC_HD void write_face(int face, int* vertices) const {
    if (face < surface.vertex_count) {
      vertices[0] = face;
    } else {
      vertices[0] = surface.edges[face - surface.vertex_count].a;
      vertices[1] = surface.edges[face - surface.vertex_count].b;
    }
  }
};

/// Of what stands in a bucket twice, the one with the lowest-numbered edges stays, and is counted for its bucket and its vertices. Index over all contacts in
/// their buckets.
struct DropDuplicates {
  ListsView lists;
  ContactFaces faces;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    RawContact own = lists.bucketed[i];
    bool stays = true;  // and no break below: reads that depend on one another are what a device waits for
    for (int k = lists.raw_offsets[own.bucket], end = lists.raw_offsets[own.bucket + 1]; k < end; ++k) {
      const RawContact other = lists.bucketed[k];
      stays &= !(other.second == own.second && (other < own || (!(own < other) && k < i)));
    }
    if (!stays) own.bucket = -1;
    lists.raw[i] = own;
    if (own.bucket < 0) return;
    atomic_add(&lists.record_counts[own.bucket], 1);
    for (const int v : faces.vertices(own).role) {
      if (v >= 0) atomic_add(&lists.incidence_counts[v], 1);
    }
  }
};

/// Incidences of record `number` of its kind into the rows of its vertices.
OGC_HD inline void add_incidences(const ListsView& lists, const RoleVertices& vertices, bool edge_edge, int number) {
  const std::uint32_t code = (edge_edge ? 0x80000000U : 0U) | static_cast<std::uint32_t>(number) << 2;
  int place[4] = {0, 0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const int v = vertices.role[k];
    if (v >= 0) place[k] = lists.incidence_offsets[v] + atomic_add(&lists.incidence_filled[v], 1);
  }
  for (int k = 0; k < 4; ++k) {  // after all four answers, in place of each after its own
    const int v = vertices.role[k];
    if (v >= 0) lists.loose[place[k]] = {code | static_cast<std::uint32_t>(k), v};
  }
}

/// Writes the record and the incidences of each contact that stayed; index over all contacts in their buckets.
struct WriteRecords {
  ListsView lists;
  ContactFaces faces;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const SurfaceView& surface = faces.surface;
    const int edge_edge_start = lists.record_offsets[surface.vertex_count];
    if (i == 0) *lists.edge_edge_count = lists.record_offsets[lists.buckets] - edge_edge_start;
    const RawContact own = lists.raw[i];
    if (own.bucket < 0) return;
    const bool edge_edge = !faces.is_vertex_facet(own);
    const int record = lists.record_offsets[own.bucket] + rank(own) - (edge_edge ? edge_edge_start : 0);
    const RoleVertices vertices = faces.vertices(own);
    const int* v = vertices.role;
    if (edge_edge) {
      const bool is_low_first = holds(own.bucket - surface.vertex_count, own.low);
      lists.edge_edge[record] = {{v[0], v[1]}, {v[2], v[3]}, is_low_first ? own.low : own.high, is_low_first ? own.high : own.low};
    } else {
      lists.vertex_facet[record] = {v[0], {v[1], v[2], v[3]}};
      lists.vertex_facet_face[record] = own.second;
    }
    add_incidences(lists, vertices, edge_edge, record);
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
  /// Whether the edge is or ends at the face. Of the two generating edges, `first_edge` is the one that holds the first face; the edges share no vertex, so only
  /// one does.
  OGC_HD bool holds(int face, int edge) const {
    const EdgeEnds& ends = faces.surface.edges[edge];
    return face < faces.surface.vertex_count ? (ends.a == face || ends.b == face) : face == faces.surface.edge_face(edge);
  }
};

/// Incidences of records that are there already. Index over all records: first the vertex–facet, then the edge–edge ones.
struct FillIncidences {
  ListsView lists;
  int vertex_facet_count;

  OGC_HD void operator()(int i) const {
    if (i < vertex_facet_count) {
      const VertexFacetRecord& record = lists.vertex_facet[i];
      add_incidences(lists, {{record.vertex, record.corner[0], record.corner[1], record.corner[2]}}, false, i);
    } else {
      const EdgeEdgeRecord& record = lists.edge_edge[i - vertex_facet_count];
      add_incidences(lists, {{record.first[0], record.first[1], record.second[0], record.second[1]}}, true, i - vertex_facet_count);
    }
  }
};

/// The contacts that nobody resolves as they are found.
struct Unresolved {
  OGC_HD void operator()(int, Incidence) const {}
};

/// Each row in ascending order, from loose incidences; resolve(place, incidence) for each in its place. Index over all incidences. Each counts those of its row
/// that come before it: rows are short, and no thread waits for the longest of them.
template <class Resolve>
struct RankIncidences {
  ListsView lists;
  Resolve resolve;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const LooseIncidence own = lists.loose[i];
    const int begin = lists.incidence_offsets[own.vertex], end = lists.incidence_offsets[own.vertex + 1];
    int place = begin;
    for (int k = begin; k < end; ++k) place += lists.loose[k].code < own.code ? 1 : 0;
    lists.incidences[place] = {own.code};
    resolve(place, Incidence{own.code});
  }
};

}  // namespace ogc::fast
