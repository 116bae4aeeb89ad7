// One vertex update of Algorithm 4: all energies of a vertex gathered from streams that hold, incidence by incidence,
// everything but positions, then a 3×3 solve, then truncation, then the write, and one reduction for all stencils.
//
// Gauss–Seidel over colours with two position buffers an iteration (method.md §7.2): a neighbour of lower colour is
// read from the fresh buffer, any other from the old one. Which of the two is known when the streams are made, so it
// stands in the index: n ≥ 0 reads old[n], n < 0 reads fresh[~n]. Prescribed and fixed vertices count as colour −1.
// Both buffers are halves of one array, so that the choice is arithmetic and no read of a pointer.
#pragma once

#include <cmath>
#include <cstdint>

#include "fast/kernels/arithmetic/quaternion.hpp"
#include "fast/kernels/arithmetic/solve3.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/friction_force.hpp"
#include "fast/kernels/inertia.hpp"
#include "fast/kernels/models/discrete_hinge.hpp"
#include "fast/kernels/models/membrane_models.hpp"
#include "fast/kernels/plane_lists.hpp"
#include "fast/kernels/team.hpp"
#include "fast/kernels/truncate.hpp"

namespace ogc::fast {

/// A free vertex in the order of the sweep, with its rows in the streams.
struct alignas(16) SweepVertex {
  int vertex = -1;  ///< number in the mesh
  int body = -1;
  float inertia = 0;                           ///< m/h² [N/m]
  int membrane_begin = 0, membrane_count = 0;  ///< its row: first place in SweepView::membrane, and how many
  int hinge_begin = 0, hinge_count = 0;        ///< likewise in SweepView::hinges
};

/// A triangle seen from one of its corners. `index`: the other two, in the triangle's order, encoded as said above.
struct alignas(16) MembraneIncidence {
  int index[2] = {0, 0};      ///< x_b, x_c
  int triangle = -1;          ///< number in RestState::triangles
  MembraneStencil stencil{};  ///< gradients and area
};

/// A hinge seen from one of its vertices. At an end of the edge `index` is the other end, o0, o1 (with the own vertex
/// as x0); at an opposite vertex it is x0, x1, o1 (with the own vertex as o0).
struct alignas(8) HingeIncidence {
  int index[3] = {0, 0, 0};  ///< encoded
  int hinge = -1;            ///< number in RestState::hinges; ~number at an opposite vertex
  HingeStencil stencil{};    ///< c and θ₀
};

/// A contact seen from one of its vertices: slots as in contact_force.hpp; `own` is the slot of the vertex itself. The
/// stiffness holds e_k of the detection.
struct alignas(16) ContactIncidence {
  int index[4] = {0, 0, 0, 0};                  ///< by slot, encoded
  float stiffness = 0, friction = 0;            ///< e_k k_c [N/m], μ [1]
  ContactKind kind = ContactKind::point_point;  ///< says which slots it has
  std::uint8_t own = 0;                         ///< 0 … 3
  std::uint8_t together = 0;  ///< bit k: the vertex of slot k, another one than the own, has its colour
  int pair = 0;               ///< place in SweepView::frozen, where there is that
};

/// What is computed once an iteration of a pair, where contacts' weights are (method.md §7.2).
struct alignas(16) FrozenContact {
  float weight[4] = {};  ///< w by slot [1], at the positions before the iteration
  Vec start;             ///< Σ w xᵗ [m]
};

/// The contacts of a vertex in the stream: the vertex–facet ones, then the edge–edge ones.
struct alignas(16) ContactRow {
  /// first place in SweepView::contacts; how many of vertex–facet; how many in all
  int begin = 0, vertex_facet = 0, count = 0;
};

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
  // Read by GatherEveryModel alone (sweep_models.hpp).
  const IsometricStencil* isometric = nullptr;  ///< beside `hinges`; null where no body has the model
  const SpringRow* spring_rows = nullptr;       ///< by slot; null where there is no spring
  const SpringIncidence* springs = nullptr;     ///< row by row, as spring_rows says
  /// of all contacts; GatherEveryModel has the others than `ogc`
  ContactActivation activation = ContactActivation::ogc;
  // Read where there are tetrahedra (sweep_solids.hpp).
  const TetrahedronRow* tetrahedron_rows = nullptr;  ///< by slot
  const TetrahedronIncidence* tetrahedra = nullptr;  ///< row by row, as tetrahedron_rows says
  const TetrahedronGradients* gradients = nullptr;   ///< beside `tetrahedra`; null where no body damps
  const SolidMaterial* solids = nullptr;             ///< by body
  const Symmetric3* solid_start = nullptr;           ///< Gᵗ by tetrahedron
  VolumeStream volumes;                              ///< read where there are volumes
  /// by pair; read by sums with WeightsOfIteration alone
  const FrozenContact* frozen = nullptr;
  RodStream rods;  ///< read where there are rods

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

// What a stencil reads beside its incidence, all at once: the latency of reads, not arithmetic, is what a vertex costs
// on a device.

/// Of a triangle: the other corners, and Gᵗ where it is damped.
struct MembraneReads {
  Vec b, c;                   ///< positions [m]
  Symmetric2 strain_start{};  ///< Gᵗ; 0 without damping
};

/// What a triangle reads.
OGC_HD inline MembraneReads read_membrane(const SweepView& view, const MembraneIncidence& incidence,
                                          const SurfaceMaterial& material) {
  MembraneReads reads{view.read(incidence.index[0]), view.read(incidence.index[1])};
  if (material.membrane_damping > 0) reads.strain_start = view.strain_start[incidence.triangle];
  return reads;
}

/// Adds a triangle whose strain is damped.
OGC_HD inline void add_membrane_incidence(const MembraneIncidence& incidence, const MembraneReads& reads,
                                          const SurfaceMaterial& material, compare::MembraneModel model, const Vec& own,
                                          ForceAndBlock& sum) {
  const Vec to_b = reads.b - own, to_c = reads.c - own;
  with_membrane(model, AddDampedMembrane<float>{incidence.stencil, material, to_b, to_c, reads.strain_start, sum});
}

/// A hinge as the vertex at `own` sees it, with θᵗ where it is damped.
OGC_HD inline HingeSeen read_hinge(const SweepView& view, const HingeIncidence& incidence,
                                   const SurfaceMaterial& material, const Vec& own) {
  HingeSeen hinge{.stencil = incidence.stencil,
                  .isometric = {},
                  .opposite = incidence.hinge < 0,
                  .own = own,
                  .p = {view.read(incidence.index[0]), view.read(incidence.index[1]), view.read(incidence.index[2])},
                  .angle_start = 0};
  if (material.bending_damping > 0) hinge.angle_start = view.angle_start[decoded(incidence.hinge)];
  return hinge;
}

/// Positions now and, with friction, at the start of the step.
struct ContactReads {
  Vec x[4], start[4];  ///< by slot [m]; start: xᵗ, 0 without friction
};

/// What a contact reads.
OGC_HD inline ContactReads read_contact(const SweepView& view, const ContactIncidence& incidence) {
  ContactReads reads;
  for (int k = 0; k < 4; ++k) reads.x[k] = view.read(incidence.index[k]);
  if (incidence.friction > 0) {
    for (int k = 0; k < 4; ++k) reads.start[k] = view.start[decoded(incidence.index[k])];
  }
  return reads;
}

/// A contact at the positions that an update reads.
struct ContactAt {
  ContactWeights weights;  ///< w by slot
  ContactShape shape;      ///< normal and distance
  float weight = 0;        ///< of the vertex itself
  float majorant = 0;      ///< |w| Σ |w_u| over the vertices u of its colour, itself included; w² mostly

