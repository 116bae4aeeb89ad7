// What an update of Algorithm 4 reads and writes apart from elements, and the form of a kind's stream. kinds/kinds.hpp
// joins both to the SweepView of the kernels.
//
// Updates are Gauss–Seidel over colours, with two position buffers an iteration (method.md §7.2). A neighbour of lower
// colour is read from the fresh buffer, any other from the old one. This choice is known when the streams are made, so
// the index encodes it: n ≥ 0 reads old[n], n < 0 reads fresh[~n]. Prescribed and fixed vertices have colour −1. Both
// buffers are halves of one array, so the choice is arithmetic and loads no pointer.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/quaternion.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/models/material.hpp"
#include "fast/kernels/models/membrane.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// Features that a scene requires of the sum over a vertex's stencils, one bit each: elements of these kinds, and
/// volumes. asks_any_model: bending or damping other than discrete hinges and damping of strains. asks_any_activation:
/// an activation other than `ogc`.
inline constexpr unsigned asks_triangles = 1, asks_hinges = 2, asks_springs = 4, asks_tetrahedra = 8,
                          asks_segments = 16, asks_volumes = 32, asks_any_model = 64, asks_any_activation = 128;

/// The elements of a vertex in the stream of a kind.
struct Row {
  int begin = 0, count = 0;  ///< first place among the incidences; number of them
};

/// In place of data that a kind of elements does not have.
struct NoData {};

/// Parts of a stream. A part that a kind does not have takes no room, because every launch copies its view.
template <bool has_rows>
struct RowsOfStream {
  const Row* rows = nullptr;  ///< by slot; null: the scene has no such element
};
template <>
struct RowsOfStream<false> {};
template <class Beside>
struct BesideOfStream {
  const Beside* beside = nullptr;  ///< by incidence; null if no model of the scene reads it
};
template <>
struct BesideOfStream<NoData> {};
template <class Start>
struct StartOfStream {
  const Start* start = nullptr;  ///< by element; read if the element is damped
};
template <>
struct StartOfStream<NoData> {};
template <class ByBody>
struct ByBodyOfStream {
  const ByBody* by_body = nullptr;  ///< by body; null if no element reads it
};
template <>
struct ByBodyOfStream<NoData> {};

/// The stream of a kind: for each free vertex, its incidences of the kind's elements, row by row in the order of slots.
/// `Beside`: further data of an incidence, which only some models read. `Start`: data of an element at the start of the
/// step, for damping. `ByBody`: constants of a body that only this kind reads. `has_rows`: rows are an array, not part
/// of SweepVertex.
template <class Incidence, class Beside, class Start, class ByBody, bool has_rows>
struct StreamView : RowsOfStream<has_rows>, BesideOfStream<Beside>, StartOfStream<Start>, ByBodyOfStream<ByBody> {
  const Incidence* incidences = nullptr;  ///< row by row
};

/// Encodes the indices of the vertices that the update of one vertex reads.
struct ColourOrder {
  const int* colour;  ///< by vertex; −1: not free
  int own;            ///< colour of the vertex that is updated

  /// Returns the encoded index of a vertex.
  int operator()(int vertex) const { return colour[vertex] < own ? ~vertex : vertex; }
};

/// A free vertex in the order of the sweep, with its rows in the streams.
struct alignas(16) SweepVertex {
  int vertex = -1;  ///< number in the mesh
  int body = -1;
  float inertia = 0;  ///< m/h² [N/m]
  Row rows[2];        ///< its rows of the kinds with `row_in_vertex` ≥ 0
};

/// A contact as one of its vertices sees it. Slots are those of contact_force.hpp; `own` is the slot of the vertex
/// itself.
struct alignas(16) ContactIncidence {
  int index[4] = {0, 0, 0, 0};                  ///< by slot, encoded
  float stiffness = 0, friction = 0;            ///< e_k k_c [N/m] with e_k of the detection, μ [1]
  ContactKind kind = ContactKind::point_point;  ///< decides which slots the contact has
  std::uint8_t own = 0;                         ///< 0 … 3
  std::uint8_t together = 0;                    ///< bit k: the vertex of slot k is another one of the same colour
};

