// One vertex update of Algorithm 4: all energies of a vertex gathered from streams that hold, incidence by incidence, everything but positions, then a
// 3×3 solve, then truncation, then the write. One stencil type after another, each padded to a multiple of W, so that the lanes of a team do the same
// thing at the same time, and one reduction for all of them.
//
// Two position buffers an iteration (method.md §7): a neighbour of lower colour is read from the fresh buffer, any other from the old one. Which of the
// two is known when the streams are made, so it stands in the index: n ≥ 0 reads old[n], n < 0 reads fresh[~n]. Prescribed and fixed vertices count as
// colour -1.
#pragma once

#include <cmath>
#include <cstdint>

#include "fast/kernels/bending.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/friction_force.hpp"
#include "fast/kernels/inertia.hpp"
#include "fast/kernels/membrane.hpp"
#include "fast/kernels/solve3.hpp"
#include "fast/kernels/truncate.hpp"

namespace ogc::fast {

/// A free vertex in the order of the sweep, with its rows in the streams.
struct SweepVertex {
  int vertex = -1;
  int body = -1;
  float inertia = 0;  ///< m/h² [N/m]
  int membrane_begin = 0, membrane_count = 0;
  int hinge_begin = 0, hinge_count = 0;
};

/// A triangle seen from one of its corners. `index`: the other two, in the triangle's order, encoded as said above.
struct alignas(16) MembraneIncidence {
  int index[2] = {0, 0};
  int triangle = -1;  ///< number in RestState::triangles
  MembraneStencil stencil{};
};

/// A hinge seen from one of its vertices. At an end of the edge `index` is the other end, o0, o1 (with the own vertex as x0); at an opposite vertex it is
/// x0, x1, o1 (with the own vertex as o0).
struct alignas(8) HingeIncidence {
  int index[3] = {0, 0, 0};
  int hinge = -1;  ///< number in RestState::hinges; ~number at an opposite vertex
  HingeStencil stencil{};
};

/// A contact seen from one of its vertices: slots as in contact_force.hpp; `own` is the slot of the vertex itself. The stiffness holds e_k of the detection.
struct alignas(16) ContactIncidence {
  int index[4] = {0, 0, 0, 0};
  float stiffness = 0, friction = 0;
  ContactKind kind = ContactKind::point_point;
  std::uint8_t own = 0;
};

/// The vertex of an encoded index, without a branch: which buffer is read is as good as random.
OGC_HD inline int decoded(int index) { return index ^ (index >> 31); }

/// Everything that an update reads and writes. Plain pointers, valid for one launch sequence.
struct SweepView {
  const SweepVertex* vertices = nullptr;
  const MembraneIncidence* membrane = nullptr;
  const HingeIncidence* hinges = nullptr;
  const int* contact_rows = nullptr;  ///< by vertex, vertex_count + 1
  const ContactIncidence* contacts = nullptr;
  const SurfaceMaterial* materials = nullptr;
  const Symmetric2* strain_start = nullptr;  ///< Gᵗ by triangle
  const float* angle_start = nullptr;        ///< θᵗ by hinge
  const Vec* start = nullptr;                ///< xᵗ
  const Vec* target = nullptr;               ///< y
  const Vec* previous = nullptr;             ///< X_prev
  const float* bound = nullptr;              ///< b_v
  const Vec* old = nullptr;
  Vec* fresh = nullptr;
  StepControl* control = nullptr;
  float radius = 0;          ///< r [m]
  float friction_limit = 0;  ///< ε_v h [m]

