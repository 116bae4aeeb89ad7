// What an update of Algorithm 4 reads and writes: the streams of all kinds of elements, in the order of the sweep, and
// positions.
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

/// What a scene asks of the sum over the stencils of a vertex, one bit each: elements of these kinds, volumes, other
/// models of bending or damping than the usual ones (discrete hinges, damping of strains), another activation than
/// `ogc`.
inline constexpr unsigned asks_triangles = 1, asks_hinges = 2, asks_springs = 4, asks_tetrahedra = 8,
                          asks_segments = 16, asks_volumes = 32, asks_any_model = 64, asks_any_activation = 128;

/// A free vertex in the order of the sweep, with its rows in the streams.
struct alignas(16) SweepVertex {
  int vertex = -1;  ///< number in the mesh
  int body = -1;
  float inertia = 0;                           ///< m/h² [N/m]
  int membrane_begin = 0, membrane_count = 0;  ///< its row: first place in SweepView::membrane, and how many
  int hinge_begin = 0, hinge_count = 0;        ///< likewise in SweepView::hinges
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

struct MembraneIncidence;
struct HingeIncidence;
struct IsometricStencil;
struct SpringIncidence;
struct SpringRow;
struct TetrahedronIncidence;
struct TetrahedronRow;
struct TetrahedronGradients;
struct SolidMaterial;
struct VolumeIncidence;
struct RodRow;
struct RodIncidence;
struct SegmentSlot;

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

/// What the sweep reads and writes of rods (fast/kernels/rods/); null where there is none.
struct RodStream {
  const RodRow* rows = nullptr;              ///< by slot of the vertices
  const RodIncidence* incidences = nullptr;  ///< row by row
  const SegmentSlot* slots = nullptr;        ///< by slot of the segments
  const float* damping = nullptr;            ///< by body: k_d/h [1]; null where none damps
  const Vec* direction = nullptr;            ///< by segment: c, as rod_rest_direction; null where none damps strains
  const Quat* orientation_start = nullptr;   ///< by segment: qᵗ
  Quat* orientation = nullptr;               ///< by segment: q
  bool is_damped_by_vertex = false;          ///< DampingForm::per_vertex
  bool as_published = false;                 ///< μ = σ + ‖b‖ in place of the root
};

/// The vertex of an encoded index. No branch: a processor cannot predict which buffer is read.
OGC_HD inline int decoded(int index) { return index ^ (index >> 31); }

/// Everything that an update reads and writes. Plain pointers, valid for one launch sequence.
struct SweepView {
  const SweepVertex* vertices = nullptr;        ///< by slot
  const MembraneIncidence* membrane = nullptr;  ///< row by row, in the order of slots
  const HingeIncidence* hinges = nullptr;       ///< likewise
  const ContactRow* contact_rows = nullptr;     ///< by slot
  const ContactIncidence* contacts = nullptr;   ///< row by row, as contact_rows says
  const SurfaceMaterial* materials = nullptr;   ///< by body
  const Symmetric2* strain_start = nullptr;     ///< Gᵗ by triangle
  const float* angle_start = nullptr;           ///< θᵗ by hinge
  PaddedVecs start;                             ///< xᵗ
  const Vec* target = nullptr;                  ///< y
  FeasibleRegions regions;                      ///< about X_prev; every new position is truncated to them
  PaddedVec* old = nullptr;                     ///< x before the iteration
  int to_fresh = 0;                             ///< from a vertex there to the same one in the fresh buffer
  Vec* position = nullptr;                      ///< as fresh, for all but the sweep, which does not read it
  StepControl* control = nullptr;               ///< on the backend: cut vertices and such as are not finite are counted
  const int* turn = nullptr;                    ///< the iteration whose turn it is, on the device; null: this one's
  int iteration = 0;                            ///< number of this one; nothing is written where it is not its turn
  float contact_radius = 0;                     ///< r [m]
  float friction_limit = 0;                     ///< ε_v h [m]
  const SurfaceModels* models = nullptr;        ///< by body
  const IsometricStencil* isometric = nullptr;  ///< beside `hinges`; null where no body has the model
  const SpringRow* spring_rows = nullptr;       ///< by slot; null where there is no spring
  const SpringIncidence* springs = nullptr;     ///< row by row, as spring_rows says
  /// of all contacts; read by sums that give any activation
  ContactActivation activation = ContactActivation::ogc;
  // Read where there are tetrahedra.
  const TetrahedronRow* tetrahedron_rows = nullptr;  ///< by slot
  const TetrahedronIncidence* tetrahedra = nullptr;  ///< row by row, as tetrahedron_rows says
  const TetrahedronGradients* gradients = nullptr;   ///< beside `tetrahedra`; null where no body damps
  const SolidMaterial* solids = nullptr;             ///< by body
  const Symmetric3* solid_start = nullptr;           ///< Gᵗ by tetrahedron
  VolumeStream volumes;                              ///< read where there are volumes
  RodStream rods;                                    ///< read where there are rods

  /// Whether it is another iteration's turn.
  OGC_HD bool is_off() const { return turn != nullptr && *turn != iteration; }
  /// The same for the team of a vertex that has been read: without a branch between the two reads a device makes both
  /// at once.
  OGC_HD bool is_off(const SweepVertex& vertex) const {
    return turn != nullptr && ((*turn != iteration) | (vertex.vertex < 0));
  }

  /// Where an encoded index is read.
  OGC_HD int number(int index) const { return decoded(index) + ((index >> 31) & to_fresh); }
  /// The position there.
  OGC_HD Vec read(int index) const { return PaddedVecs{old}[number(index)]; }
  /// A new position.
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
