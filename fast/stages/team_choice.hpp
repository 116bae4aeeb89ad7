// Decides which launches run CompactTeams (fast/cuda/team.cuh). The CUDA backend asks when it launches, and
// fast/work.cpp when it counts the lanes of an update.
#pragma once

namespace ogc::fast {

inline constexpr int serial_block_size = 128;  ///< threads of a block with SerialLaneTeams or CompactTeams

/// Blocks of CompactTeams that a multiprocessor runs at once. This limits a thread to 80 registers, which is faster if
/// a launch has several times as many blocks, and slower otherwise (measured: fast/PERFORMANCE.md).
inline constexpr int compact_blocks = 6;

/// Returns whether CompactTeams exist for a width and a sum: for eight lanes and four parts, such as those of surfaces.
/// More kernels would only take time to compile.
constexpr bool can_be_compact(int lanes, int parts) { return lanes == 8 && parts == 4; }

/// Returns whether a launch of `blocks` blocks has more than two waves of CompactTeams, so that they are faster.
constexpr bool has_waves_of_compact(int blocks, int multiprocessors) {
  return blocks > 2 * compact_blocks * multiprocessors;
}

}  // namespace ogc::fast
