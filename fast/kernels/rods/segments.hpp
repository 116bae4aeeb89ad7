// Holds segments of rods as the kernels read them: rest data, and their streams in the order of the sweep. A scene
// without rods has none of it.
#pragma once

#include "fast/kernels/models/orientation.hpp"
#include "fast/kernels/models/rod.hpp"

namespace ogc::fast {

/// What holds a segment: nothing, its fixed body, or (from 0 on) the motion of both of its ends.
inline constexpr int segment_free = -1, segment_fixed = -2;

/// The neighbours of a segment across its ends.
struct alignas(16) SegmentNeighbours {
  NeighbourRest rest[2];   ///< behind, ahead; weight 0: there is none
  int number[2] = {0, 0};  ///< segment numbers; its own if there is no neighbour
};

/// A free segment in the order of the sweep. Ends are encoded as in fast/kernels/sweep_view.hpp: prescribed and fixed
/// ends are read at their new positions, free ones at their old ones.
struct alignas(16) SegmentSlot {
  SegmentRest rest{};
  int segment = -1;  ///< its number
  SegmentNeighbours neighbours{};
};

/// A segment seen from one of its ends.
struct alignas(16) RodIncidence {
  int other = 0;                  ///< the other end, encoded
  int segment = 0;                ///< its number; ~number if the vertex is x₁
  float length = 0, stretch = 0;  ///< l [m], k_s [N]
};

}  // namespace ogc::fast
