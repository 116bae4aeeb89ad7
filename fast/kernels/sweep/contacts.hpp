// Adds contacts to the sum of a vertex. The formulas handle one contact, or several side by side.
#pragma once

#include "fast/kernels/friction_force.hpp"
#include "fast/kernels/items.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// Returns the weights of the closest points of a contact; `x` are the positions of its vertices (contact_force.hpp).
template <PairKind pairs>
OGC_HD ContactWeights closest_weights(const OneItem<ContactIncidence>& one, const Vec* x) {
  return contact_weights<pairs>(one.item.kind, x);
}
/// Returns the weight of the vertex that is updated.
OGC_HD inline float own_weight(const OneItem<ContactIncidence>& one, const ContactWeights& weights) {
  return weights.of(one.item.own);
}
/// Returns |w| Σ |w_u|, where w is the weight of the updated vertex. The sum is over all vertices u of the contact that
/// have this vertex's colour, including the vertex itself. If no other vertex has this colour, the result is w².
OGC_HD inline float majorant_of(const OneItem<ContactIncidence>& one, const ContactWeights& weights) {
  const float own = fabsf(own_weight(one, weights));
  float together = own;
  for (int k = 0; k < 4; ++k) together += (one.item.together >> k & 1) != 0 ? fabsf(weights.slot[k]) : 0.0f;
  return own * together;
}

/// Holds one contact, or several side by side, at the positions that a vertex update reads.
template <class N>
struct ContactAtOf {
  Vector<N> x[4], start[4];     ///< by vertex of the contact: x, and with friction xᵗ [m]
  N friction{};                 ///< μ
  ContactWeightsOf<N> weights;  ///< w by vertex of the contact
  ContactShapeOf<N> shape;
  N weight{};    ///< w of the vertex that is updated
  N majorant{};  ///< replaces w² in the block

  /// Returns whether the contact adds to force or block: the closest points do not coincide, and the vertex's weight is
  /// not 0.
  OGC_HD Mask<N> acts() const { return shape.distance > N(0.0f) && (weight > N(0.0f) || weight < N(0.0f)); }
};

/// Reads contacts at the current positions of their vertices.
template <PairKind pairs, class Items>
OGC_HD ContactAtOf<typename Items::Number> contacts_at(const SweepShared& view, const Items& items) {
  using N = typename Items::Number;
  using Seen = ContactIncidence;
  ContactAtOf<N> at;
  at.x[0] = items.position(view, [](const Seen& i) { return i.index[0]; });
  at.x[1] = items.position(view, [](const Seen& i) { return i.index[1]; });
  at.x[2] = items.position(view, [](const Seen& i) { return i.index[2]; });
  at.x[3] = items.position(view, [](const Seen& i) { return i.index[3]; });
  at.friction = items.each([](const Seen& i) { return i.friction; });
  if (!is_false(at.friction > N(0.0f))) {
    at.start[0] = items.start(view, [](const Seen& i) { return i.index[0]; });
    at.start[1] = items.start(view, [](const Seen& i) { return i.index[1]; });
    at.start[2] = items.start(view, [](const Seen& i) { return i.index[2]; });
    at.start[3] = items.start(view, [](const Seen& i) { return i.index[3]; });
  }
  at.weights = closest_weights<pairs>(items, at.x);
  at.shape = contact_shape(weighted_sum(at.weights, at.x), view.contact_radius);
  at.weight = own_weight(items, at.weights);
  at.majorant = majorant_of(items, at.weights);
  return at;
}

/// Adds friction; `normal_force` is λ of the same contact.
template <class N>
OGC_HD void add_contact_friction(const ContactAtOf<N>& at, const N& normal_force, float limit,
                                 ForceAndBlockOf<N>& sum) {
  add_where(at.friction > N(0.0f), sum, [&](ForceAndBlockOf<N>& to) {
    const Vector<N> moved[4] = {at.x[0] - at.start[0], at.x[1] - at.start[1], at.x[2] - at.start[2],
                                at.x[3] - at.start[3]};
    const N* w = at.weights.slot;
    const Vector<N> relative = w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2] + w[3] * moved[3];
    add_friction(at.shape.normal, relative, at.weight, at.majorant, at.friction, normal_force, limit, to);
  });
}

/// Returns the force and block of a contact on the vertex that is updated, friction included.
template <PairKind pairs, class Activation, class Items>
OGC_HD ForceAndBlockOf<typename Items::Number> contact_term(const SweepShared& view, const Activation& activation,
                                                            const Items& items) {
  using N = typename Items::Number;
  const ContactAtOf<N> at = contacts_at<pairs>(view, items);
  const N stiffness = items.each([](const ContactIncidence& i) { return i.stiffness; });
  ForceAndBlockOf<N> term;
  add_where(at.acts(), term, [&](ForceAndBlockOf<N>& to) {
    const N normal_force = add_contact(activation, at.shape, at.weight, at.majorant, view.contact_radius, stiffness,
                                       to);
    add_contact_friction(at, normal_force, view.friction_limit, to);
  });
  return term;
}

/// Makes the two parts of a vertex's sum for its vertex–facet and its edge–edge contacts. They are PooledParts: a
/// vertex may have fifty contacts and its neighbours none, so teams share the work. `Activation` is a functor of
/// models/activation.hpp.
template <class Activation>
struct ContactParts {
  const SweepShared& view;
  ContactRow row;  ///< contacts of the vertex
  Activation activation;

  /// `vertex_facet` returns the part of the vertex–facet contacts, `edge_edge` the part of the edge–edge contacts.
  OGC_HD auto vertex_facet() const { return range<PairKind::vertex_facet>(row.vertex_facet); }
  OGC_HD auto edge_edge() const { return range<PairKind::edge_edge>(row.edge_edge); }

 private:
  template <PairKind pairs>
  OGC_HD auto range(const Row& own) const {
    return pooled_part(
        own.begin, own.count, [contacts = view.contacts](int i) { return contacts[i]; },
        [seen = &view, activation = activation](const ContactIncidence& contact) {
          return contact_term<pairs>(*seen, activation, OneItem<ContactIncidence>{contact});
        });
  }
};

}  // namespace ogc::fast
