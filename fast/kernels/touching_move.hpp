// Computes how contacts shorten a vertex's move in the guess loop (method.md §5.2). A vertex in contact does not move
// into its partner, and friction slows it. So a sweep begins with nearly the forces with which it ends.
#pragma once

#include "fast/contact_view.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// Holds the contacts that are known in a round of the guess loop, and the moves that vertices would make without
/// contacts.
struct GuessContacts {
  RowNumbers rows;               ///< numbers of the rows of `contacts`
  const int* offsets = nullptr;  ///< by row, rows.count() + 1: where it begins; null: contacts are ignored
  const ContactIncidence* contacts = nullptr;  ///< contact stream of the detection
  const Vec* position = nullptr;               ///< X_prev by vertex [m]
  const Vec* target = nullptr;                 ///< y by vertex [m]
  const Vec* taken = nullptr;  ///< t by vertex [m]: by how much contacts changed the vertex's move in the last round
  float radius = 0;            ///< r [m]

  /// Returns the move that this round assumes for another vertex of a contact [m]: y − X_prev plus the change by
  /// contacts in the last round.
  OGC_HD Vec expected(int v) const { return target[v] - position[v] + taken[v]; }

  /// Calls use(contact) for each contact of a vertex, vertex–facet contacts first, until it returns true. Returns
  /// whether it did.
  template <class Use>
  OGC_HD bool any(int v, const Use& use) const {
    for (int kind = 0; kind < 2; ++kind) {
      const int row = rows(v, kind == 1);
      for (int i = offsets[row]; i < offsets[row + 1]; ++i)
        if (use(contacts[i])) return true;
    }
    return false;
  }
};

/// Returns the move of a vertex [m] after one contact has shortened it. The contact removes the vertex's approach,
/// except the part by which the contact's other vertices move away. Friction removes slip, at most μ times the removed
/// approach.
OGC_HD inline Vec held_by(const GuessContacts& here, const ContactIncidence& contact, const Vec& move) {
  Vec x[4], others{};
  for (int k = 0; k < 4; ++k) x[k] = here.position[decoded(contact.index[k])];
  const ContactWeights weights = contact_weights(contact.kind, x);
  const ContactShape shape = contact_shape(weighted_sum(weights, x), here.radius);
  const float own = weights.of(contact.own), size = fabsf(own);
  if (!shape.acts || !(size > 0)) return move;
  for (int k = 0; k < 4; ++k) {
    if (k == contact.own || weights.slot[k] == 0) continue;
    others = others + weights.slot[k] * here.expected(decoded(contact.index[k]));
  }
  const float opening = dot(shape.normal, others), closing = -own * dot(shape.normal, move);
  const float taken = (closing - (opening > 0 ? opening : 0.0f)) / size;
  if (!(taken > 0)) return move;
  Vec held = move + (own < 0 ? -taken : taken) * shape.normal;
  if (!(contact.friction > 0)) return held;
  const Vec relative = own * held + others, slip = relative - dot(shape.normal, relative) * shape.normal;
  const float length = square_root(dot(slip, slip)), limit = contact.friction * taken * size;
  if (length > 0) held = held - ((limit < length ? limit / length : 1.0f) / own) * slip;
  return held;
}

/// Returns whether a vertex takes part in a contact that exerts a force.
OGC_HD inline bool touches(const GuessContacts& here, int v) {
  return here.any(v, [&here](const ContactIncidence& contact) {
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = here.position[decoded(contact.index[k])];
    return contact_shape(weighted_sum(contact_weights(contact.kind, x), x), here.radius).acts;
  });
}

/// Returns the move of a vertex after all its contacts have shortened it, one after the other [m].
OGC_HD inline Vec held_move(const GuessContacts& here, int v, const Vec& move) {
  Vec held = move;
  here.any(v, [&here, &held](const ContactIncidence& contact) {
    held = held_by(here, contact, held);
    return false;
  });
  return held;
}

}  // namespace ogc::fast
