// Holds the segments of rods as the kernels read them: rest data, and streams in the order of the sweep. All are empty
// in a scene without rods.
#pragma once

#include "fast/kernels/models/orientation.hpp"
#include "fast/kernels/models/rod.hpp"

namespace ogc::fast {

/// Motion of a segment: free, fixed with its body, or (from 0 on) the number of the motion of both ends.
inline constexpr int segment_free = -1, segment_fixed = -2;

/// Neighbours of a segment across its ends.
struct alignas(16) SegmentNeighbours {
  NeighbourRest rest[2];   ///< behind, ahead; weight 0: no neighbour
  int number[2] = {0, 0};  ///< numbers of these segments; its own number if there is no neighbour
};

/// A free segment in the order of the sweep. Ends are encoded as in fast/kernels/sweep_view.hpp: prescribed and fixed
/// ends are read at their new positions, free ones at their old ones.
struct alignas(16) SegmentSlot {
  SegmentRest rest{};
  int segment = -1;
  SegmentNeighbours neighbours{};
};

/// A segment as one of its ends sees it.
struct alignas(16) RodIncidence {
  int other = 0;                  ///< the other end, encoded
  int segment = 0;                ///< number; ~number if the vertex is x₁
  float length = 0, stretch = 0;  ///< l [m], k_s [N]
};

}  // namespace ogc::fast
