// Implements the functions of fast/kernels/sweep/contacts.hpp for a pack of contacts. Closest points of two segments in
// general position, and of a point over a triangle, are computed in packs. All other cases are computed one by one.
#pragma once

#include <bit>
#include <cmath>

#include "fast/cpu/pack.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"

namespace ogc::fast {

/// Returns the weights of one contact. It is compiled once for all machines.
ContactWeights weights_of_one(ContactKind kind, const Vec* x);

inline namespace OGC_PACKS {

namespace packed {

/// `segment_weights` returns the weights of two segments, `triangle_weights` those of a point and a triangle. `usual`:
/// lanes in which the formula of the usual case is valid.
template <class P>
ContactWeightsOf<P> segment_weights(const Vector<P>* x, typename P::Mask& usual) {
  const TwoSegments<P> at(x[1] - x[0], x[3] - x[2], x[2] - x[0]);
  usual = at.is_usual();
  return weights_of(at.parameters());
}
template <class P>
ContactWeightsOf<P> triangle_weights(const Vector<P>* x, typename P::Mask& usual) {
  const PointAndTriangle<P> at(x);
  usual = at.is_inside();
  return weights_of(at.weights());
}

/// Returns, for each vertex of the contacts, its weight in the closest points. Counted items that are not `usual` are
/// computed one by one.
template <class P>
ContactWeightsOf<P> weights(const Items<ContactIncidence, P>& items, const Vector<P>* x) {
  bool segments = false;
  for (const ContactIncidence* item : items.at) segments |= item->kind == ContactKind::segment_segment;
  typename P::Mask usual;
  ContactWeightsOf<P> weights = segments ? segment_weights<P>(x, usual) : triangle_weights<P>(x, usual);
  unsigned together = true_lanes(usual || !items.counted);
  for (int k = 0; k < P::width; ++k) {
    if (items.at[k]->kind != (segments ? ContactKind::segment_segment : ContactKind::point_triangle))
      together &= ~(1U << k);
  }
  unsigned alone = ~together & true_lanes(items.counted);
  if (alone == 0) return weights;
  float at[3][4][P::width], slot[4][P::width];  // [axis][slot][lane]
  for (int s = 0; s < 4; ++s)
    x[s].x.store(at[0][s]), x[s].y.store(at[1][s]), x[s].z.store(at[2][s]), weights.slot[s].store(slot[s]);
  for (; alone != 0; alone &= alone - 1) {
    const int k = std::countr_zero(alone);
    Vec of_one[4];
    for (int s = 0; s < 4; ++s) of_one[s] = {at[0][s][k], at[1][s][k], at[2][s][k]};
    const ContactWeights one = weights_of_one(items.at[k]->kind, of_one);
    for (int s = 0; s < 4; ++s) slot[s][k] = one.slot[s];
  }
  for (int s = 0; s < 4; ++s) weights.slot[s] = P(slot[s]);
  return weights;
}

}  // namespace packed

/// For a pack of contacts, `closest_weights` returns the weights of the closest points, `own_weight` the weight of the
/// vertex, and `majorant_of` the majorant.
template <PairKind, class P>
ContactWeightsOf<P> closest_weights(const packed::Items<ContactIncidence, P>& items, const Vector<P>* x) {
  return packed::weights(items, x);
}
template <class P>
P own_weight(const packed::Items<ContactIncidence, P>& items, const ContactWeightsOf<P>& weights) {
  float slot[4][P::width];
  for (int s = 0; s < 4; ++s) weights.slot[s].store(slot[s]);
  return P::of_each([&](int k) { return slot[items.at[k]->own][k]; });
}
template <class P>
P majorant_of(const packed::Items<ContactIncidence, P>& items, const ContactWeightsOf<P>& weights) {
  float slot[4][P::width];
  for (int s = 0; s < 4; ++s) weights.slot[s].store(slot[s]);
  return P::of_each([&](int k) {
    const float own = std::abs(slot[items.at[k]->own][k]);
    float together = own;
    for (int s = 0; s < 4; ++s) together += (items.at[k]->together >> s & 1) != 0 ? std::abs(slot[s][k]) : 0.0F;
    return own * together;
  });
}

}  // namespace OGC_PACKS
}  // namespace ogc::fast
