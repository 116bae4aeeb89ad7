// The gaps of a node's four lanes at once: g++ leaves a loop over them scalar, which doubles the time of a whole detection. Same operations, same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {

/// Four lanes of one register.
using Four __attribute__((vector_size(16))) = float;

#if defined(__SSE2__)

inline Four larger(Four a, Four b) { return _mm_max_ps(b, a); }
inline unsigned not_above(Four a, Four b) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a, b))); }

#else

inline Four larger(Four a, Four b) { return a < b ? b : a; }
/// A bit for each lane.
inline unsigned not_above(Four a, Four b) {
  const auto bits = (a <= b) & decltype(a <= b){1, 2, 4, 8};
  return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
}

#endif

/// Half a lane: the lower corner and the reach, or the upper corner and the primitive.
inline Four half(const Lane& lane, std::size_t which) {
  Four four;
  __builtin_memcpy(&four, reinterpret_cast<const char*>(&lane) + which * sizeof four, sizeof four);
  return four;
}

inline QuadGaps squared_gaps(const Quad& quad, const Box& box, float limit) {
  using Bits __attribute__((vector_size(16))) = std::int32_t;
  const Four box_lower{box.lower.x, box.lower.y, box.lower.z, 0}, box_upper{box.upper.x, box.upper.y, box.upper.z, 0};
  Four of[4];  // gaps along the axes, and the reach: the other number there is 0 minus the bits of a primitive's, which is not above it or no number
  for (int k = 0; k < 4; ++k) of[k] = larger(larger(half(quad.lane[k], 0) - box_upper, box_lower - half(quad.lane[k], 1)), Four{});
  const Four xy_01 = __builtin_shuffle(of[0], of[1], Bits{0, 4, 1, 5}), xy_23 = __builtin_shuffle(of[2], of[3], Bits{0, 4, 1, 5});
  const Four zr_01 = __builtin_shuffle(of[0], of[1], Bits{2, 6, 3, 7}), zr_23 = __builtin_shuffle(of[2], of[3], Bits{2, 6, 3, 7});
  const Four x = __builtin_shuffle(xy_01, xy_23, Bits{0, 1, 4, 5}), y = __builtin_shuffle(xy_01, xy_23, Bits{2, 3, 6, 7});
  const Four z = __builtin_shuffle(zr_01, zr_23, Bits{0, 1, 4, 5}), reach = __builtin_shuffle(zr_01, zr_23, Bits{2, 3, 6, 7});
  const Four all = x * x + y * y + z * z;
  QuadGaps gaps{{}, not_above(all, larger(Four{} + limit, reach))};
  __builtin_memcpy(gaps.lane, &all, sizeof all);
  return gaps;
}

}  // namespace ogc::fast
