// Measures stages one by one, through the very calls that the judge makes: a batch of its generic cases for stages of
// pairs and stencils, `cloth_on_sphere` at the scale smoke, small or paper for stages of meshes. On a device a call
// includes the transfers of question and answer, which a step never has; the parts of steps measure a kernel inside a
// step.
//
//   stage/closest_face/cpu    stage/detect_edge_edge/small/cuda
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Registers all stages that a backend has with Google Benchmark; cases are made when a stage is measured.
void register_stage_benchmarks(const BenchOptions& options);

}  // namespace ogc::experiments
