// Computes the least time that a machine needs for counted work: no order of work is faster. Only machines whose limits
// were measured have one.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "fast/contestant.hpp"

namespace ogc::experiments {

/// Limits of a device, for the floors of a step.
struct MachineLimits {
  double flop_per_second = 0;  ///< in single precision
  /// `cache_bytes`: most bytes that stay in the cache of the device
  double cache_bytes = 0, cache_bytes_per_second = 0, memory_bytes_per_second = 0;
  double seconds_between_colours = 0;  ///< from the end of a kernel in a graph to the start of the next
};

/// Returns the limits of an H200: 132 multiprocessors × 128 fused multiply-adds × 1.98 GHz; bandwidths and the shortest
/// edge of a graph from fast/PERFORMANCE.md.
inline std::optional<MachineLimits> limits_of(const std::string& device) {
  if (device.find("H200") == std::string::npos) return std::nullopt;
  return MachineLimits{132 * 128 * 2 * 1.98e9, 40e6, 7.1e12, 4.4e12, 0.43e-6};
}

/// Returns the floor of one iteration of the sweep [s]: the time of its arithmetic or of its bytes, whichever is
/// larger, and an edge of the graph for each colour.
inline double sweep_floor(const MachineLimits& machine, const fast::SweepWork& work, double flop, double bytes) {
  const double rate = bytes <= machine.cache_bytes ? machine.cache_bytes_per_second : machine.memory_bytes_per_second;
  return std::max(flop / machine.flop_per_second, bytes / rate) + work.colours * machine.seconds_between_colours;
}

/// Returns the floor of the searches of one detection [s]: the time of their arithmetic or of their bytes, all from the
/// cache, whichever is larger. Double precision, which takes twice as long, counts as single.
inline double search_floor(const MachineLimits& machine, const fast::SearchWork& work) {
  return std::max(work.flop / machine.flop_per_second, work.bytes / machine.cache_bytes_per_second);
}

}  // namespace ogc::experiments