  /// Whether the vertex feels it, if only by its block: the points have not met.
  OGC_HD bool acts() const { return shape.distance > 0 && weight != 0; }
};

/// The contact with these weights, and Σ w x.
OGC_HD inline ContactAt contact_with(const ContactIncidence& incidence, const ContactWeights& weights,
                                     const Vec& separation, float contact_radius) {
  const float own = weights.of(incidence.own);
  float together = fabsf(own);
  for (int k = 0; k < 4; ++k) together += (incidence.together >> k & 1) != 0 ? fabsf(weights.slot[k]) : 0.0f;
  return {weights, contact_shape(separation, contact_radius), own, fabsf(own) * together};
}

/// The contact where its vertices are now.
template <PairKind pairs = PairKind::any>
OGC_HD ContactAt contact_at(const ContactIncidence& incidence, const ContactReads& reads, float contact_radius) {
  const ContactWeights weights = contact_weights<pairs>(incidence.kind, reads.x);
  return contact_with(incidence, weights, weighted_sum(weights, reads.x), contact_radius);
}

/// The friction of a contact that acts with the normal force λ.
OGC_HD inline void add_contact_friction(const ContactIncidence& incidence, const ContactReads& reads,
                                        const ContactAt& at, float normal_force, float limit, ForceAndBlock& sum) {
  if (!(incidence.friction > 0)) return;
  Vec moved[4];
  for (int k = 0; k < 4; ++k) moved[k] = reads.x[k] - reads.start[k];
  const float* w = at.weights.slot;
  const Vec relative = w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2] + w[3] * moved[3];
  add_friction(at.shape.normal, relative, at.weight, at.majorant, incidence.friction, normal_force, limit, sum);
}

