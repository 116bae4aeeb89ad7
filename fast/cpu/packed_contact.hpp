// Four contacts at a time: the formulas of contact_force.hpp, activation.hpp and friction_force.hpp with the default activation and without branches, so that the same
// bits come out (tests/fast/stages/sweep.cpp). Closest points of two proper segments and of a point over a triangle are computed together; where one of the four is
// anything else they are computed one by one.
#pragma once

#include "fast/cpu/pack.hpp"
#include "fast/cpu/packed_items.hpp"
#include "fast/kernels/sweep.hpp"

namespace ogc::fast::packed {

/// By slot.
struct Weights {
  Pack slot[4];
};

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
  for (int s = 0; s < 4; ++s) moved[s] = x[s] - items.each_vector([&](const ContactIncidence& i) { return view.start[decoded(i.index[s])]; });
  const Pack* w = weights.slot;
  const Vector<Pack> relative = w[0] * moved[0] + w[1] * moved[1] + w[2] * moved[2] + w[3] * moved[3];
  const Vector<Pack> slip = relative - dot(normal, relative) * normal;
  const Pack length = root(dot(slip, slip)), limit = view.friction_limit;
  const Pack strength = friction * normal_force * select(length < limit, (2.0F - length / limit) / limit, 1.0F / length);
  ForceAndBlockOf<Pack> with = sum;
  with.add_force(-strength * weight, slip);
  with.add_identity(strength * (weight * weight));
  with.add_outer(-strength * (weight * weight), normal);
  sum = select(slips, with, sum);
}

/// contact_term of each, added where it is counted.
inline void add_contacts(const SweepView& view, const Items<ContactIncidence>& items, ForceAndBlockOf<Pack>& sum) {
  using Incidence = ContactIncidence;
  Vector<Pack> x[4];
  for (int s = 0; s < 4; ++s) x[s] = items.each_vector([&](const Incidence& i) { return view.read(i.index[s]); });
  const Weights weights = packed::weights(items, x);
  const Pack* w = weights.slot;
  const Vector<Pack> separation = w[1] * (x[1] - x[0]) + w[2] * (x[2] - x[0]) + w[3] * (x[3] - x[0]);
  const Pack squared = dot(separation, separation), distance = root(squared), weight = own_weight(items, weights), radius = view.radius;
  const PackMask acts = items.counted && !(squared < 0x1p-126F) && distance < radius && (weight > 0.0F || weight < 0.0F);
  if (is_false(acts)) return;
  const Vector<Pack> normal = (1.0F / distance) * separation;
  const Pack least = 0x1p-23F * radius, d = select(distance > least, distance, least);
  const Pack k = items.each([](const Incidence& i) { return i.stiffness; });
  const PackMask near = d < 0.5F * radius;
  const Pack logarithmic = 0.25F * k * radius * radius / d;
  const Pack slope = select(near, -logarithmic, -k * (radius - d)), curvature = select(near, logarithmic / d, k);
  ForceAndBlockOf<Pack> term;
  term.add_force(-slope * weight, normal);
  term.add_outer(curvature * (weight * weight), normal);
  add_slip(view, items, weights, x, normal, weight, -slope, term);
  sum += select(acts, term, ForceAndBlockOf<Pack>{});
}

}  // namespace ogc::fast::packed
