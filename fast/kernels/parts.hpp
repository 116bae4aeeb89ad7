// Divides a simulation among several backends of one host, its parts. Each part holds the whole state and makes the
// same decisions; work is divided, not data:
//
//   searches   a part makes every n-th run of searches, and decides the pairs that these note
//   contacts   every part takes over the others' contacts and has the records of all, but incidences of its own
//              vertices only, so that the records have the numbers that one part would give them
//   bounds     a part computes those of its own vertices, and sends them to all others
//   guess      a part moves its own vertices, and sends the positions to all others
//   sweep      the same, colour by colour, but a position goes only to parts that read it (Readers); what the others
//              lack goes to all parts before a detection and at the end of the step
//
// The rest (trees, certificates, sums) every part does by itself, with the same bits. A part's own vertices are a range
// of numbers. Between two launches that need the others' results the parts meet (Backend::meet): each writes messages
// and positions into the memory of others, then waits for theirs.
#pragma once

#include <cstdint>

#include "fast/kernels/bound.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// Numbers that a part sends to the others at a meeting.
struct alignas(16) PartMessage {
  int cut = 0, moved = 0, not_finite = 0;  ///< as in StepControl, of the part's own vertices
  int contacts = 0;                        ///< contacts that the part has entered
  int too_long = 0;                        ///< 1: a list of the part was too small
};

/// Arrays of a part which the others read or write.
struct PartArrays {
  Vec *position = nullptr, *taken = nullptr;                                        ///< those of StepState
  PaddedVec* padded = nullptr;                                                      ///< the same
  LeftForce* left = nullptr;                                                        ///< by slot
  float *d_min_vertex = nullptr, *d_min_edge = nullptr, *d_min_triangle = nullptr;  ///< of a detection [m]
  float* bound = nullptr;                                                           ///< b_v by vertex [m]
  const RawContact* found = nullptr;  ///< contacts of the part's own searches
  PartMessage* inbox = nullptr;       ///< [meeting, even or odd][part that sends]
};

/// The parts as kernels see them. The pointers are on the backend.
struct PartsView {
  int own = 0, count = 1;                   ///< number of this part; number of parts
  const PartArrays* arrays = nullptr;       ///< by part
  const int* begin = nullptr;               ///< part p has the vertices begin[p] … begin[p + 1] − 1
  const std::uint32_t* meetings = nullptr;  ///< number of meetings so far

  /// Returns the part that has a vertex.
  OGC_HD int part_of(int v) const {
    int p = 0;
    while (v >= begin[p + 1]) ++p;
    return p;
  }
  /// Sends a message to all other parts, for the meeting that follows.
  OGC_HD void send(const PartMessage& message) const {
    for (int p = 0; p < count; ++p)
      if (p != own) arrays[p].inbox[inbox_row() + own] = message;
  }
  /// Returns the message of another part, once the meeting has ended.
  OGC_HD const PartMessage& received(int p) const { return arrays[own].inbox[inbox_row() + p]; }

 private:
  // A part that has left a meeting may send for the next one, while another still reads; it cannot be two ahead.
  OGC_HD int inbox_row() const { return (*meetings & 1u) != 0 ? count : 0; }
};

/// Sends what the part has counted of its own vertices. Runs once.
struct SendCounts {
  PartsView parts;
  const StepControl* control;

  OGC_HD void operator()(int) const {
    parts.send({.cut = control->cut, .moved = control->moved, .not_finite = control->not_finite});
  }
};

/// Adds what the other parts have counted. Runs once, at the end of a meeting.
struct TakeCounts {
  PartsView parts;
  StepControl* control;

  OGC_HD void operator()(int) const {
    for (int p = 0; p < parts.count; ++p) {
      if (p == parts.own) continue;
      const PartMessage& of = parts.received(p);
      control->cut += of.cut;
      control->moved |= of.moved;
      control->not_finite += of.not_finite;
    }
  }
};

