// A body that a motion drives, or one of tetrahedra, is either a surface, inside the guarantee, or a volume (§3.9).
// This file selects one of the two.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns the numbers of the bodies of triangles all of whose vertices a motion moves.
std::vector<std::size_t> driven_bodies(const compare::Scene& scene);

/// Sets the kind of contact of driven bodies and of bodies with tetrahedra. With driven bodies it also sets γ_e: 0.01,
/// the paper's, for volumes; 0 for surfaces, which obey bounds, so that each of the few vertices between them and a
/// garment triggers a detection (experiments/scenes/dress.hpp). Throws compare::InputError if there is no such body.
void set_body_contact(compare::Scene& scene, compare::BodyContact contact);

}  // namespace ogc::experiments
