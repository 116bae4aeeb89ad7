// Divides a simulation among several backends of one host, its parts. Each part holds the whole state and makes the
// same decisions; work is divided, not data:
//
//   searches   part p of n makes every n-th search, and decides the pairs that these note
//   contacts   every part takes over the others' contacts and has the records of all, but incidences of its own
//              vertices only, so that the records have the numbers that one part would give them
//   guess      a part moves its own vertices, and sends the positions to all others
//   sweep      the same, colour by colour
//
// The rest (trees, bounds, certificates, sums) every part does by itself, with the same bits. A part's own vertices are
// a range of numbers. Between two launches that need the others' results the parts meet (Backend::meet): each sends
// messages and positions into the memory of all others, then waits for theirs.
#pragma once

#include <cstdint>

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
  LeftForce* left = nullptr;                                                        ///< by slot
  float *d_min_vertex = nullptr, *d_min_edge = nullptr, *d_min_triangle = nullptr;  ///< of a detection [m]
  const RawContact* found = nullptr;  ///< contacts of the part's own searches
  PaddedVec* mail = nullptr;          ///< [meeting, even or odd][slot]: positions that the others send [m]
  PartMessage* inbox = nullptr;       ///< [meeting, even or odd][part that sends]
};

/// The parts as kernels see them. The pointers are on the backend.
struct PartsView {
  int own = 0, count = 1;                   ///< number of this part; number of parts
  const PartArrays* arrays = nullptr;       ///< by part
  const int* begin = nullptr;               ///< part p has the vertices begin[p] … begin[p + 1] − 1
  const std::uint32_t* meetings = nullptr;  ///< number of meetings so far
  int slots = 0;                            ///< number of free vertices

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
  /// Returns the first index in PartArrays::mail for positions sent before the meeting that follows, and for those
  /// sent before the last one.
  OGC_HD int mail_row() const { return (*meetings & 1u) != 0 ? slots : 0; }
  OGC_HD int taken_mail_row() const { return slots - mail_row(); }

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

/// Sends positions of the guess loop's round. Runs once for each own vertex.
struct SendGuess {
  PartsView parts;
  int first;            ///< first own vertex
  int vertex_count;     ///< length of one half of `taken`
  const Vec* position;  ///< x by vertex [m]
  const Vec* taken;     ///< as in GuessVertex
  const StepControl* control;

  OGC_HD void operator()(int i) const {
    const int v = first + i, to = control->rounds % 2 != 0 ? v : v + vertex_count;
    const Vec x = position[v], change = taken[to];
    for (int p = 0; p < parts.count; ++p) {
      if (p == parts.own) continue;
      parts.arrays[p].position[v] = x;
      parts.arrays[p].taken[to] = change;
    }
  }
};

/// Sends the new positions of a colour, slot by slot: writes into another device's memory are slow unless neighbouring
/// threads write neighbouring words. Runs once for each own slot of the colour.
struct SendColour {
  PartsView parts;
  const SweepVertex* vertices;  ///< by slot
  int first_slot;               ///< first own slot of the colour
  const PaddedVec* fresh;       ///< fresh positions by vertex [m]
  const int* turn;              ///< as in SweepShared
  int iteration;

  OGC_HD bool is_off() const { return turn != nullptr && *turn != iteration; }
  OGC_HD void operator()(int i) const {
    if (is_off()) return;
    const int slot = first_slot + i;
    const PaddedVec x = fresh[vertices[slot].vertex];
    for (int p = 0; p < parts.count; ++p)
      if (p != parts.own) parts.arrays[p].mail[parts.mail_row() + slot] = x;
  }
};

/// Takes over the positions of a colour that the other parts have sent, after the meeting. Runs once for each slot of
/// the colour that is not the part's own.
struct TakeColour {
  SendColour sent;
  int first, own_count;  ///< first slot of the colour; number of own slots
  PaddedVec* fresh;      ///< fresh positions by vertex, written [m]
  Vec* position;         ///< by vertex, written [m]

  OGC_HD void operator()(int i) const {
    if (sent.is_off()) return;
    const int slot = first + i < sent.first_slot ? first + i : first + i + own_count;
    const PaddedVec x = sent.parts.arrays[sent.parts.own].mail[sent.parts.taken_mail_row() + slot];
    const int v = sent.vertices[slot].vertex;
    fresh[v] = x;
    position[v] = x;
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

/// Takes over smallest distances that are smaller than the part's own. Runs once for each index below count().
struct TakeDistances {
  PartsView parts;
  int vertex_count, edge_count, triangle_count;
  const int* overflow;

  OGC_HD int count() const {
    const int most = vertex_count > edge_count ? vertex_count : edge_count;
    return most > triangle_count ? most : triangle_count;
  }
  OGC_HD void operator()(int i) const {
    if (*overflow != 0) return;
    const PartArrays& own = parts.arrays[parts.own];
    // The other part may lower its number at the same time: to the number of a third part, which this part reads too.
    for (int p = 0; p < parts.count; ++p) {
      if (p == parts.own) continue;
      const PartArrays& from = parts.arrays[p];
      if (i < vertex_count) lower(own.d_min_vertex + i, atomic_load(from.d_min_vertex + i));
      if (i < edge_count) lower(own.d_min_edge + i, atomic_load(from.d_min_edge + i));
      if (i < triangle_count) lower(own.d_min_triangle + i, atomic_load(from.d_min_triangle + i));
    }
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
