// Contacts frozen for an iteration (contact_weights=iteration, method.md §7.2): weights of closest points and Σ w xᵗ
// are computed once a pair and iteration. An update then gathers four positions and 32 bytes in place of eight
// positions, and solves no closest-point problem.
#pragma once

#include "fast/contact_view.hpp"
#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/rods/sweep.hpp"

namespace ogc::fast {

/// for_each_counted over the pairs of the last detection, vertex–facet ones first, before an iteration.
struct FreezeContacts {
  SweepView view;         ///< of the iteration
  ContactView contacts;   ///< records of the detection
  const int* overflow;    ///< not 0: records are not whole, and no step comes of it; null: never
  FrozenContact* frozen;  ///< by pair, written

  OGC_HD void operator()(int i) const {
    if (view.is_off() || (overflow != nullptr && *overflow != 0)) return;
    const int facets = *contacts.vertex_facet_count;
    ContactIncidence contact;
    if (i < facets)
      set_slots(contact, contacts.vertex_facet[i]);
    else
      set_slots(contact, contacts.edge_edge[i - facets]);
    Vec x[4], start[4];
    for (int k = 0; k < 4; ++k) x[k] = PaddedVecs{view.old}[contact.index[k]], start[k] = view.start[contact.index[k]];
    const ContactWeights weights = contact_weights(contact.kind, x);
    FrozenContact result;
    for (int k = 0; k < 4; ++k) result.weight[k] = weights.slot[k];
    result.start = weighted_sum(weights, start);
    frozen[i] = result;
  }
};

/// Contacts whose weights FreezeContacts has computed.
struct WeightsOfIteration {
  template <PairKind, class Activation>
  OGC_HD static ForceAndBlock term(const SweepView& view, const Activation& activation,
                                   const ContactIncidence& incidence) {
    const FrozenContact frozen = view.frozen[incidence.pair];
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = view.read(incidence.index[k]);
    ContactWeights weights;
    for (int k = 0; k < 4; ++k) weights.slot[k] = frozen.weight[k];
    const Vec separation = weighted_sum(weights, x);
    const ContactAt at = contact_with(incidence, weights, separation, view.contact_radius);
    ForceAndBlock term;
    if (!at.acts()) return term;
    const float normal_force = add_contact(activation, at.shape, at.weight, at.majorant, view.contact_radius,
                                           incidence.stiffness, term);
    if (incidence.friction > 0)
      add_friction(at.shape.normal, separation - frozen.start, at.weight, at.majorant, incidence.friction, normal_force,
                   view.friction_limit, term);
    return term;
  }
};

/// As GatherDefault.
using GatherFrozenSurfaces = GatherSurfaces<WeightsOfIteration>;

/// Of any scene.
using GatherFrozen = GatherAnything<WeightsOfIteration>;

}  // namespace ogc::fast
