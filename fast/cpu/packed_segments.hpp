// Segments of a colour, a pack of them at a time: the usual case of UpdateSegment by lane, with both sides of a branch
// computed and one selected, so that the same bits come out (tests/fast/cpu/packed_segments.cpp). Segments in any other
// case, and all of rods that damp, are updated one by one.
#pragma once

#include <bit>

#include "fast/cpu/pack.hpp"
#include "fast/kernels/sweep/update_segment.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// As many quaternions as P is wide, each of which is read whole.
template <class P>
[[gnu::always_inline]] inline QuatOf<P> transposed_quats(const Quat* const* at) {
  const auto column = [at](int k) {  // quaternions k, k + 4, …
    const auto whole = [at](int i) { return Pack(std::bit_cast<Pack::Numbers>(*at[i])); };
    if constexpr (P::width == 4)
      return whole(k);
    else
      return halves(whole(k), whole(k + 4));
  };
  const auto all = transposed(column(0), column(1), column(2), column(3));
  return {all.x, all.y, all.z, all.w};
}

/// secular_root by lane: a lane that has arrived stays.
template <class P>
P secular_roots(P upper, P lower, P sigma) {
  constexpr int most_steps = 32;
  constexpr float enough = 0x3p-23f;
  const P twice = 2.0f * sigma;
  P nu = select(upper > lower - twice, upper, lower - twice);
  for (int step = 0; step < most_steps; ++step) {
    const P from_upper = upper / nu, from_lower = lower / (nu + twice);
    const P squared = from_upper * from_upper + from_lower * from_lower, beyond = root(squared) - 1.0f;
    const typename P::Mask goes_on = beyond > enough;
    if (is_false(goes_on)) break;
    nu = select(goes_on,
                nu + squared * beyond / (from_upper * from_upper / nu + from_lower * from_lower / (nu + twice)), nu);
  }
  return nu;
}

/// The last case of rod_orientation by lane. `usual`: lanes where it is that one.
template <class P>
QuatOf<P> orientations(P stretch, const Vector<P>& apart, const Vector<P>& direction, const QuatOf<P>& b,
                       typename P::Mask& usual) {
  const P length = root(dot(apart, apart)), size = root(dot(direction, direction));
  const P sigma = 2.0f * stretch * length * size, pull = root(dot(b, b));
  const ReflectedFrameOf<P> frame{pure(P(1.0f / length) * apart), pure(P(1.0f / size) * direction)};
  const QuatOf<P> upper = frame.upper(b), lower = b - upper;
  const P beta_upper = root(dot(upper, upper)), beta_lower = root(dot(lower, lower));
  usual = sigma > 0.0f && pull > 0.0f && beta_upper > lost_part * pull;
  const P nu = secular_roots(beta_upper, beta_lower, sigma);
  return unit(P(1.0f / nu) * upper + P(1.0f / (nu + 2.0f * sigma)) * lower);
}

/// Adds what the neighbours at one side of each ask for, undamped.
template <class P>
void add_neighbours(const UpdateSegment& f, const SegmentSlot* slots, int side, const QuatOf<P>& old, QuatOf<P>& b) {
  const Quat *now[P::width], *rest[P::width];
  for (int k = 0; k < P::width; ++k) {
    now[k] = &f.view.rods.orientation[slots[k].neighbours.number[side]];
    rest[k] = &slots[k].neighbours.rest[side].rest;
  }
  const P weight = P::of_each([&](int k) { return slots[k].neighbours.rest[side].weight; });
  const QuatOf<P> with =
      b + pull_towards(weight, asked_orientation(side == 1, transposed_quats<P>(now), transposed_quats<P>(rest)), old);
  const typename P::Mask is_there = weight > 0.0f;
  b = {select(is_there, with.x, b.x), select(is_there, with.y, b.y), select(is_there, with.z, b.z),
       select(is_there, with.w, b.w)};
}

/// P::width segments from number `first` of the colour on.
template <class P>
void update_pack(const UpdateSegment& f, int first) {
  const SweepView& view = f.view;
  const SegmentSlot* slots = view.rods.slots + f.first_slot + first;
  const PaddedVec* end[2][P::width];
  const Quat* was[P::width];
  for (int k = 0; k < P::width; ++k) {
    for (int side = 0; side < 2; ++side) end[side][k] = &view.old[view.number(slots[k].rest.end[side])];
    was[k] = &view.rods.orientation[slots[k].segment];
  }
  const QuatOf<P> old = transposed_quats<P>(was);
  QuatOf<P> b{0.0f, 0.0f, 0.0f, 0.0f};
  for (int side = 0; side < 2; ++side) add_neighbours<P>(f, slots, side, old, b);
  typename P::Mask usual;
  const QuatOf<P> found = orientations<P>(P::of_each([&](int k) { return slots[k].rest.stretch; }),
                                          transposed<P>(end[1]) - transposed<P>(end[0]), {0.0f, 0.0f, 1.0f}, b, usual);
  float x[P::width], y[P::width], z[P::width], w[P::width];
  found.x.store(x), found.y.store(y), found.z.store(z), found.w.store(w);
  const unsigned together = true_lanes(usual);
  for (int k = 0; k < P::width; ++k) {
    if ((together >> k & 1) != 0 && is_finite(x[k] + y[k] + z[k] + w[k]))
      view.rods.orientation[slots[k].segment] = {x[k], y[k], z[k], w[k]};
    else
      f(first + k);
  }
}

/// As UpdateSegment for segments begin … end − 1 of its colour.
[[gnu::flatten]] inline void update_segments(const UpdateSegment& f, int begin, int end) {
  if (f.view.is_off()) return;
  const RodStream& rods = f.view.rods;
  using P = WidePack;
  const bool in_packs = !rods.as_published && rods.direction == nullptr;
  for (; in_packs && begin + P::width <= end; begin += P::width) update_pack<P>(f, begin);
  for (; begin < end; ++begin) f(begin);
}

}  // namespace packed
}  // namespace OGC_PACKS
}  // namespace ogc::fast
