// Defines the data that updates of Algorithm 4 read and write, and the stream that each kind of element has.
// kinds/kinds.hpp combines these into the SweepView of the kernels.
//
// Updates are Gauss–Seidel over colours. Each iteration has two position buffers, the old and the fresh one (method.md
// §7.2). A neighbour of lower colour is read from the fresh buffer, any other from the old one. This choice is known
// when the streams are made, so the stored index encodes it: n ≥ 0 reads old[n], n < 0 reads fresh[~n]. Prescribed and
// fixed vertices have colour −1. Both buffers are halves of one array, so the choice is arithmetic and loads no
// pointer.
#pragma once

#include <cmath>
#include <cstdint>

#include "fast/kernels/arithmetic/quaternion.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/models/material.hpp"
#include "fast/kernels/models/membrane.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// Bits of the features that a scene may need of the sum over a vertex's stencils. `asks_any_stretch`: damping
/// other than that of strains. `asks_any_bending`: such damping of hinges, or bending other than that of discrete
/// hinges. `asks_any_activation`: an activation other than `ogc`. The kinds of elements have the bits from
/// `first_kind_bit` on, in the order of kinds/kinds.hpp.
inline constexpr unsigned asks_volumes = 1, asks_any_stretch = 2, asks_any_bending = 4, asks_any_activation = 8,
                          first_kind_bit = 16;
/// The bits of all models; a part that no model concerns gives all of them.
inline constexpr unsigned asks_any_model = asks_any_stretch | asks_any_bending;

/// The incidences of a vertex in the stream of a kind of element.
struct Row {
  int begin = 0, count = 0;  ///< index of the first incidence in the stream; number of incidences
};

/// Replaces data that a kind of element does not have.
struct NoData {};

/// Members of a stream. A stream has no member that its kind does not need, because every launch copies the SweepView.
template <bool has_rows>
struct RowsOfStream {
  const Row* rows = nullptr;  ///< by slot; null: the scene has no element of this kind
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
  const Start* start = nullptr;  ///< by element; read only if the element is damped
};
template <>
struct StartOfStream<NoData> {};
template <class ByBody>
struct ByBodyOfStream {
  const ByBody* by_body = nullptr;  ///< by body; null if no element reads it
};
template <>
struct ByBodyOfStream<NoData> {};

/// The stream of a kind of element: for each free vertex a row with its incidences, in the order of slots. `Beside`:
/// more data of an incidence, which only some models read. `Start`: data of an element at the start of the step, for
/// damping. `ByBody`: constants of a body that only this kind reads. `has_rows`: rows are a separate array, not part of
/// SweepVertex.
template <class Incidence, class Beside, class Start, class ByBody, bool has_rows>
struct StreamView : RowsOfStream<has_rows>, BesideOfStream<Beside>, StartOfStream<Start>, ByBodyOfStream<ByBody> {
  const Incidence* incidences = nullptr;  ///< row by row
};

/// Encodes the indices of the vertices that the update of one vertex reads (see the head of this file).
struct ColourOrder {
  const int* colour;  ///< by vertex; −1: not free
  int own;            ///< colour of the vertex that is updated

  /// Returns the encoded index of a vertex.
  int operator()(int vertex) const { return colour[vertex] < own ? ~vertex : vertex; }
};

/// A free vertex in the order of the sweep, with its rows in the streams of some kinds.
struct alignas(16) SweepVertex {
  int vertex = -1;  ///< index in the mesh
  int body = -1;
  float inertia = 0;  ///< m/h² [N/m]
  Row rows[2];        ///< rows of the kinds with `row_in_vertex` ≥ 0
};

/// A contact as one of its vertices sees it. contact_force.hpp defines the order of its four vertices.
struct alignas(16) ContactIncidence {
  int index[4] = {0, 0, 0, 0};                  ///< the vertices, encoded
  float stiffness = 0, friction = 0;            ///< k_c [N/m], times e_k at the detection if the pair has one; μ [1]
  ContactKind kind = ContactKind::point_point;  ///< decides which of the four vertices the contact has
  std::uint8_t own = 0;                         ///< number of the vertex that sees the contact, 0 … 3
  std::uint8_t together = 0;                    ///< bit k: vertex k is not `own`, but has the same colour
};

/// The contacts of a vertex in SweepShared::contacts. For each kind, the rows of consecutive slots follow each other.
struct alignas(16) ContactRow {
  Row vertex_facet, edge_edge;
};

struct VolumeIncidence;

