// Turns the pairs that the searches noted into records in canonical order and into each vertex's incidences. A
// contact's bucket is its first face. Only one pair generates a contact of a vertex and a triangle's interior, or of
// two edge interiors: the thread that decides this pair takes a place in the list. Several pairs may generate any other
// contact: their threads enter it in a hash table, and the first of them takes the place. Then each contact counts the
// contacts before it in its bucket. This costs far less than sorting all contacts, and no thread waits for the longest
// bucket.
//
// Bucket v < V holds the vertex–facet contacts of vertex v; bucket V + p holds the edge–edge contacts whose first face
// is p. The buckets in this order, each sorted by second face, have the canonical order of compare/stages. If r is
// shorter than the edges, there are about 1.5 times as many noted pairs as contacts. If r is longer there are more,
// although block.hpp rejects most edge pairs.
//
// If a list is full, counting continues, so that the host learns how much room the detection needs. All later kernels
// stop at the overflow flag.
#pragma once

#include "fast/contact_view.hpp"
#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// Two edges first < second, or vertex ~first and facet `second`.
struct alignas(8) NotedPair {
  int first, second;
};

/// One contact, as a pair generates it. `second` is the other face (SurfaceView's numbers). low < high are the edges
/// that generate an edge–edge contact; vertex–facet contacts do not use them.
struct alignas(16) RawContact {
  int bucket, second, low, high;
};

/// Holds a contact in the hash table; an empty slot is all zeros.
struct alignas(16) ContactSlot {
  std::uint64_t key;  ///< bucket + 1 in the upper half, second in the lower
  /// complement of the packed edges, low in the upper half: the lowest-numbered edges have the largest value, and edges
  /// −1, −1 give 0
  std::uint64_t edges;
};

/// One contact of the list, with its slot of the hash table.
struct alignas(16) EnteredContact {
  static constexpr std::uint32_t nowhere = 0xffffffffU;  ///< slot of a contact that a single pair generates
  int bucket, second;                                    ///< as in RawContact
  std::uint32_t slot;                                    ///< slot of the table, or `nowhere`
};

/// An incidence before its row is sorted.
struct alignas(8) LooseIncidence {
  std::uint32_t code;  ///< as in Incidence
  int vertex;
};

/// Holds the vertices of a contact by role: a vertex and facet corners, or the ends of both edges. −1: no such vertex.
struct RoleVertices {
  int role[4] = {-1, -1, -1, -1};
};

/// Finds the faces and vertices of a contact from its bucket and second face.
struct ContactFaces {
  SurfaceView surface;

  /// Returns whether the bucket holds vertex–facet contacts. These buckets come first.
  OGC_HD bool is_vertex_facet(int bucket) const { return bucket < surface.vertex_count; }

  /// Returns whether only one pair generates the contact: it joins a vertex and a triangle's interior, or two edge
  /// interiors.
  OGC_HD bool is_of_one_pair(int bucket, int second) const {
    return is_vertex_facet(bucket) ? second >= surface.vertex_count + surface.edge_count
                                   : bucket >= 2 * surface.vertex_count;
  }

