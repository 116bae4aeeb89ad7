// Turns the pairs that the searches note into records in canonical order and into each vertex's incidences. A contact's
// bucket is its first face. Only one pair generates a contact of two interiors; the thread that decides the pair takes
// a place in the list for it. Several pairs may generate any other contact: threads enter it in a hash table, and the
// first of them takes the place. Inside a bucket each contact then counts those before it, which costs far less than
// sorting all, and no thread waits for the longest bucket.
//
// Buckets: v holds the vertex–facet contacts of vertex v, V + p the edge–edge contacts whose first face is p. In this
// order the buckets, and the sorted second faces in each bucket, have the canonical order of compare/stages. The
// searches note pairs that may be contacts: half as many again as there are contacts if r is shorter than the edges,
// more if r is longer. block.hpp keeps the number of noted edge pairs small then, too.
//
// If a list has no room the detection goes on counting, so that the host learns how much room it needs, and all later
// kernels stop at the overflow flag.
#pragma once

#include "fast/contact_view.hpp"
#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// A pair of edges first < second, or of vertex ~first and facet `second`.
struct alignas(8) NotedPair {
  int first, second;
};

/// A contact as one pair generates it. `second` is the other face (SurfaceView's numbers). low < high are the edges
/// that generate an edge–edge contact; they mean nothing for vertex–facet contacts.
struct alignas(16) RawContact {
  int bucket, second, low, high;
};

/// Holds a contact in the hash table. An empty slot is all zeros, so an empty table needs no values of its own.
struct alignas(16) ContactSlot {
  std::uint64_t key;  ///< bucket + 1 in the upper half, second in the lower
  /// ~(low in the upper half, high in the lower): the largest value has the lowest-numbered edges, and −1, −1 is 0
  std::uint64_t edges;
};

/// Holds a contact at its place in the list, and where the table has it.
struct alignas(16) EnteredContact {
  static constexpr std::uint32_t nowhere = 0xffffffffU;  ///< slot of a contact that a single pair generates
  int bucket, second;                                    ///< as in RawContact
  std::uint32_t slot;                                    ///< slot of the table, or `nowhere`
};

/// Holds an incidence that has no order yet, and its vertex.
struct alignas(8) LooseIncidence {
  std::uint32_t code;  ///< as in Incidence
  int vertex;
};

/// Holds the vertices of a contact by role (contact_view.hpp); −1: the contact lacks this role.
struct RoleVertices {
  int role[4] = {-1, -1, -1, -1};
};

/// Finds the faces and vertices that a contact stands for.
struct ContactFaces {
  SurfaceView surface;

  /// Returns whether the bucket is one of a vertex; those come first, buckets of edge–edge contacts behind them.
  OGC_HD bool is_vertex_facet(int bucket) const { return bucket < surface.vertex_count; }

  /// Returns whether only one pair generates the contact: the pair of its two interiors, which a search notes once.
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

/// Counts of a detection, on the backend. Counting goes on if a list has no room: the host learns how much room the
/// same detection needs.
struct ListStatus {
  int contacts = 0;      ///< contacts entered, also those that found no room
  int overflow = 0;      ///< not 0 once a list was too small; sticky
  int edge_edge = 0;     ///< edge–edge records
  int noted = 0;         ///< pairs noted, also those that found no room
  int without_slot = 0;  ///< contacts that found no slot of the table; each counts as often as it was generated
};

/// Holds the lists on the backend; `contact_count`, `without_slot`, `overflow`, `noted_count` and `edge_edge_count`
/// point into their ListStatus.
struct ListsView {
  /// Largest number of slots that the search for a contact visits. The table is at most half full while all contacts
  /// have room. Then k slots in a row are the homes of k keys or more with a probability of at most (√e / 2)ᵏ
  /// (Chernoff's bound for a Poisson number of mean k / 2), 4·10⁻²² for these; if it happens all the same, the lists
  /// grow.
  static constexpr int longest_search = 256;

  NotedPair* noted = nullptr;         ///< in any order; pairs surely nearer than r have their second number inverted
  int noted_capacity = 0;             ///< pairs beyond it are counted in noted_count and lost
  int* noted_count = nullptr;         ///< pairs noted, also those that found no room
  ContactSlot* table = nullptr;       ///< empty before a detection, and after one that does not overflow
  std::uint32_t slot_mask = 0;        ///< slots − 1; the number of slots is a power of two, at least 2 · capacity
  EnteredContact* entered = nullptr;  ///< in any order, each contact once
  RawContact* bucketed = nullptr;     ///< bucket by bucket
  /// room of entered, bucketed and both record arrays; incidences have four times as much
  int capacity = 0;
  int* contact_count = nullptr;  ///< contacts entered, also those that found no room
  int* without_slot = nullptr;   ///< contacts that found no slot; each counts as often as it was generated
  int* overflow = nullptr;       ///< sticky
  int buckets = 0;
  int* record_counts = nullptr;   ///< by bucket, of contacts that found room
  int* record_offsets = nullptr;  ///< buckets + 1
  int* record_filled = nullptr;   ///< by bucket
  int* edge_edge_count = nullptr;
  VertexFacetRecord* vertex_facet = nullptr;
  int* vertex_facet_face = nullptr;  ///< the second face of each record
  EdgeEdgeRecord* edge_edge = nullptr;
  int* incidence_counts = nullptr;   ///< by vertex, of contacts that found room
  int* incidence_offsets = nullptr;  ///< vertices + 1
  int* incidence_filled = nullptr;   ///< by vertex
  LooseIncidence* loose = nullptr;   ///< row by row, in any order within a row
  Incidence* incidences = nullptr;   ///< row by row, ascending

