// What an update of Algorithm 4 reads and writes beside the elements of a kind, and the form of a kind's stream.
// kinds/kinds.hpp joins both to the SweepView that kernels get.
//
// Gauss–Seidel over colours with two position buffers an iteration (method.md §7.2): a neighbour of lower colour is
// read from the fresh buffer, any other from the old one. Which of the two is known when the streams are made, so it
// stands in the index: n ≥ 0 reads old[n], n < 0 reads fresh[~n]. Prescribed and fixed vertices count as colour −1.
// Both buffers are halves of one array, so that the choice is arithmetic and no read of a pointer.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/quaternion.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/models/material.hpp"
#include "fast/kernels/models/membrane.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// What a scene asks of the sum over the stencils of a vertex, one bit each: volumes, other models of bending or
/// damping than the usual ones (discrete hinges, damping of strains), another activation than `ogc`. The bits of the
/// kinds of elements follow these, in the order of their list (kinds/kinds.hpp).
inline constexpr unsigned asks_volumes = 1, asks_any_model = 2, asks_any_activation = 4, first_kind_bit = 8;

/// The elements of a vertex in the stream of a kind.
struct Row {
  int begin = 0, count = 0;  ///< first place among the incidences, and how many
};

/// Stands for data that a kind of elements does not have.
struct NoData {};

/// Parts of a stream. One that a kind does not have takes no room: every launch copies its view.
template <bool has_rows>
struct RowsOfStream {
  const Row* rows = nullptr;  ///< by slot; null: the scene has no such element
};
template <>
struct RowsOfStream<false> {};
template <class Beside>
struct BesideOfStream {
  const Beside* beside = nullptr;  ///< by incidence; null where no model of the scene reads it
};
template <>
struct BesideOfStream<NoData> {};
template <class Start>
struct StartOfStream {
  const Start* start = nullptr;  ///< by element; read where it is damped
};
template <>
struct StartOfStream<NoData> {};
template <class ByBody>
struct ByBodyOfStream {
  const ByBody* by_body = nullptr;  ///< by body; null where no element reads it
};
template <>
struct ByBodyOfStream<NoData> {};

/// The stream of a kind: what each free vertex of an element sees of it, row by row in the order of slots. `Beside`:
/// what some models read of an incidence besides. `Start`: of an element when the step starts, for damping. `ByBody`:
/// constants of a body that no other kind reads. `has_rows`: the rows are an array, and not in SweepVertex.
template <class Incidence, class Beside, class Start, class ByBody, bool has_rows>
struct StreamView : RowsOfStream<has_rows>, BesideOfStream<Beside>, StartOfStream<Start>, ByBodyOfStream<ByBody> {
  const Incidence* incidences = nullptr;  ///< row by row
};

/// Says as what index the update of a vertex reads another one.
struct ColourOrder {
  const int* colour;  ///< by vertex; −1: not free
  int own;            ///< colour of the vertex that is updated

  /// The vertex, encoded.
  int operator()(int vertex) const { return colour[vertex] < own ? ~vertex : vertex; }
};

/// A free vertex in the order of the sweep, with its rows in the streams.
struct alignas(16) SweepVertex {
  int vertex = -1;  ///< number in the mesh
  int body = -1;
  float inertia = 0;  ///< m/h² [N/m]
  Row rows[2];        ///< its rows of the kinds that have their place here (`row_in_vertex`)
};

/// A contact seen from one of its vertices: slots as in contact_force.hpp; `own` is the slot of the vertex itself. The
/// stiffness holds e_k of the detection.
struct alignas(16) ContactIncidence {
  int index[4] = {0, 0, 0, 0};                  ///< by slot, encoded
  float stiffness = 0, friction = 0;            ///< e_k k_c [N/m], μ [1]
  ContactKind kind = ContactKind::point_point;  ///< says which slots it has
  std::uint8_t own = 0;                         ///< 0 … 3
  std::uint8_t together = 0;  ///< bit k: the vertex of slot k, another one than the own, has its colour
};

