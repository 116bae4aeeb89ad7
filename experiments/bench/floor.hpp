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
  double flop_per_second = 0;  ///< floating-point operations per second in single precision
  /// `cache_bytes`: largest amount of data that the device's cache can hold
  double cache_bytes = 0, cache_bytes_per_second = 0, memory_bytes_per_second = 0;
  double seconds_between_colours = 0;  ///< from the end of one kernel of a CUDA graph to the start of the next
};

/// Returns the limits of an H200: 132 multiprocessors × 128 fused multiply-adds × 1.98 GHz. The bandwidths and the
/// shortest gap between two kernels of a CUDA graph are from fast/PERFORMANCE.md.
inline std::optional<MachineLimits> limits_of(const std::string& device) {
  if (device.find("H200") == std::string::npos) return std::nullopt;
  return MachineLimits{132 * 128 * 2 * 1.98e9, 40e6, 7.1e12, 4.4e12, 0.43e-6};
}

/// Returns the floor of one iteration of the sweep [s]. It is the time for the arithmetic or the time for the bytes,
/// whichever is larger, plus one gap between kernels for each colour.
inline double sweep_floor(const MachineLimits& machine, const fast::SweepWork& work, double flop, double bytes) {
  const double rate = bytes <= machine.cache_bytes ? machine.cache_bytes_per_second : machine.memory_bytes_per_second;
  return std::max(flop / machine.flop_per_second, bytes / rate) + work.colours * machine.seconds_between_colours;
}

/// Returns the floor of the searches of one detection [s]: the larger of the times for their arithmetic and their
/// bytes. Assumes that the cache holds all bytes, and counts double precision as single precision, although it takes
/// twice as long.
inline double search_floor(const MachineLimits& machine, const fast::SearchWork& work) {
  return std::max(work.flop / machine.flop_per_second, work.bytes / machine.cache_bytes_per_second);
}

}  // namespace ogc::experiments
