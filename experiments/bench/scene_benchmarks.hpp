// Measures whole steps of scenes and parts of steps on the resident simulation, so that times include no transfer and
// no setup. One repetition is a window of steps from a fixed state. Times are those of steps.csv (CPU: steady clock,
// CUDA: device events). A part is measured with a synchronisation before and after it (`--profile`). On a device these
// times are therefore upper bounds, and their sum exceeds the time of a step.
//
//   step/twist/small/cuda    part/sweep/twist/small/cuda    step/twist@1200/cuda (from a state)
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Registers all scene benchmarks with Google Benchmark. A scene is generated when its benchmark runs.
void register_scene_benchmarks(const BenchOptions& options);

}  // namespace ogc::experiments
