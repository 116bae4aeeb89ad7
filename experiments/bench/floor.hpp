// Computes floors. A floor is the least time in which a machine can do counted work, if it may do the work in any
// order. Only machines with measured limits have floors.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "fast/contestant.hpp"

namespace ogc::experiments {

/// Holds the limits of a device, from which the floors of a step are computed.
struct MachineLimits {
  double flop_per_second = 0;               ///< floating-point operations per second in single precision
  double warp_instructions_per_second = 0;  ///< if every scheduler issues one in each cycle
  /// `cache_bytes`: largest amount of data that the device's cache can hold
  double cache_bytes = 0, cache_bytes_per_second = 0, memory_bytes_per_second = 0;
  double seconds_between_launches = 0;  ///< from the end of one kernel of a CUDA graph to the start of the next

  /// Returns the rate [B/s] of reads of data that are read again after `bytes` have moved.
  double bytes_per_second(double bytes) const {
    return bytes <= cache_bytes ? cache_bytes_per_second : memory_bytes_per_second;
  }
};

/// Returns the limits of an H200: 132 multiprocessors × 4 schedulers × 1.98 GHz, and 32 fused multiply-adds in an
/// instruction. The bandwidths and the shortest gap between two kernels of a CUDA graph are from fast/PERFORMANCE.md.
inline std::optional<MachineLimits> limits_of(const std::string& device) {
  if (device.find("H200") == std::string::npos) return std::nullopt;
  constexpr double issued = 132 * 4 * 1.98e9;
  return MachineLimits{issued * 32 * 2, issued, 40e6, 7.1e12, 4.4e12, 0.43e-6};
}

/// The work of one iteration of the sweep, contacts included (fast::SweepWork).
struct IterationWork {
  double warp_instructions = 0, bytes = 0, sector_bytes = 0;
  int launches = 0;

  IterationWork& operator+=(const IterationWork& other) {
    warp_instructions += other.warp_instructions, bytes += other.bytes, sector_bytes += other.sector_bytes;
    launches += other.launches;
    return *this;
  }
  /// Returns the work of so many iterations, without launches.
  friend IterationWork operator*(double count, const IterationWork& work) {
    return {count * work.warp_instructions, count * work.bytes, count * work.sector_bytes};
  }
};

/// Returns the work of an iteration with the contacts of a step.
inline IterationWork iteration_work(const compare::StepMetrics& row, const fast::SweepWork& work) {
  const auto vertex_facet = static_cast<double>(row.vertex_facet_contacts),
             edge_edge = static_cast<double>(row.edge_edge_contacts),
             contact_bytes = (vertex_facet + edge_edge) * work.bytes_contact;
  return {work.warp_instructions + vertex_facet * work.warp_instructions_vertex_facet +
              edge_edge * work.warp_instructions_edge_edge,
          work.bytes + contact_bytes, work.sector_bytes + contact_bytes, work.launches};
}

/// Returns the floor of one iteration of the sweep [s] as its teams and colours compute it: the time for its warp
/// instructions or for its sectors, whichever is longer, plus one gap between kernels per launch. The first read of a
/// sector finds it in the cache if the cache holds all data of an iteration. A read by a later colour finds it there if
/// the cache holds what one colour moves.
inline double sweep_floor(const MachineLimits& machine, const IterationWork& work) {
  const double again = work.sector_bytes - work.bytes,
               moved = work.bytes / machine.bytes_per_second(work.bytes) +
                       again / machine.bytes_per_second(work.sector_bytes / work.launches);
  return std::max(work.warp_instructions / machine.warp_instructions_per_second, moved) +
         work.launches * machine.seconds_between_launches;
}

/// Returns the floor of the sweeps of worlds whose `work` is added up [s]: its instructions, or its bytes from the
/// cache. No launch separates the colours of a world.
inline double worlds_floor(const MachineLimits& machine, const IterationWork& work) {
  return std::max(work.warp_instructions / machine.warp_instructions_per_second,
                  work.bytes / machine.cache_bytes_per_second);
}

/// Returns the floor of the searches of one detection [s]: the larger of the times for their arithmetic and their
/// bytes. Assumes that the cache holds all bytes, and counts double precision as single precision, although it takes
/// twice as long.
inline double search_floor(const MachineLimits& machine, const fast::SearchWork& work) {
  return std::max(work.flop / machine.flop_per_second, work.bytes / machine.cache_bytes_per_second);
}

}  // namespace ogc::experiments
