// Computes the gaps of a node's four children at once. g++ would not vectorise a loop over the children, and a whole
// detection would take twice as long. The operations and the bits are the same as in a loop.
#pragma once

#include <array>
#include <bit>

#include "fast/cpu/pack.hpp"
#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// Returns squared_gap of each child, with the same bits. A child without a box is infinitely far away.
inline QuadGaps squared_gaps(const Quad& quad, const Box& box, float limit) {
  const Pack box_lower(Pack::Numbers{box.lower.x, box.lower.y, box.lower.z, 0}),
      box_upper(Pack::Numbers{box.upper.x, box.upper.y, box.upper.z, 0});
  // Lanes 0 … 2 get the gaps along the axes. Lane 3 gets max(child's reach, −f). The float f has the bits of the
  // primitive's index, so −f is at most 0 or NaN, and lane 3 gets the reach.
  Pack of[4];
  for (int k = 0; k < 4; ++k) {
    const auto [lower, upper] = std::bit_cast<std::array<Pack::Numbers, 2>>(quad.child[k]);
    of[k] = larger(larger(Pack(lower) - box_upper, box_lower - Pack(upper)), Pack{});
  }
  const Columns gap = transposed(of[0], of[1], of[2], of[3]);
  const Pack all = gap.x * gap.x + gap.y * gap.y + gap.z * gap.z;
  QuadGaps gaps{{}, true_lanes(all <= larger(Pack(limit), gap.w))};
  all.store(gaps.child);
  return gaps;
}

}  // namespace ogc::fast
