// Four contacts at a time, with the default activation: where contact_force.hpp, activation.hpp and friction_force.hpp branch, the same formulas with both sides computed
// and one selected, so that the same bits come out (tests/fast/stages/sweep.cpp). Closest points of two proper segments and of a point over a triangle are computed together; where one of the four is
// anything else they are computed one by one.
#pragma once

#include "fast/cpu/pack.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/sweep.hpp"

namespace ogc::fast {

/// Of ContactActivation::ogc.
inline ActivationSlopeOf<Pack> activation_slope(ContactActivation kind, Pack d, float r, Pack k) {
  const PackMask logarithmic = d < 0.5F * r;
  const Pack slope = logarithmic_stiffness(kind, r, k) / d;
  return {select(logarithmic, -slope, -k * (r - d)), select(logarithmic, slope / d, k)};
}

inline Pack friction_slope_over_slip(Pack slip, float limit) { return select(slip < limit, (2.0F - slip / limit) / limit, 1.0F / slip); }

}  // namespace ogc::fast

namespace ogc::fast::packed {

using Weights = ContactWeightsOf<Pack>;

inline Pack clamp_unit(Pack t) { return select(t > 0.0F, select(t < 1.0F, t, 1.0F), 0.0F); }

/// closest_on_segments; `usual`: where the result is that. False for a segment of length zero and for nearly parallel ones.
inline Weights segment_weights(const Vector<Pack>* x, PackMask& usual) {
  const Vector<Pack> first = x[1] - x[0], second = x[3] - x[2], between = x[2] - x[0];
  const Pack aa = dot(first, first), bb = dot(second, second), ab = dot(first, second);
  const Vector<Pack> normal = cross(first, second);
  const Pack sine = dot(normal, normal), to_start = dot(first, between);
  usual = aa > 0.0F && bb > 0.0F && !(sine < 1e-6F * aa * bb);
  const Pack s = clamp_unit(dot(cross(between, second), normal) / sine);
  const Pack t = (s * ab - dot(second, between)) / bb;
  const PackMask inside = t > 0.0F && t < 1.0F;
  const Pack end = select(t > 0.0F, 1.0F, 0.0F);
  const Pack p = select(inside, s, clamp_unit((to_start + end * ab) / aa)), q = select(inside, t, end);
  return {{1.0F - p, p, q - 1.0F, -q}};
}

/// closest_on_triangle; `usual`: where the point is over the interior, and the result is that.
inline Weights triangle_weights(const Vector<Pack>* x, PackMask& usual) {
  const Vector<Pack> ab = x[2] - x[1], ac = x[3] - x[1], ap = x[0] - x[1], normal = cross(ab, ac);
  const Pack area = dot(normal, normal);
  const Pack b = dot(cross(ap, ac), normal), c = dot(cross(ab, ap), normal), a = area - b - c;
  usual = a > 0.0F && b > 0.0F && c > 0.0F;
  return {{1.0F, -(a / area), -(b / area), -(c / area)}};
}

inline bool are_of(const Items<ContactIncidence>& items, ContactKind kind) {
  return items.at[0]->kind == kind && items.at[1]->kind == kind && items.at[2]->kind == kind && items.at[3]->kind == kind;
}

inline Weights weights(const Items<ContactIncidence>& items, const Vector<Pack>* x) {
  PackMask usual;
  Weights weights;
  if (are_of(items, ContactKind::segment_segment)) weights = segment_weights(x, usual);
  else if (are_of(items, ContactKind::point_triangle)) weights = triangle_weights(x, usual);
  if (is_false(!usual)) return weights;
  float at[3][4][Pack::width], slot[4][Pack::width];  // [axis][slot][place]
  for (int s = 0; s < 4; ++s) x[s].x.store(at[0][s]), x[s].y.store(at[1][s]), x[s].z.store(at[2][s]);
  for (int k = 0; k < Pack::width; ++k) {
    Vec of_one[4];
    for (int s = 0; s < 4; ++s) of_one[s] = {at[0][s][k], at[1][s][k], at[2][s][k]};
    const ContactWeights one = contact_weights(items.at[k]->kind, of_one);
    for (int s = 0; s < 4; ++s) slot[s][k] = one.slot[s];
  }
  for (int s = 0; s < 4; ++s) weights.slot[s] = Pack(slot[s]);
  return weights;
}

/// Of the slot that each item's own vertex has.
inline Pack own_weight(const Items<ContactIncidence>& items, const Weights& weights) {
  float slot[4][Pack::width];
  for (int s = 0; s < 4; ++s) weights.slot[s].store(slot[s]);
  return {slot[items.at[0]->own][0], slot[items.at[1]->own][1], slot[items.at[2]->own][2], slot[items.at[3]->own][3]};
}

/// add_friction at items with friction.
inline void add_slip(const SweepView& view, const Items<ContactIncidence>& items, const Weights& weights, const Vector<Pack>* x, const Vector<Pack>& normal,
                     Pack weight, Pack normal_force, ForceAndBlockOf<Pack>& sum) {
  const Pack friction = items.each([](const ContactIncidence& i) { return i.friction; });
  const PackMask slips = friction > 0.0F;
  if (is_false(slips)) return;
  Vector<Pack> moved[4];
  for (int s = 0; s < 4; ++s) moved[s] = x[s] - items.each_place([&](const ContactIncidence& i) -> const Place& { return view.start.at[decoded(i.index[s])]; });
  const Pack* w = weights.slot;
  const Vector<Pack> relative = w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2] + w[3] * moved[3];
  ForceAndBlockOf<Pack> with = sum;
  add_friction(normal, relative, weight, friction, normal_force, view.friction_limit, with);
  sum = select(slips, with, sum);
}

/// contact_term of each, added where it is counted.
inline void add_contacts(const SweepView& view, const Items<ContactIncidence>& items, ForceAndBlockOf<Pack>& sum) {
  using Incidence = ContactIncidence;
  Vector<Pack> x[4];
  for (int s = 0; s < 4; ++s) x[s] = items.each_place([&](const Incidence& i) -> const Place& { return view.old[view.number(i.index[s])]; });
  const Weights weights = packed::weights(items, x);
  const Vector<Pack> separation = weighted_sum(weights, x);
  const Pack squared = dot(separation, separation), distance = root(squared), weight = own_weight(items, weights);
  const PackMask acts = items.counted && !(squared < 0x1p-126F) && distance < view.radius && (weight > 0.0F || weight < 0.0F);
  if (is_false(acts)) return;
  const ContactShapeOf<Pack> shape{(1.0F / distance) * separation, distance, acts};
  ForceAndBlockOf<Pack> term;
  const Pack normal_force = add_contact(ContactActivation::ogc, shape, weight, view.radius, items.each([](const Incidence& i) { return i.stiffness; }), term);
  add_slip(view, items, weights, x, shape.normal, weight, normal_force, term);
  sum += select(acts, term, ForceAndBlockOf<Pack>{});
}

}  // namespace ogc::fast::packed
