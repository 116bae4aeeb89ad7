// What the stages share whose questions are about a mesh alone: the two detections and bound.
#pragma once

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/engine/tally.hpp"
#include "compare/judge/engine/topology_json.hpp"
#include "compare/stages/detect.hpp"

namespace ogc::compare {

/// One value: never above the exact one, never negative, and not uselessly far below.
void judge_smallest(const char* what, std::size_t i, float value, float exact, double scale, std::size_t metric,
                    Tally& tally);

/// Whether an array has so many entries; where not, a mismatch.
bool right_length(std::size_t length, std::size_t wanted, const char* what, Tally& tally);

/// The question that a state asks of both detections; a view of the case.
DetectIn detect_question(const MeshCase& c);

/// A state of a scene as it starts, with r_q at its cap.
MeshCase case_at_start(const Scene& scene);

/// Writer and reader of a saved state.
Json mesh_case_to_json(const MeshCase& c);
MeshCase to_mesh_case(const Json& data);

}  // namespace ogc::compare
