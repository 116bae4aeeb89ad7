// Measures worlds that run side by side. One repetition is a window of steps of all worlds from their starts. A time is
// the wall time of a step of all worlds, what the host does included; the counter device_ms is the device's part.
//
//   worlds/256/cloth_on_sphere/smoke/cuda
//   worlds/1024/small_cloth/cuda          1,024 cloths of 81 vertices, each above a floor of 25 vertices of its own
//   step/small_cloths/1024/cuda           the same cloths in one scene, 20 cm apart (scene_benchmarks.hpp)
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Registers the benchmarks of options.worlds worlds with Google Benchmark; none if that is 0.
void register_worlds_benchmarks(const BenchOptions& options);

/// Returns cloths of 9 × 9 vertices that fall askew, each on a fixed floor of 5 × 5, 20 cm apart: ten iterations a
/// step, r = 5 mm, hinges, damping, friction. `speed`: of their fall at the start [m/s].
compare::Scene small_cloths(int count, double speed);

}  // namespace ogc::experiments