  /// Notes a pair that is nearer than r, or, if not `certain`, so near to it that a rounded distance can't tell. The
  /// second number of a certain pair is stored inverted.
  OGC_HD void note(NotedPair pair, bool certain) const {
    if (certain) pair.second = ~pair.second;
    const int place = atomic_add(noted_count, 1);
    if (place < noted_capacity) noted[place] = pair;
  }

  /// Enters a contact, each time that it is generated; the table keeps the lowest-numbered edges of all times. A
  /// contact that only one pair generates needs no table.
  OGC_HD void enter(const RawContact& contact, const ContactFaces& faces) const {
    if (faces.is_of_one_pair(contact.bucket, contact.second)) return place(contact, EnteredContact::nowhere, faces);
    const std::uint64_t key = pack(contact.bucket + 1, contact.second), edges = ~pack(contact.low, contact.high);
    std::uint32_t at = home(key);
    for (int looks = 0; looks < longest_search; ++looks, at = (at + 1) & slot_mask) {
      ContactSlot& slot = table[at];
      std::uint64_t found = atomic_load(&slot.key);
      // Read beside the key: one after the other would cost two latencies.
      const std::uint64_t found_edges = atomic_load(&slot.edges);
      if (found == 0) found = atomic_compare_exchange(&slot.key, 0, key);
      if (found != 0 && found != key) continue;
      if (edges > found_edges) atomic_max(&slot.edges, edges);
      if (found == 0) place(contact, at, faces);
      return;
    }
    atomic_add(without_slot, 1);
  }

  /// Counts the record of a contact and its incidences; `amount` is 1, or −1 to take them back.
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

  /// Returns the slot at which the search for a key begins. Faces and buckets that are near each other on the surface
  /// have consecutive keys; the hash keeps their slots apart.
  OGC_HD std::uint32_t home(std::uint64_t key) const {
    constexpr std::uint64_t spread = 0x9e3779b97f4a7c15U;  // 2⁶⁴ times the golden ratio
    key *= spread;
    return static_cast<std::uint32_t>((key ^ key >> 32) * spread >> 32) & slot_mask;
  }

  OGC_HD void place(const RawContact& contact, std::uint32_t slot, const ContactFaces& faces) const {
    const RoleVertices vertices = faces.vertices(contact.bucket,
                                                 contact.second);  // read while atomic_add is under way
    const int place = atomic_add(contact_count, 1);
    if (place >= capacity) return;
    entered[place] = {contact.bucket, contact.second, slot};
    count(contact.bucket, vertices, 1);
  }
};

/// Empties the contacts; noted pairs stay. Index over the larger of buckets and vertices.
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

/// Empties the noted pairs. One item.
struct ForgetNoted {
  ListsView lists;

  OGC_HD void operator()(int) const {
    if (*lists.overflow == 0) *lists.noted_count = 0;
  }
};

/// Empties all lists at the start of a detection. Index over the largest of buckets, vertices and primitives.
struct PrepareLists {
  ListsView lists;
  int vertices;

  OGC_HD void operator()(int i) const {
    if (i == 0) ForgetNoted{lists}(i);
    ForgetContacts{lists, vertices}(i);
  }
};

/// Sets the overflow flag if a list was too small, after the contacts are collected. Pairs that found no room may be
/// contacts, too, so a second try may need still more room.
struct CheckCapacity {
  ListsView lists;

  OGC_HD void operator()(int) const {
    const bool fits = *lists.noted_count <= lists.noted_capacity && *lists.contact_count <= lists.capacity &&
                      *lists.without_slot == 0;
    if (*lists.overflow == 0 && !fits) *lists.overflow = 1;
  }
};

/// Moves each contact to its bucket, with the edges that the table has by now, and clears its slot. The edges of a
/// contact of two interiors are its faces. Runs beside CheckCapacity, so it may not see that there was no room; nothing
/// reads its output then, and it stays within the buckets as counted. Index over all contacts.
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

/// Adds the incidences of record `number` of its kind to the rows of its vertices.
OGC_HD inline void add_incidences(const ListsView& lists, const RoleVertices& vertices, bool edge_edge, int number) {
  const std::uint32_t code = (edge_edge ? 0x80000000U : 0U) | static_cast<std::uint32_t>(number) << 2;
  int place[4] = {0, 0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const int v = vertices.role[k];
    if (v >= 0) place[k] = lists.incidence_offsets[v] + atomic_add(&lists.incidence_filled[v], 1);
  }
  for (int k = 0; k < 4; ++k) {  // a loop of its own, so that one latency covers all four atomics
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
  /// Returns the number of contacts in all buckets before its own, and of those in its own with a smaller second face.
  OGC_HD int rank(const RawContact& own) const {
    const int begin = lists.record_offsets[own.bucket], end = lists.record_offsets[own.bucket + 1];
    int before = begin;
    for (int k = begin; k < end; ++k) before += lists.bucketed[k].second < own.second ? 1 : 0;
    return before;
  }
  /// Returns whether the edge is the face or ends at it. Of the two generating edges, `first_edge` is the one that
  /// holds the first face; the edges share no vertex, so only one does.
  OGC_HD bool holds(int face, int edge) const {
    const EdgeEnds& ends = faces.surface.edges[edge];
    return face < faces.surface.vertex_count ? (ends.a == face || ends.b == face)
                                             : face == faces.surface.edge_face(edge);
  }
};

/// Adds the incidences of records that exist already. Index over all records, vertex–facet ones first.
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

/// Sorts each row of loose incidences in ascending order. Index over all incidences. Each counts those of its row that
/// come before it: rows are short, and no thread waits for the longest of them.
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