/// Force and block of a contact on one vertex, friction included.
template <PairKind pairs, class Activation>
OGC_HD ForceAndBlock contact_term(const SweepView& view, const Activation& activation,
                                  const ContactIncidence& incidence, const ContactReads& reads) {
  ForceAndBlock term;
  const ContactAt at = contact_at<pairs>(incidence, reads, view.contact_radius);
  if (!at.acts()) return term;
  const float normal_force = add_contact(activation, at.shape, at.weight, at.majorant, view.contact_radius,
                                         incidence.stiffness, term);
  add_contact_friction(incidence, reads, at, normal_force, view.friction_limit, term);
  return term;
}

/// Contacts whose weights are computed where each update reads positions.
struct WeightsOfUpdate {
  template <PairKind pairs, class Activation>
  OGC_HD static ForceAndBlock term(const SweepView& view, const Activation& activation,
                                   const ContactIncidence& incidence) {
    return contact_term<pairs>(view, activation, incidence, read_contact(view, incidence));
  }
};

/// Both kinds of contacts of a vertex, each as a part of its sum. A vertex may have fifty and its neighbours none, so
/// teams share the work. `Activation`: a functor of models/activation.hpp. `Weights`: WeightsOfUpdate or
/// WeightsOfIteration.
template <class Activation, class Weights>
struct ContactParts {
  const SweepView& view;
  ContactRow row;  ///< contacts of the vertex
  Activation activation;

  /// The first row.vertex_facet of them, and the rest.
  OGC_HD auto vertex_facet() const { return range<PairKind::vertex_facet>(row.begin, row.vertex_facet); }
  OGC_HD auto edge_edge() const {
    return range<PairKind::edge_edge>(row.begin + row.vertex_facet, row.count - row.vertex_facet);
  }

 private:
  template <PairKind pairs>
  OGC_HD auto range(int begin, int count) const {
    return pooled_part(
        begin, count, [contacts = view.contacts](int i) { return contacts[i]; },
        [seen = &view, activation = activation](const ContactIncidence& contact) {
          return Weights::template term<pairs>(*seen, activation, contact);
        });
  }
};

/// Brings the rows of a vertex near, which its sum is going to read.
template <class Team>
OGC_HD void prefetch_rows(const SweepView& view, const SweepVertex& vertex, const ContactRow& contacts,
                          const Team& team) {
  team.prefetch(view.membrane + vertex.membrane_begin,
                vertex.membrane_count * static_cast<int>(sizeof(MembraneIncidence)));
  team.prefetch(view.hinges + vertex.hinge_begin, vertex.hinge_count * static_cast<int>(sizeof(HingeIncidence)));
  team.prefetch(view.contacts + contacts.begin, contacts.count * static_cast<int>(sizeof(ContactIncidence)));
}

/// The sum over all stencils of one vertex, inertia left out, of scenes with default models alone (any membrane,
/// discrete hinges, activation `ogc`, damping of strains, no springs), in four parts: triangles, hinges, vertex–facet
/// contacts, edge–edge contacts.
template <class Weights>
struct GatherSurfaces {
  static constexpr int parts = 4;  ///< parts of the sum: warps of a block where teams are spread (fast/cuda/team.cuh)

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const ContactParts<OgcActivation, Weights> contacts{view, view.contact_rows[slot], {}};
    const SurfaceMaterial material = view.materials[vertex.body];
    const compare::MembraneModel model = view.models[vertex.body].membrane;
    prefetch_rows(view, vertex, contacts.row, team);
    return team.template sum<ForceAndBlock>(
        part(
            vertex.membrane_count, [&](int k) { return view.membrane[vertex.membrane_begin + k]; },
            [&](const MembraneIncidence& membrane, ForceAndBlock& sum) {
              add_membrane_incidence(membrane, read_membrane(view, membrane, material), material, model, own, sum);
            }),
        part(
            vertex.hinge_count, [&](int k) { return view.hinges[vertex.hinge_begin + k]; },
            [&](const HingeIncidence& hinge, ForceAndBlock& sum) {
              DiscreteHinge::add(read_hinge(view, hinge, material, own), material.bending_damping, sum);
            }),
        contacts.vertex_facet(), contacts.edge_edge());
  }
};

/// As the paper has it.
using GatherDefault = GatherSurfaces<WeightsOfUpdate>;

/// The leader writes a position of the vertex's region, counts where the proposal was changed, and gets it; others get
/// `stay`. One that is not finite is not written: the vertex stays and the step fails. All threads that hold the team's
/// total call it together.
template <class Metric, class Team>
OGC_HD Vec write_held(const SweepView& view, int v, const Vec& proposal, const Vec& stay, const FeasibleRegion& region,
                      const Metric& metric, const Team& team) {
  const bool may_be_written = is_finite(proposal);
  const Truncated kept = may_be_written ? held(region, stay, proposal, metric, team) : Truncated{stay, false};
  if (!team.leader()) return stay;
  view.write(v, kept.position);
  if (!may_be_written) view.control->count_not_finite();
  if (kept.cut) view.control->count_cut();
  return kept.position;
}