/// The contacts of a vertex in the stream: the vertex–facet ones, then the edge–edge ones.
struct alignas(16) ContactRow {
  /// first place in SweepView::contacts; how many of vertex–facet; how many in all
  int begin = 0, vertex_facet = 0, count = 0;
};

struct VolumeIncidence;

/// The contacts of all slots with volumes: rows of fixed length (fast/kernels/volumes/). Behind those of the slots are
/// rows of prescribed vertices.
struct VolumeStream {
  const VolumeIncidence* contacts = nullptr;  ///< row of a slot, as the point: from slot · capacity
  const int* counts = nullptr;                ///< by slot: how many of its row there are
  int capacity = 0;                           ///< of a row
  // Where volumes are free; else null.
  const int* colour = nullptr;  ///< by vertex; −1: not free
  /// row of a slot, as a corner, from slot · corner_capacity, ascending: (place in `contacts`) · 4 + role
  const int* corner_codes = nullptr;
  const int* corner_counts = nullptr;  ///< by slot: how many of that row there are
  int corner_capacity = 0;             ///< of such a row
};

/// The vertex of an encoded index. No branch: a processor cannot predict which buffer is read.
OGC_HD inline int decoded(int index) { return index ^ (index >> 31); }

/// What updates read and write whatever elements a scene has. Plain pointers, valid for one launch sequence.
struct SweepShared {
  const SweepVertex* vertices = nullptr;       ///< by slot
  const ContactRow* contact_rows = nullptr;    ///< by slot
  const ContactIncidence* contacts = nullptr;  ///< row by row, as contact_rows says
  const SurfaceMaterial* materials = nullptr;  ///< by body
  const SurfaceModels* models = nullptr;       ///< by body
  PaddedVecs start;                            ///< xᵗ
  const Vec* target = nullptr;                 ///< y
  FeasibleRegions regions;                     ///< about X_prev; every new position is truncated to them
  PaddedVec* old = nullptr;                    ///< x before the iteration
  int to_fresh = 0;                            ///< from a vertex there to the same one in the fresh buffer
  Vec* position = nullptr;                     ///< as fresh, for all but the sweep, which does not read it
  StepControl* control = nullptr;              ///< on the backend: counts cut vertices and positions not finite
  const int* turn = nullptr;                   ///< the iteration whose turn it is, on the device; null: this one's
  int iteration = 0;                           ///< number of this one; it writes nothing where it is not its turn
  float contact_radius = 0;                    ///< r [m]
  float friction_limit = 0;                    ///< ε_v h [m]
  /// of all contacts; read by sums that give any activation
  ContactActivation activation = ContactActivation::ogc;
  VolumeStream volumes;  ///< read where there are volumes

  /// Whether it is another iteration's turn.
  OGC_HD bool is_off() const { return turn != nullptr && *turn != iteration; }
  /// The same for the team of a vertex that has been read: without a branch between the two reads a device makes both
  /// at once.
  OGC_HD bool is_off(const SweepVertex& vertex) const {
    return turn != nullptr && ((*turn != iteration) | (vertex.vertex < 0));
  }

  /// Returns the place at which an encoded index is read.
  OGC_HD int number(int index) const { return decoded(index) + ((index >> 31) & to_fresh); }
  /// Returns the position at an encoded index.
  OGC_HD Vec read(int index) const { return PaddedVecs{old}[number(index)]; }
  /// Writes the new position of a vertex.
  OGC_HD void write(int v, const Vec& x) const {
    old[v + to_fresh] = PaddedVec(x);
    position[v] = x;
  }
};

/// A vertex that is solved: where it is, and how far it has moved since the start of the step, for damping by vertex.
struct OwnVertex {
  Vec position, moved;  ///< x, and x − xᵗ [m]
};

/// What a step leaves of the force on a free vertex (Eq. 29). Forces in newtons.
struct alignas(16) LeftForce {
  float reference = 0;  ///< ‖f*‖, after the guess loop
  float left = 0;       ///< ‖f‖ at the end
  float rounding = 0;   ///< how much of it may come from positions that are rounded
  int is_held = 0;      ///< 1: its next update would leave its region, so that its force stays
};

}  // namespace ogc::fast
