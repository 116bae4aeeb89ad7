// A pack of contacts at a time, with the default activation: where contact_force.hpp, activation.hpp and
// friction_force.hpp branch, the same formulas with both sides computed and one selected, so that the same bits come
// out (tests/fast/stages/sweep.cpp). Closest points of two proper segments and of a point over a triangle are computed
// together, those of anything else one by one.
#pragma once

#include <bit>
#include <cmath>

#include "fast/cpu/pack.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"

namespace ogc::fast {

/// The weights of one contact, compiled once for all machines.
ContactWeights weights_of_one(ContactKind kind, const Vec* x);

inline namespace OGC_PACKS {

/// OgcActivation within the radius: both stages are computed, and one is selected.
struct PackedActivation {
  /// g' [N] and g'' [N/m] by lane, for distances 0 < d ≤ r [m] and stiffnesses k_c [N/m].
  template <int N>
  static ActivationSlopeOf<PackOf<N>> slope_within(PackOf<N> d, float r, PackOf<N> k) {
    const PackMaskOf<N> logarithmic = d < 0.5F * r;
    const PackOf<N> slope = OgcActivation::logarithmic_stiffness(r, k) / d;
    return {select(logarithmic, -slope, -k * (r - d)), select(logarithmic, slope / d, k)};
  }
};

/// friction_slope_over_slip of fast/kernels/friction_force.hpp by lane [1/m].
template <int N>
PackOf<N> friction_slope_over_slip(PackOf<N> slip, float limit) {
  return select(slip < limit, (2.0F - slip / limit) / limit, 1.0F / slip);
}

namespace packed {

/// t within [0, 1] by lane; 0 for NaN.
template <class P>
P clamp_unit(P t) {
  return select(t > 0.0F, select(t < 1.0F, t, 1.0F), 0.0F);
}

/// closest_on_segments by lane, as weights. `usual`: lanes where this formula holds, that is neither segment has length
/// zero, and they are not nearly parallel.
template <class P>
ContactWeightsOf<P> segment_weights(const Vector<P>* x, typename P::Mask& usual) {
  const Vector<P> first = x[1] - x[0], second = x[3] - x[2], between = x[2] - x[0];
  const P aa = dot(first, first), bb = dot(second, second), ab = dot(first, second);
  const Vector<P> normal = cross(first, second);
  const P sine = dot(normal, normal), to_start = dot(first, between);
  usual = aa > 0.0F && bb > 0.0F && !(sine < 1e-6F * aa * bb);
  const P s = clamp_unit(dot(cross(between, second), normal) / sine);
  const P t = (s * ab - dot(second, between)) / bb;
  const typename P::Mask inside = t > 0.0F && t < 1.0F;
  const P end = select(t > 0.0F, P(1.0F), P(0.0F));
  const P p = select(inside, s, clamp_unit((to_start + end * ab) / aa)), q = select(inside, t, end);
  return {{1.0F - p, p, q - 1.0F, -q}};
}

/// closest_on_triangle by lane, as weights. `usual`: lanes where this formula holds, that is the point lies over the
/// interior.
template <class P>
ContactWeightsOf<P> triangle_weights(const Vector<P>* x, typename P::Mask& usual) {
  const Vector<P> ab = x[2] - x[1], ac = x[3] - x[1], ap = x[0] - x[1], normal = cross(ab, ac);
  const P area = dot(normal, normal);
  const P b = dot(cross(ap, ac), normal), c = dot(cross(ab, ap), normal), a = area - b - c;
  usual = a > 0.0F && b > 0.0F && c > 0.0F;
  return {{1.0F, -(a / area), -(b / area), -(c / area)}};
}

/// Weights of the closest points of the items that are counted, by slot. Those that are not `usual` are computed one by
/// one.
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

/// By lane: weight of the slot that the item's own vertex has.
template <class P>
P own_weight(const Items<ContactIncidence, P>& items, const ContactWeightsOf<P>& weights) {
  float slot[4][P::width];
  for (int s = 0; s < 4; ++s) weights.slot[s].store(slot[s]);
  return P::of_each([&](int k) { return slot[items.at[k]->own][k]; });
}

/// ContactAt::majorant by lane.
template <class P>
P majorants(const Items<ContactIncidence, P>& items, const ContactWeightsOf<P>& weights) {
  float slot[4][P::width];
  for (int s = 0; s < 4; ++s) weights.slot[s].store(slot[s]);
  return P::of_each([&](int k) {
    const float own = std::abs(slot[items.at[k]->own][k]);
    float together = own;
    for (int s = 0; s < 4; ++s) together += (items.at[k]->together >> s & 1) != 0 ? std::abs(slot[s][k]) : 0.0F;
    return own * together;
  });
}

/// Σ w (x − xᵗ) of each [m].
template <class P>
Vector<P> moved_apart(const SweepView& view, const Items<ContactIncidence, P>& items,
                      const ContactWeightsOf<P>& weights, const Vector<P>* x) {
  const auto moved_by = [&](int s) {
    return x[s] - items.each_position([&](const ContactIncidence& i) -> const PaddedVec& {
      return view.start.at[decoded(i.index[s])];
    });
  };
  const Vector<P> moved[4] = {moved_by(0), moved_by(1), moved_by(2), moved_by(3)};
  const P* w = weights.slot;
  return w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2] + w[3] * moved[3];
}

/// add_friction of each item that has friction; the others' sums stay, bit for bit.
template <class P>
void add_slip(const SweepView& view, const Items<ContactIncidence, P>& items, const Vector<P>* x,
              const ContactWeightsOf<P>& weights, const Vector<P>& normal, P weight, P majorant, P normal_force,
              ForceAndBlockOf<P>& sum) {
  const P friction = items.each([](const ContactIncidence& i) { return i.friction; });
  const typename P::Mask slips = friction > 0.0F;
  if (is_false(slips)) return;
  ForceAndBlockOf<P> with = sum;
  add_friction(normal, moved_apart(view, items, weights, x), weight, majorant, friction, normal_force,
               view.friction_limit, with);
  sum = selected<P>(slips, with, sum);
}

/// contact_term of each, added where it is counted.
template <class P>
void add_contacts(const SweepView& view, const Items<ContactIncidence, P>& items, ForceAndBlockOf<P>& sum) {
  using Incidence = ContactIncidence;
  const auto position = [&](int s) {
    return items.each_position(
        [&](const Incidence& i) -> const PaddedVec& { return view.old[view.number(i.index[s])]; });
  };
  const Vector<P> x[4] = {position(0), position(1), position(2), position(3)};
  const ContactWeightsOf<P> weights = packed::weights(items, x);
  const Vector<P> separation = weighted_sum(weights, x);
  const P squared = dot(separation, separation), distance = root(squared), weight = own_weight(items, weights);
  const typename P::Mask acts = items.counted && !(squared < 0x1p-126F) && (weight > 0.0F || weight < 0.0F);
  if (is_false(acts)) return;
  const ContactShapeOf<P> shape{(1.0F / distance) * separation, distance, acts};
  ForceAndBlockOf<P> term;
  const P majorant = majorants(items, weights);
  const P normal_force = add_contact(PackedActivation{}, shape, weight, majorant, view.contact_radius,
                                     items.each([](const Incidence& i) { return i.stiffness; }), term);
  add_slip(view, items, x, weights, shape.normal, weight, majorant, normal_force, term);
  sum += selected<P>(acts, term, {});
}

}  // namespace packed
}  // namespace OGC_PACKS
}  // namespace ogc::fast