  /// Returns the contact's vertices by role.
  OGC_HD RoleVertices vertices(int bucket, int second) const {
    RoleVertices of;
    if (is_vertex_facet(bucket)) {
      of.role[0] = bucket;
      const int e = second - surface.vertex_count, t = e - surface.edge_count;
      if (t < 0) {
        write_face(second, of.role + 1);
      } else {
        for (int k = 0; k < 3; ++k) of.role[1 + k] = surface.facets[t].corner[k];
      }
    } else {
      write_face(bucket - surface.vertex_count, of.role);
      write_face(second, of.role + 2);
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

/// Holds the counts of a detection on the backend. Counting continues if a list is full, so that the host learns how
/// much room the detection needs.
struct ListStatus {
  int contacts = 0;      ///< contacts entered, including those without room
  int overflow = 0;      ///< not 0 once a list was too small; kernels never clear it
  int edge_edge = 0;     ///< edge–edge records
  int noted = 0;         ///< pairs noted, including those without room
  int without_slot = 0;  ///< attempts to enter a contact that found no slot of the table
};

/// Holds the lists on the backend. The pointers to single counts point into a ListStatus.
struct ListsView {
  /// Largest number of slots that the search for a contact visits. While all contacts have room, the table is at most
  /// half full. Then k consecutive slots are the homes of k or more keys with probability at most (√e / 2)ᵏ (Chernoff's
  /// bound, Poisson with mean k / 2): 4·10⁻²² for this k. If that happens, the lists grow.
  static constexpr int longest_search = 256;

  NotedPair* noted = nullptr;         ///< in any order; pairs surely nearer than r have their second number inverted
  int noted_capacity = 0;             ///< pairs beyond it are counted in noted_count and lost
  int* noted_count = nullptr;         ///< as in ListStatus
  ContactSlot* table = nullptr;       ///< empty before a detection, and after one that does not overflow
  std::uint32_t slot_mask = 0;        ///< slots − 1; the number of slots is a power of two, at least 2 · capacity
  EnteredContact* entered = nullptr;  ///< in any order, each contact once
  RawContact* bucketed = nullptr;     ///< bucket by bucket
  /// size of `entered`, `bucketed` and both record arrays; a quarter of the size of `incidences`
  int capacity = 0;
  int* contact_count = nullptr;  ///< as in ListStatus
  int* without_slot = nullptr;   ///< as in ListStatus
  int* overflow = nullptr;       ///< as in ListStatus
  int buckets = 0;
  int* record_counts = nullptr;   ///< by bucket: records, without those that had no room
  int* record_offsets = nullptr;  ///< buckets + 1 entries
  int* record_filled = nullptr;   ///< by bucket: contacts moved there so far
  int* edge_edge_count = nullptr;
  VertexFacetRecord* vertex_facet = nullptr;
  int* vertex_facet_face = nullptr;  ///< the second face of each record
  EdgeEdgeRecord* edge_edge = nullptr;
  int* incidence_counts = nullptr;   ///< by vertex: incidences, without those that had no room
  int* incidence_offsets = nullptr;  ///< vertices + 1 entries
  int* incidence_filled = nullptr;   ///< by vertex: incidences written so far
  LooseIncidence* loose = nullptr;   ///< row by row, in any order within a row
  Incidence* incidences = nullptr;   ///< row by row, ascending

  /// Notes a pair that is nearer than r (`certain`), or whose rounded distance is too near to r to decide. The second
  /// number of a certain pair is stored inverted.
  OGC_HD void note(NotedPair pair, bool certain) const {
    if (certain) pair.second = ~pair.second;
    const int place = atomic_add(noted_count, 1);
    if (place < noted_capacity) noted[place] = pair;
  }

  /// Enters a contact, once for each pair that generates it. The table keeps the lowest-numbered edges of these pairs.
  /// A contact of only one pair needs no table.
  OGC_HD void enter(const RawContact& contact, const ContactFaces& faces) const {
    if (faces.is_of_one_pair(contact.bucket, contact.second)) return place(contact, EnteredContact::nowhere, faces);
    const std::uint64_t key = pack(contact.bucket + 1, contact.second), edges = ~pack(contact.low, contact.high);
    std::uint32_t at = home(key);
    for (int looks = 0; looks < longest_search; ++looks, at = (at + 1) & slot_mask) {
      ContactSlot& slot = table[at];
      std::uint64_t found = atomic_load(&slot.key);
      // Loaded together with the key: a later load would cost a second latency.
      const std::uint64_t found_edges = atomic_load(&slot.edges);
      if (found == 0) found = atomic_compare_exchange(&slot.key, 0, key);
      if (found != 0 && found != key) continue;
      if (edges > found_edges) atomic_max(&slot.edges, edges);
      if (found == 0) place(contact, at, faces);
      return;
    }
    atomic_add(without_slot, 1);
  }

  /// Adds `amount`, 1 or −1, to the counts of a contact's record and incidences.
  OGC_HD void count(int bucket, const RoleVertices& vertices, int amount) const {
    atomic_add(&record_counts[bucket], amount);
    for (const int v : vertices.role) {
      if (v >= 0) atomic_add(&incidence_counts[v], amount);
    }
  }

 private:
  OGC_HD static std::uint64_t pack(int above, int below) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(above)) << 32 | static_cast<std::uint32_t>(below);
  }

  /// Returns the slot at which the search for a key begins. Neighbouring faces and buckets have consecutive keys; the
  /// hash spreads their slots.
  OGC_HD std::uint32_t home(std::uint64_t key) const {
    constexpr std::uint64_t spread = 0x9e3779b97f4a7c15U;  // 2⁶⁴ times the golden ratio
    key *= spread;
    return static_cast<std::uint32_t>((key ^ key >> 32) * spread >> 32) & slot_mask;
  }

  OGC_HD void place(const RawContact& contact, std::uint32_t slot, const ContactFaces& faces) const {
    const RoleVertices vertices = faces.vertices(contact.bucket,
                                                 // loaded before atomic_add, so that latencies overlap
                                                 contact.second);
    const int place = atomic_add(contact_count, 1);
    if (place >= capacity) return;
    entered[place] = {contact.bucket, contact.second, slot};
    count(contact.bucket, vertices, 1);
  }
};

/// Clears the contacts but not the noted pairs. Index over buckets or vertices, whichever are more.
struct ForgetContacts {
  ListsView lists;
  int vertices;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    if (i == 0) *lists.contact_count = *lists.without_slot = *lists.edge_edge_count = 0;
    if (i < lists.buckets) lists.record_counts[i] = lists.record_filled[i] = 0;
    if (i < vertices) lists.incidence_counts[i] = lists.incidence_filled[i] = 0;
  }
};

