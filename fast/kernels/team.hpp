// The sum of a team of lanes, run by one thread. Item k belongs to lane k mod W and the lanes are added by a fixed tree, so a team of any size, on any
// backend, that keeps this rule gives the same bits; only W can change one.
#pragma once

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

/// W lanes in turn. `Accumulator` is value-initialised to its zero and has `+=`.
template <int W>
struct SerialTeam {
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;

  /// Σ over 0 ≤ k < count, where item(k, acc) adds the k-th term to acc. Every lane of the team gets the total.
  template <class Accumulator, class Item>
  OGC_HD Accumulator sum(int count, Item item) const {
    Accumulator lanes[W] = {};
    for (int k = 0; k < count; ++k) item(k, lanes[k & (W - 1)]);
    for (int s = W / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) lanes[l] += lanes[l + s];
    }
    return lanes[0];
  }

  /// Whether this lane writes the team's result.
  OGC_HD bool leader() const { return true; }
};

}  // namespace ogc::fast
