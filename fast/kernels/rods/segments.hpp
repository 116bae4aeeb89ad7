// Holds the segments of rods as kernels read them: rest data, and streams in the order of the sweep. All are empty in a
// scene without rods.
#pragma once

#include "fast/kernels/models/orientation.hpp"
#include "fast/kernels/models/rod.hpp"

namespace ogc::fast {

/// Values of a segment's `motion`: the segment is free, or fixed with its body. A value ≥ 0 is the index of the
/// prescribed motion of both ends of the segment.
inline constexpr int segment_free = -1, segment_fixed = -2;

/// Holds the neighbours of a segment across its ends: first the segment before it, then the segment after it.
struct alignas(16) SegmentNeighbours {
  NeighbourRest rest[2];   ///< weight 0: there is no neighbour
  int number[2] = {0, 0};  ///< indices of the neighbours; the segment's own index if there is no neighbour
};

/// A free segment in the order of the sweep. Its ends are encoded as in fast/kernels/sweep_view.hpp: prescribed and
/// fixed ends are read at their new positions, free ends at their old positions.
struct alignas(16) SegmentSlot {
  SegmentRest rest{};
  int segment = -1;
  SegmentNeighbours neighbours{};
};

/// A segment as one of its ends sees it.
struct alignas(16) RodIncidence {
  int other = 0;                  ///< the other end, encoded
  int segment = 0;                ///< index; ~index if the vertex is x₁
  float length = 0, stretch = 0;  ///< l [m], k_s [N]
};

}  // namespace ogc::fast