/// Copies numbers of this part to the same place in all others, one word a thread: writes into another device's memory
/// are slow unless neighbouring threads write neighbouring words.
OGC_HD inline void send_word(const PartsView& parts, const Vec* from, Vec* PartArrays::*to, int word) {
  static_assert(sizeof(Vec) == 3 * sizeof(float));
  const float number = reinterpret_cast<const float*>(from)[word];
  for (int p = 0; p < parts.count; ++p)
    if (p != parts.own) reinterpret_cast<float*>(parts.arrays[p].*to)[word] = number;
}

/// Sends positions of the guess loop's round. Runs once for each coordinate of own vertices.
struct SendGuess {
  PartsView parts;
  int first;            ///< first own vertex
  int vertex_count;     ///< length of one half of `taken`
  const Vec* position;  ///< x by vertex [m]
  const Vec* taken;     ///< as in GuessVertex
  const StepControl* control;

  OGC_HD void operator()(int i) const {
    send_word(parts, position, &PartArrays::position, 3 * first + i);
    send_word(parts, taken, &PartArrays::taken, 3 * (control->rounds % 2 != 0 ? first : first + vertex_count) + i);
  }
};

/// Sends new positions of a colour into the fresh buffers of the parts that read them. No part reads fresh positions
/// of a colour before the meeting that ends it. Runs once for each own slot of the colour.
struct SendColour {
  PartsView parts;
  const std::uint64_t* readers;  ///< as in Readers
  const SweepVertex* vertices;   ///< by slot
  int first_slot;                ///< first own slot of the colour
  const PaddedVec* padded;       ///< as in StepState [m]
  int fresh;                     ///< where the fresh positions begin in `padded`
  const int* turn;               ///< as in SweepShared
  int iteration;

  OGC_HD void operator()(int i) const {
    if (turn != nullptr && *turn != iteration) return;
    const int slot = first_slot + i;
    const std::uint64_t to = readers[slot];
    if (to == 0) return;
    const int at = fresh + vertices[slot].vertex;
    const PaddedVec x = padded[at];
    for (int p = 0; p < parts.count; ++p)
      if ((to >> p & 1) != 0) parts.arrays[p].padded[at] = x;
  }
};

/// Sends the positions of own vertices in all buffers to all parts. What a part has of them already are the same bits.
/// Runs once for each coordinate of own vertices.
struct SendPositions {
  PartsView parts;
  int first, own_count;     ///< first own vertex; number of own vertices
  int vertex_count;         ///< length of one buffer of `padded`
  const Vec* position;      ///< as in StepState [m]
  const PaddedVec* padded;  ///< the same

  OGC_HD void operator()(int i) const {
    send_word(parts, position, &PartArrays::position, 3 * first + i);
    if (i >= 2 * own_count) return;
    const int at = first + (i < own_count ? i : i - own_count + vertex_count);
    const PaddedVec x = padded[at];
    for (int p = 0; p < parts.count; ++p)
      if (p != parts.own) parts.arrays[p].padded[at] = x;
  }
};

/// Takes over the forces that the other parts have measured. Runs once for each slot.
struct TakeForces {
  PartsView parts;
  const SweepVertex* vertices;  ///< by slot
  LeftForce* left;              ///< by slot

  OGC_HD void operator()(int slot) const {
    const int p = parts.part_of(vertices[slot].vertex);
    if (p != parts.own) left[slot] = parts.arrays[p].left[slot];
  }
};

/// Sends how many contacts the part has entered, and whether its lists were long enough. Runs once.
struct SendListCounts {
  PartsView parts;
  ListsView lists;

  OGC_HD void operator()(int) const {
    parts.send({.contacts = *lists.contact_count, .too_long = lists.fit() && *lists.overflow == 0 ? 0 : 1});
  }
};

/// Numbers the contacts to take over: those of part p are places[p] … places[p + 1] − 1. If a list of any part was too
/// small, every part repeats the step: the flag is set, and contact_count is at least the number that is needed. Runs
/// once, at the end of a meeting.
struct TakeListCounts {
  PartsView parts;
  ListsView lists;
  int* places;  ///< parts + 1 entries, on the backend, written

