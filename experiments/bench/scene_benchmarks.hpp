// Measures steps of whole scenes, and their parts, on the resident simulation: no transfer and no start is inside the
// times. One repetition is a window of steps from the same state, and times are those of steps.csv (CPU: steady clock,
// CUDA: device events). Parts are measured with a synchronisation around each (`--profile`), so they are upper bounds
// and add up to more than a step on a device.
//
//   step/twist/small/cuda    part/sweep/twist/small/cuda    step/twist@1200/cuda (from a state)
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Registers all scene benchmarks with Google Benchmark; nothing is generated before it is measured.
void register_scene_benchmarks(const BenchOptions& options);

}  // namespace ogc::experiments