/// Clears the noted pairs. One item.
struct ForgetNoted {
  ListsView lists;

  OGC_HD void operator()(int) const {
    if (*lists.overflow == 0) *lists.noted_count = 0;
  }
};

/// Clears all lists at the start of a detection. Index over buckets or vertices, whichever are more.
struct PrepareLists {
  ListsView lists;
  int vertices;

  OGC_HD void operator()(int i) const {
    if (i == 0) ForgetNoted{lists}(i);
    ForgetContacts{lists, vertices}(i);
  }
};

/// Sets the overflow flag if a list was too small; runs after the contacts are collected. Lost pairs may be contacts,
/// so a second try may need still more room.
struct CheckCapacity {
  ListsView lists;

  OGC_HD void operator()(int) const {
    const bool fits = *lists.noted_count <= lists.noted_capacity && *lists.contact_count <= lists.capacity &&
                      *lists.without_slot == 0;
    if (*lists.overflow == 0 && !fits) *lists.overflow = 1;
  }
};

/// Moves each contact to its bucket, with its edges from the table, and clears its slot. A contact of two edge
/// interiors has its faces as edges. This kernel runs beside CheckCapacity and may miss a new overflow flag: then
/// nothing reads its output, and it writes only within the counted buckets. Index over all contacts.
struct FillBuckets {
  ListsView lists;
  int vertex_count;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const EnteredContact contact = lists.entered[i];
    RawContact to{contact.bucket, contact.second, contact.bucket - 2 * vertex_count, contact.second - vertex_count};
    const int place = lists.record_offsets[contact.bucket] + atomic_add(&lists.record_filled[contact.bucket], 1);
    if (contact.slot != EnteredContact::nowhere) {
      ContactSlot& slot = lists.table[contact.slot];
      const std::uint64_t edges = ~slot.edges;
      slot = {0, 0};
      to.low = static_cast<int>(edges >> 32), to.high = static_cast<int>(edges & 0xffffffffU);
    }
    lists.bucketed[place] = to;
  }
};

