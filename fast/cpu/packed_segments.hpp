// Updates the segments of a colour, a pack at a time, with the same bits as single updates
// (tests/fast/cpu/packed_segments.cpp). Packs compute the usual case of UpdateSegment. All other segments, and all
// segments of rods with damping, are updated one by one.
#pragma once

#include <bit>

#include "fast/cpu/pack.hpp"
#include "fast/kernels/sweep/update_segment.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// Returns P::width quaternions; each is read as a whole.
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

/// Adds to b the undamped terms of the segments' neighbours. side: 0 for the neighbour at each segment's begin, 1 for
/// the neighbour at its end.
template <class P>
void add_neighbours(const UpdateSegment& f, const SegmentSlot* slots, int side, const QuatOf<P>& old, QuatOf<P>& b) {
  const Quat *now[P::width], *rest[P::width];
  for (int k = 0; k < P::width; ++k) {
    now[k] = &f.view.rods.orientation[slots[k].neighbours.number[side]];
    rest[k] = &slots[k].neighbours.rest[side].rest;
  }
  const P weight = P::of_each([&](int k) { return slots[k].neighbours.rest[side].weight; });
  add_undamped_neighbour(weight, side == 1, transposed_quats<P>(now), transposed_quats<P>(rest), old, b);
}

/// Updates the P::width segments of the colour from number `first` on.
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
  const QuatOf<P> found = usual_orientation<P>(P::of_each([&](int k) { return slots[k].rest.stretch; }),
                                               transposed<P>(end[1]) - transposed<P>(end[0]), {0.0f, 0.0f, 1.0f}, b,
                                               usual);
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

/// Updates segments begin … end − 1 of a colour as UpdateSegment does: in packs where possible, the others one by one.
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