/// Holds the contacts with volumes in rows of fixed length, one for each slot (fast/kernels/volumes/). Rows of
/// prescribed vertices follow.
struct VolumeStream {
  /// contacts in which the vertex of a slot is the point; the row of a slot begins at slot · capacity
  const VolumeIncidence* contacts = nullptr;
  const int* counts = nullptr;  ///< by slot: number of contacts in its row
  int capacity = 0;             ///< contacts that fit in a row
  // The members below are null or 0 if all volumes are driven.
  const int* colour = nullptr;  ///< by vertex; −1: not free
  /// by slot, ascending: code of each contact in which the slot's vertex is a corner, (index in `contacts`) · 4 + role;
  /// the row of a slot begins at slot · corner_capacity
  const int* corner_codes = nullptr;
  const int* corner_counts = nullptr;  ///< by slot: number of codes in its row
  int corner_capacity = 0;             ///< codes that fit in a row
};

/// Returns the vertex of an encoded index. The formula avoids a branch, which a processor could not predict.
OGC_HD inline int decoded(int index) { return index ^ (index >> 31); }

/// Returns whether the points are farther than `most` apart along an axis [m]. The difference of two floats is rounded
/// to double at most once, so every right program decides alike.
OGC_HD inline bool moves_beyond(const Vec& from, const Vec& to, float most) {
  const double limit = most;
  return fabs(static_cast<double>(to.x) - from.x) > limit || fabs(static_cast<double>(to.y) - from.y) > limit ||
         fabs(static_cast<double>(to.z) - from.z) > limit;
}

/// Holds the data that updates read and write in every scene. The pointers are valid for one sequence of launches.
struct SweepShared {
  const SweepVertex* vertices = nullptr;     ///< by slot
  const ContactRow* contact_rows = nullptr;  ///< by slot
  const ContactIncidence* contacts = nullptr;  ///< all rows of vertex–facet contacts, then those of edge–edge contacts
  const SurfaceMaterial* materials = nullptr;  ///< by body
  const SurfaceModels* models = nullptr;       ///< by body
  PaddedVecs start;                            ///< xᵗ by vertex [m]
  const Vec* target = nullptr;                 ///< y by vertex [m]
  FeasibleRegions regions;                     ///< regions around X_prev; every new position is truncated to its region
  PaddedVec* old = nullptr;                    ///< x before the iteration, by vertex [m]
  int to_fresh = 0;                ///< index of a vertex in the fresh buffer minus its index in the old buffer
  Vec* position = nullptr;         ///< fresh positions by vertex [m], for other kernels; the sweep only writes them
  StepControl* control = nullptr;  ///< on the backend: counts cut vertices and positions that are not finite
  const int* turn = nullptr;       ///< number of the next iteration, on the device; null: this iteration is next
  int iteration = 0;               ///< number of this iteration; it does nothing if another one is next
  float contact_radius = 0;        ///< r [m]
  float friction_limit = 0;        ///< ε_v h [m]
  float settled_move = 0;          ///< moves up to this are not noted [m]; 0: none is
  /// activation of all contacts; read by sums with AnyActivation
  ContactActivation activation = ContactActivation::ogc;
  VolumeStream volumes;  ///< read if there are volumes

  /// Returns whether another iteration is next, so that this one must do nothing.
  OGC_HD bool is_off() const { return turn != nullptr && *turn != iteration; }
  /// Returns the same as is_off(). The test `vertex` < 0 is never true; it is joined without a branch, so that a device
  /// issues the loads of `turn` and `vertex` at once.
  OGC_HD bool is_off(const SweepVertex& vertex) const {
    return turn != nullptr && ((*turn != iteration) | (vertex.vertex < 0));
  }

  /// Returns the index into `old` for an encoded index; the result may lie in the fresh buffer.
  OGC_HD int number(int index) const { return decoded(index) + ((index >> 31) & to_fresh); }
  /// Returns the position at an encoded index.
  OGC_HD Vec read(int index) const { return PaddedVecs{old}[number(index)]; }
  /// Writes the new position of a vertex. With settled_move, notes that the vertex moved farther along an axis.
  OGC_HD void write(int v, const Vec& x) const {
    old[v + to_fresh] = PaddedVec(x);
    position[v] = x;
    if (settled_move > 0 && moves_beyond(PaddedVecs{old}[v], x, settled_move)) control->note_move();
  }
};

/// The vertex that is updated: its position, and its motion since the start of the step, for damping by vertex.
struct OwnVertex {
  Vec position, moved;  ///< x, and x − xᵗ [m]
};

/// Holds the force that a step leaves on a free vertex (Eq. 29) [N].
struct alignas(16) LeftForce {
  float reference = 0;  ///< ‖f*‖ after the guess loop
  float left = 0;       ///< ‖f‖ at the end of the step
  float rounding = 0;   ///< bound of the part of ‖f‖ that rounded positions cause
  int is_held = 0;      ///< 1: the next update would leave the vertex's region
};

}  // namespace ogc::fast
