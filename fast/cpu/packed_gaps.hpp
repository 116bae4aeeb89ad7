// The gaps of a node's four children at once: g++ leaves a loop over them scalar, which doubles the time of a whole
// detection. Same operations, same bits.
#pragma once

#include <array>
#include <bit>

#include "fast/cpu/pack.hpp"
#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// The bits of the squared_gap of each child; a child without a box is infinitely far.
inline QuadGaps squared_gaps(const Quad& quad, const Box& box, float limit) {
  const Pack box_lower(Pack::Numbers{box.lower.x, box.lower.y, box.lower.z, 0}),
      box_upper(Pack::Numbers{box.upper.x, box.upper.y, box.upper.z, 0});
  // gaps along the axes, and the reach: the other number there is 0 minus the bits of a primitive's, which is not above
  // it or no number
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
