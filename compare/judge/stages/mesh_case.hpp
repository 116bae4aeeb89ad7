// Helps the stages whose questions concern only a mesh: the two detections and bound.
#pragma once

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/engine/tally.hpp"
#include "compare/judge/engine/topology_json.hpp"
#include "compare/stages/detect.hpp"

namespace ogc::compare {

/// Judges one smallest distance or bound. `value` must be neither negative nor above `exact`. `exact` − `value`, in
/// units of `scale`, is counted as an error under `metric`.
void judge_smallest(const char* what, std::size_t i, float value, float exact, double scale, std::size_t metric,
                    Tally& tally);

/// Checks whether an array has `wanted` entries; reports a mismatch if not.
bool right_length(std::size_t length, std::size_t wanted, const char* what, Tally& tally);

/// Returns the question of a state for both detections: a view of the case.
DetectIn detect_question(const MeshCase& c);

/// Returns the state of a scene at its start, with r_q at its cap.
MeshCase case_at_start(const Scene& scene);

/// Write and read a saved state.
Json mesh_case_to_json(const MeshCase& c);
MeshCase to_mesh_case(const Json& data);

}  // namespace ogc::compare
