// Measures single stages through the calls that the judge makes. Stages of pairs and stencils get a batch of generic
// cases; stages of meshes get `cloth_on_sphere` at the scale smoke, small or paper. On a device a call includes the
// transfers of inputs and outputs, which a step does not have; part/… benchmarks measure a kernel inside a step.
//
//   stage/closest_face/cpu    stage/detect_edge_edge/small/cuda
#pragma once

#include "experiments/bench/options.hpp"

namespace ogc::experiments {

/// Registers all stages of the selected backends with Google Benchmark. Cases are generated when a stage is measured.
void register_stage_benchmarks(const BenchOptions& options);

}  // namespace ogc::experiments
