// The sum over the stencils of a vertex, inertia left out: one template over kinds of elements. A part that a vertex
// has no items of changes no bit (team.hpp), so that which of the sums a scene takes is a question of time alone.
#pragma once

#include <type_traits>

#include "fast/kernels/friction_force.hpp"
#include "fast/kernels/kinds/hinge.hpp"
#include "fast/kernels/kinds/segment.hpp"
#include "fast/kernels/kinds/spring.hpp"
#include "fast/kernels/kinds/tetrahedron.hpp"
#include "fast/kernels/kinds/triangle.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

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

/// Both kinds of contacts of a vertex, each as a part of its sum. A vertex may have fifty and its neighbours none, so
/// teams share the work. `Activation`: a functor of models/activation.hpp.
template <class Activation>
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
          return contact_term<pairs>(*seen, activation, contact, read_contact(*seen, contact));
        });
  }
};

/// Adds up these kinds in this order, then vertex–facet contacts, then edge–edge contacts. Each kind is a part of the
/// sum: `gives` says what a scene may ask of it, `part_of` makes the part of a vertex.
template <class Activation, class... Kinds>
struct Gather {
  static constexpr int parts = sizeof...(Kinds) + 2;  ///< warps of a block where teams are spread (fast/cuda/team.cuh)
  /// All that a scene may ask of this sum. It has other models than the usual ones only where all of its kinds do.
  static constexpr unsigned gives = ((Kinds::gives | ...) & ~asks_any_model) | (Kinds::gives & ... & asks_any_model) |
                                    (std::is_same_v<Activation, AnyActivation> ? asks_any_activation : 0u);
  /// Whether a vertex may lie deep inside a volume.
  static constexpr bool has_volumes = (gives & asks_volumes) != 0;

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    Activation activation;
    if constexpr (std::is_same_v<Activation, AnyActivation>) activation.activation = view.activation;
    const ContactParts<Activation> contacts{view, view.contact_rows[slot], activation};
    team.prefetch(view.contacts + contacts.row.begin, contacts.row.count * static_cast<int>(sizeof(ContactIncidence)));
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    return total(team, Kinds::part_of(view, slot, vertex, at)..., contacts.vertex_facet(), contacts.edge_edge());
  }

 private:
  template <class Team, class... Parts>
  OGC_HD static ForceAndBlock total(const Team& team, const Parts&... parts) {
    (prefetch(team, parts), ...);
    return team.template sum<ForceAndBlock>(parts...);
  }
  /// Brings the row of a vertex near, which its sum is going to read.
  template <class Team, class AnyPart>
  OGC_HD static void prefetch(const Team& team, const AnyPart& part) {
    if constexpr (requires { part.load.first; })
      team.prefetch(part.load.first, part.count * static_cast<int>(sizeof(*part.load.first)));
  }
};

/// The sum that any scene can take.
using GatherAll = Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts, Segments>;

}  // namespace ogc::fast