/// The contacts of a vertex in the stream: the vertex–facet ones, then the edge–edge ones.
struct alignas(16) ContactRow {
  /// first place in SweepView::contacts; number of vertex–facet contacts; number of all contacts
  int begin = 0, vertex_facet = 0, count = 0;
};

struct VolumeIncidence;

/// Holds the contacts of all slots with volumes, in rows of fixed length (fast/kernels/volumes/). Rows of prescribed
/// vertices follow the rows of the slots.
struct VolumeStream {
  const VolumeIncidence* contacts = nullptr;  ///< contacts of a slot's vertex as the point: from slot · capacity on
  const int* counts = nullptr;                ///< by slot: number of contacts in its row
  int capacity = 0;                           ///< of a row
  // Only if volumes are free; else null:
  const int* colour = nullptr;  ///< by vertex; −1: not free
  /// contacts of a slot's vertex as a corner, from slot · corner_capacity on, ascending: (place in `contacts`) · 4 +
  /// role
  const int* corner_codes = nullptr;
  const int* corner_counts = nullptr;  ///< by slot: number of codes in its row
  int corner_capacity = 0;             ///< of a row of codes
};

/// Returns the vertex of an encoded index. Avoids a branch, because a processor cannot predict which buffer is read.
OGC_HD inline int decoded(int index) { return index ^ (index >> 31); }

/// Holds what updates read and write in every scene. The pointers are valid for one launch sequence.
struct SweepShared {
  const SweepVertex* vertices = nullptr;       ///< by slot
  const ContactRow* contact_rows = nullptr;    ///< by slot
  const ContactIncidence* contacts = nullptr;  ///< row by row, see contact_rows
  const SurfaceMaterial* materials = nullptr;  ///< by body
  const SurfaceModels* models = nullptr;       ///< by body
  PaddedVecs start;                            ///< xᵗ
  const Vec* target = nullptr;                 ///< y
  FeasibleRegions regions;                     ///< about X_prev; every new position is truncated to them
  PaddedVec* old = nullptr;                    ///< x before the iteration
  int to_fresh = 0;                ///< offset of a vertex's position in the fresh buffer from that in the old one
  Vec* position = nullptr;         ///< fresh positions for all other kernels; the sweep only writes them
  StepControl* control = nullptr;  ///< on the backend: counts cut vertices and positions not finite
  const int* turn = nullptr;       ///< number of the iteration whose turn it is, on the device; null: always this one's
  int iteration = 0;               ///< number of this iteration, which does nothing if it is not its turn
  float contact_radius = 0;        ///< r [m]
  float friction_limit = 0;        ///< ε_v h [m]
  /// of all contacts; read by sums with AnyActivation
  ContactActivation activation = ContactActivation::ogc;
  VolumeStream volumes;  ///< read if there are volumes

  /// Returns whether it is another iteration's turn.
  OGC_HD bool is_off() const { return turn != nullptr && *turn != iteration; }
  /// Returns the same for the team of a vertex that was read. Without a branch between the two reads a device issues
  /// both at once.
  OGC_HD bool is_off(const SweepVertex& vertex) const {
    return turn != nullptr && ((*turn != iteration) | (vertex.vertex < 0));
  }

  /// Returns the place in `old` from which an encoded index is read.
  OGC_HD int number(int index) const { return decoded(index) + ((index >> 31) & to_fresh); }
  /// Returns the position at an encoded index.
  OGC_HD Vec read(int index) const { return PaddedVecs{old}[number(index)]; }
  /// Writes the new position of a vertex.
  OGC_HD void write(int v, const Vec& x) const {
    old[v + to_fresh] = PaddedVec(x);
    position[v] = x;
  }
};

/// The vertex that is solved: its position, and its motion since the start of the step for damping by vertex.
struct OwnVertex {
  Vec position, moved;  ///< x, and x − xᵗ [m]
};

/// Holds the force that a step leaves on a free vertex (Eq. 29) [N].
struct alignas(16) LeftForce {
  float reference = 0;  ///< ‖f*‖ after the guess loop
  float left = 0;       ///< ‖f‖ at the end
  float rounding = 0;   ///< largest part of ‖f‖ that rounded positions may cause
  int is_held = 0;      ///< 1: the next update would leave the vertex's region, so its force stays
};

}  // namespace ogc::fast
