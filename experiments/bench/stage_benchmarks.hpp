// Stages one by one, through the very calls that the judge makes: a batch of its generic cases for stages of pairs and
// stencils, the smoke, small or paper `cloth_on_sphere` for stages of meshes. On a device a call holds the transfers of
// question and answer, which a step never has: for the time of a kernel inside a step see the parts of steps.
//
//   stage/closest_face/cpu    stage/detect_edge_edge/small/cuda
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Hands all stages that a backend has to Google Benchmark; cases are made when a stage is measured.
void register_stage_benchmarks(const BenchOptions& options);

}  // namespace ogc::experiments