/// Whether what a vertex gathers may have contacts with volumes: then Gather::lies_deep tells who is deep inside one.
template <class Gather>
inline constexpr bool gathers_volumes = requires(const SweepView& view, const Vec& x) {
  Gather::lies_deep(view, 0, x);
};

/// for_each_team over the slots of one colour.
template <class Gather>
struct UpdateVertex {
  static constexpr int parts = Gather::parts;  ///< of its sum
  SweepView view;
  int first_slot = 0;  ///< of the colour
  bool asks_late;      ///< it overlaps the launch that decides whose turn it is, and looks only after its sum

  template <class Team>
  OGC_HD void operator()(int i, const Team& team) const {
    const SweepVertex vertex = view.vertices[first_slot + i];
    if (!asks_late && view.is_off(vertex)) return team.leave();
    const int v = vertex.vertex;
    const Vec own = view.old[v], target = view.target[v];
    const Ball ball = view.regions.ball(v);
    ForceAndBlock total = Gather{}(view, first_slot + i, vertex, own, team);
    if (!team.holds_total() || (asks_late && view.is_off())) return;
    add_inertia(vertex.inertia, own, target, total);
    const Vec change = solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
    const Vec x = write_held(view, v, own + change, own, view.regions.region(v, ball),
                             BlockMetric{total.block, 1.0f / vertex.inertia}, team);
    if constexpr (gathers_volumes<Gather>) {
      if (team.leader() && Gather::lies_deep(view, first_slot + i, x)) view.control->count_deep_inside();
    }
  }
};

/// for_each over the prescribed vertices, before the first colour of an iteration.
struct UpdatePrescribed {
  SweepView view;
  const int* prescribed = nullptr;  ///< numbers of the prescribed vertices

  OGC_HD void operator()(int i) const {
    if (view.is_off()) return;
    const int v = prescribed[i];
    const Vec target = view.target[v], old = view.old[v];
    if (!is_finite(target)) {
      view.write(v, old);
      view.control->count_not_finite();
      return;
    }
    const FeasibleRegion region = view.regions[v];
    const Truncated kept = held_on_path(region, old, target);
    view.write(v, kept.position);
    count_behind(*view.control, kept, region.ball.centre, view.regions);
  }
};

/// What a step leaves of the force on a free vertex (Eq. 29). Forces in newtons.
struct alignas(16) LeftForce {
  float reference = 0;  ///< ‖f*‖, after the guess loop
  float left = 0;       ///< ‖f‖ at the end
  float rounding = 0;   ///< how much of it may come from positions that are rounded
  int is_held = 0;      ///< 1: its next update would leave its region, so that its force stays
};

/// for_each_team over all slots: the force on each vertex where all of them are. The view reads and writes one buffer,
/// to_fresh = 0; nothing is written there.
template <class Gather>
struct MeasureVertex {
  static constexpr int parts = Gather::parts;  ///< of its sum
  SweepView view;
  LeftForce* left;  ///< by slot
  bool is_end;      ///< of the step; else the reference is written

  template <class Team>
  OGC_HD void operator()(int slot, const Team& team) const {
    const SweepVertex vertex = view.vertices[slot];
    const Vec own = view.old[vertex.vertex], target = view.target[vertex.vertex];
    ForceAndBlock total = Gather{}(view, slot, vertex, own, team);
    if (!team.holds_total()) return;
    add_inertia(vertex.inertia, own, target, total);
    const float force = sqrtf(dot(total.force, total.force));
    if (!is_end) {
      if (team.leader()) left[slot].reference = force;
      return;
    }
    const Vec change = solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
    const bool is_free = is_within(view.regions[vertex.vertex], own + change, team);
    if (!team.leader()) return;
    left[slot].left = force;
    left[slot].rounding = rounding_of_force(total.block, own);
    left[slot].is_held = is_free ? 0 : 1;
  }

 private:
  /// A stored coordinate is off by u |x| at most, u = 2⁻²⁴, the force by the block times that; neighbours, whose blocks
  /// add up to about the own one, double it.
  OGC_HD static float rounding_of_force(const Symmetric3& block, const Vec& x) {
    const float largest = fmaxf(fmaxf(fabsf(x.x), fabsf(x.y)), fabsf(x.z));
    return 2 * 0x1p-24f * largest * (block.xx + block.yy + block.zz);
  }
};

}  // namespace ogc::fast