  OGC_HD Vec read(int index) const { return (index < 0 ? fresh : old)[decoded(index)]; }
};

OGC_HD inline void add_membrane_incidence(const SweepView& view, const MembraneIncidence& incidence, const SurfaceMaterial& material, const Vec& own,
                                          ForceAndBlock& sum) {
  const Vec to_b = view.read(incidence.index[0]) - own, to_c = view.read(incidence.index[1]) - own;
  const Symmetric2 start = material.membrane_damping > 0 ? view.strain_start[incidence.triangle] : Symmetric2{};
  add_membrane(incidence.stencil, material, to_b, to_c, start, sum);
}

OGC_HD inline void add_hinge_incidence(const SweepView& view, const HingeIncidence& incidence, const SurfaceMaterial& material, const Vec& own,
                                       ForceAndBlock& sum) {
  const bool opposite = incidence.hinge < 0;
  const Vec p0 = view.read(incidence.index[0]), p1 = view.read(incidence.index[1]), p2 = view.read(incidence.index[2]);
  const Vec base = opposite ? p0 : own, end = opposite ? p1 : p0, side = opposite ? own : p1;
  const HingeShape shape = hinge_shape(end - base, side - base, p2 - base);
  if (!shape.defined) return;
  const float angle_start = material.bending_damping > 0 ? view.angle_start[decoded(incidence.hinge)] : 0.0f;
  add_hinge(incidence.stencil, material.bending_damping, shape.angle, angle_start, hinge_gradient(shape, opposite), sum);
}

OGC_HD inline void add_contact_incidence(const SweepView& view, const ContactIncidence& incidence, ForceAndBlock& sum) {
  Vec x[4];
  for (int k = 0; k < 4; ++k) x[k] = view.read(incidence.index[k]);
  const ContactWeights weights = contact_weights(incidence.kind, x);
  const ContactShape shape = contact_shape(weighted_sum(weights, x), view.radius);
  const float weight = weights.slot[incidence.own];
  if (!shape.acts || weight == 0) return;
  const float normal_force = add_contact(shape, weight, view.radius, incidence.stiffness, sum);
  if (!(incidence.friction > 0)) return;
  Vec moved[4];
  for (int k = 0; k < 4; ++k) moved[k] = x[k] - view.start[decoded(incidence.index[k])];
  const Vec relative = weights.slot[0] * moved[0] + weights.slot[1] * moved[1] + weights.slot[2] * moved[2] + weights.slot[3] * moved[3];
  add_friction(shape.normal, relative, weight, incidence.friction, normal_force, view.friction_limit, sum);
}

/// The sum over all stencils of one vertex, inertia left out.
template <class Team>
OGC_HD ForceAndBlock gather(const SweepView& view, const SweepVertex& vertex, const Vec& own, const Team& team) {
  constexpr int pad = Team::width - 1;
  const int contact_begin = view.contact_rows[vertex.vertex], contact_count = view.contact_rows[vertex.vertex + 1] - contact_begin;
  const int hinge_start = (vertex.membrane_count + pad) & ~pad, contact_start = hinge_start + ((vertex.hinge_count + pad) & ~pad);
  const SurfaceMaterial material = view.materials[vertex.body];
  return team.template sum<ForceAndBlock>(contact_start + contact_count, [&](int k, ForceAndBlock& sum) {
    if (k < hinge_start) {
      if (k < vertex.membrane_count) add_membrane_incidence(view, view.membrane[vertex.membrane_begin + k], material, own, sum);
    } else if (k < contact_start) {
      if (k - hinge_start < vertex.hinge_count) add_hinge_incidence(view, view.hinges[vertex.hinge_begin + k - hinge_start], material, own, sum);
    } else {
      add_contact_incidence(view, view.contacts[contact_begin + k - contact_start], sum);
    }
  });
}

/// Writes a position truncated about X_prev and counts where it was cut. A proposal that is not finite is not written: the vertex stays and the step fails.
OGC_HD inline void write_truncated(const SweepView& view, int v, const Vec& proposal, const Vec& stay) {
  if (!is_finite(proposal)) {
    view.fresh[v] = stay;
    view.control->count_not_finite();
    return;
  }
  const Truncated kept = truncate(view.previous[v], proposal, view.bound[v]);
  view.fresh[v] = kept.position;
  if (kept.exceeded) view.control->count_cut();
}

/// for_each_team over the slots of one colour.
struct UpdateVertex {
  SweepView view;
  int first_slot = 0;

  template <class Team>
  OGC_HD void operator()(int i, const Team& team) const {
    const SweepVertex vertex = view.vertices[first_slot + i];
    const Vec own = view.old[vertex.vertex];
    ForceAndBlock total = gather(view, vertex, own, team);
    if (!team.leader()) return;
    add_inertia(vertex.inertia, own, view.target[vertex.vertex], total);
    const Vec change = solve_symmetric(total.block, total.force, 1.0f / vertex.inertia);
    write_truncated(view, vertex.vertex, own + change, own);
  }
};

/// for_each over the prescribed vertices, before the first colour of an iteration.
struct UpdatePrescribed {
  SweepView view;
  const int* prescribed = nullptr;

  OGC_HD void operator()(int i) const {
    const int v = prescribed[i];
    write_truncated(view, v, view.target[v], view.old[v]);
  }
};

}  // namespace ogc::fast