  OGC_HD void operator()(int) const {
    bool is_too_long = !lists.fit();
    int total = 0;
    places[0] = 0;
    for (int p = 0; p < parts.count; ++p) {
      if (p != parts.own) {
        const PartMessage& of = parts.received(p);
        total += of.contacts;
        is_too_long = is_too_long || of.too_long != 0;
      }
      places[p + 1] = total;
    }
    if (!is_too_long) return;
    if (*lists.overflow == 0) *lists.contact_count += total;
    *lists.overflow = 1;
    places[parts.count] = 0;
  }
};

/// Writes the contacts of the part's own searches where the others read them. Runs once for each.
struct ShowContacts {
  ListsView lists;
  RawContact* found;  ///< lists.capacity entries, written

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    const EnteredContact& from = lists.entered[i];
    RawContact contact{from.bucket, from.second, -1, -1};
    if (from.slot != EnteredContact::nowhere) {
      const std::uint64_t edges = ~lists.table[from.slot].edges;
      contact.low = static_cast<int>(edges >> 32), contact.high = static_cast<int>(edges & 0xffffffffU);
    }
    found[i] = contact;
  }
};

/// Forgets which contacts the other parts read: only those stay that read a vertex's elements. Runs once for each slot.
struct ForgetReaders {
  const std::uint64_t* of_elements;  ///< by slot: as in Readers, of the elements alone
  std::uint64_t* readers;            ///< as in Readers

  OGC_HD void operator()(int slot) const { readers[slot] = of_elements[slot]; }
};

/// Enters the contacts of the other parts. Runs once for each.
struct TakeContacts {
  PartsView parts;
  ListsView lists;
  ContactFaces faces;
  const int* places;  ///< as in TakeListCounts

  OGC_HD void operator()(int i) const {
    if (*lists.overflow != 0) return;
    int p = 0;
    while (i >= places[p + 1]) ++p;
    lists.enter(parts.arrays[p].found[i - places[p]], faces);
  }
};

/// Takes over smallest distances of primitives of own vertices that are smaller than the part's own. Runs once for each
/// index below count().
struct TakeDistances {
  PartsView parts;
  SurfaceView surface;
  int first, end;  ///< own vertices
  const int* overflow;

  OGC_HD int count() const {
    const int most = surface.vertex_count > surface.edge_count ? surface.vertex_count : surface.edge_count;
    return most > surface.triangle_count ? most : surface.triangle_count;
  }
  OGC_HD void operator()(int i) const {
    if (*overflow != 0) return;
    if (i < surface.vertex_count && is_own(i)) take(&PartArrays::d_min_vertex, i);
    if (i < surface.edge_count) {
      const EdgeEnds e = surface.edges[i];
      if (is_own(e.a) || is_own(e.b)) take(&PartArrays::d_min_edge, i);
    }
    if (i < surface.triangle_count) {
      const int* corner = surface.facets[i].corner;
      if (is_own(corner[0]) || is_own(corner[1]) || is_own(corner[2])) take(&PartArrays::d_min_triangle, i);
    }
  }

 private:
  OGC_HD bool is_own(int v) const { return first <= v && v < end; }
  // The other part may lower its number at the same time: to the number of a third part, which this part reads too.
  OGC_HD void take(float* PartArrays::*distances, int i) const {
    for (int p = 0; p < parts.count; ++p)
      if (p != parts.own) lower(parts.arrays[parts.own].*distances + i, atomic_load(parts.arrays[p].*distances + i));
  }
};

/// Computes the bound of an own vertex, and sends it to the other parts. Runs once for each own vertex.
struct SendBound {
  PartsView parts;
  ConservativeBound bounds;
  int first;  ///< first own vertex

  OGC_HD void operator()(int i) const {
    const int v = first + i;
    bounds(v);
    for (int p = 0; p < parts.count; ++p)
      if (p != parts.own) parts.arrays[p].bound[v] = bounds.bound[v];
  }
};

/// Sets the flag if a list of any part was too small. Runs once, at the end of a meeting.
struct TakeOverflow {
  PartsView parts;
  ListsView lists;

  OGC_HD void operator()(int) const {
    for (int p = 0; p < parts.count; ++p)
      if (p != parts.own && parts.received(p).too_long != 0) *lists.overflow = 1;
  }
};

}  // namespace ogc::fast