/// Adds the incidences of a record to the rows of its vertices; `number` counts the records of its kind.
OGC_HD inline void add_incidences(const ListsView& lists, const RoleVertices& vertices, bool edge_edge, int number) {
  const std::uint32_t code = (edge_edge ? 0x80000000U : 0U) | static_cast<std::uint32_t>(number) << 2;
  int place[4] = {0, 0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const int v = vertices.role[k];
    if (v >= 0) place[k] = lists.incidence_offsets[v] + atomic_add(&lists.incidence_filled[v], 1);
  }
  for (int k = 0; k < 4; ++k) {  // a second loop, so that the latencies of the four atomics overlap
    const int v = vertices.role[k];
    if (v >= 0) lists.loose[place[k]] = {code | static_cast<std::uint32_t>(k), v};
  }
}

/// Writes the record and the incidences of each contact. Index over all contacts in their buckets.
struct WriteRecords {
  ListsView lists;
  ContactFaces faces;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const SurfaceView& surface = faces.surface;
    const int edge_edge_start = lists.record_offsets[surface.vertex_count];
    if (i == 0) *lists.edge_edge_count = lists.record_offsets[lists.buckets] - edge_edge_start;
    const RawContact own = lists.bucketed[i];
    const bool edge_edge = !faces.is_vertex_facet(own.bucket);
    const int record = rank(own) - (edge_edge ? edge_edge_start : 0);
    const RoleVertices vertices = faces.vertices(own.bucket, own.second);
    const int* v = vertices.role;
    if (edge_edge) {
      const bool is_low_first = holds(own.bucket - surface.vertex_count, own.low);
      lists.edge_edge[record] = {
          {v[0], v[1]}, {v[2], v[3]}, is_low_first ? own.low : own.high, is_low_first ? own.high : own.low};
    } else {
      lists.vertex_facet[record] = {v[0], {v[1], v[2], v[3]}};
      lists.vertex_facet_face[record] = own.second;
    }
    add_incidences(lists, vertices, edge_edge, record);
  }

 private:
  /// Returns the place of a contact: the number of contacts in earlier buckets and of those in its own bucket with a
  /// smaller second face.
  OGC_HD int rank(const RawContact& own) const {
    const int begin = lists.record_offsets[own.bucket], end = lists.record_offsets[own.bucket + 1];
    int before = begin;
    for (int k = begin; k < end; ++k) before += lists.bucketed[k].second < own.second ? 1 : 0;
    return before;
  }
  /// Returns whether the face is the edge's interior or one of its ends. A record's `first_edge` is the generating edge
  /// that holds the first face. The other generating edge does not: the two share no vertex.
  OGC_HD bool holds(int face, int edge) const {
    const EdgeEnds& ends = faces.surface.edges[edge];
    return face < faces.surface.vertex_count ? (ends.a == face || ends.b == face)
                                             : face == faces.surface.edge_face(edge);
  }
};

/// Adds the incidences of existing records. Index over all records, vertex–facet ones first.
struct FillIncidences {
  ListsView lists;
  int vertex_facet_count;  ///< vertex–facet records; edge–edge ones follow in the index

  OGC_HD void operator()(int i) const {
    if (i < vertex_facet_count) {
      const VertexFacetRecord& record = lists.vertex_facet[i];
      add_incidences(lists, {{record.vertex, record.corner[0], record.corner[1], record.corner[2]}}, false, i);
    } else {
      const EdgeEdgeRecord& record = lists.edge_edge[i - vertex_facet_count];
      add_incidences(lists, {{record.first[0], record.first[1], record.second[0], record.second[1]}}, true,
                     i - vertex_facet_count);
    }
  }
};

/// Sorts each row of loose incidences in ascending order. Index over all incidences: each counts the smaller ones of
/// its row. Rows are short, and no thread waits for the longest row.
struct RankIncidences {
  ListsView lists;

  OGC_HD void operator()(int i) const {
    if (*lists.overflow == 0) put(lists.loose[i]);
  }

  /// Writes an incidence at its place, and returns the place.
  OGC_HD int put(const LooseIncidence& own) const {
    const int begin = lists.incidence_offsets[own.vertex], end = lists.incidence_offsets[own.vertex + 1];
    int place = begin;
    for (int k = begin; k < end; ++k) place += lists.loose[k].code < own.code ? 1 : 0;
    lists.incidences[place] = {own.code};
    return place;
  }
};

}  // namespace ogc::fast
