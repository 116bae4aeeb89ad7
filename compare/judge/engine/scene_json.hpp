// Writes and reads saved cases that hold a scene. The case's own file holds all of the scene, so that every bit comes
// back without a folder of meshes.
#pragma once

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/engine/numbers_json.hpp"

namespace ogc::compare {

/// Writes a rounded scene (`round_to_single`).
Json scene_to_json(const Scene& scene);
/// Reads a scene. Throws what the JSON library throws for a missing key or a wrong type, and InputError for an unknown
/// setting or model.
Scene to_scene(const Json& json);

Json sweep_case_to_json(const SweepCase& c);  ///< writes the whole scene, too
/// Reads a sweep case. Throws what to_scene throws, and InputError if an array does not have one entry for each vertex.
SweepCase to_sweep_case(const Json& json);

}  // namespace ogc::compare
