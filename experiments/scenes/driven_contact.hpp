// The two ways to treat a body that a motion drives, or one of tetrahedra: as a surface, inside the guarantee, or as a
// volume (§3.9).
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Numbers of the bodies of triangles all of whose vertices a motion moves.
std::vector<std::size_t> driven_bodies(const compare::Scene& scene);

/// What those, and bodies of tetrahedra, are to others from now on. With driven ones goes γ_e: 0.01, the paper's, where
/// they push out; 0 where they obey bounds, so that the few vertices between them and a garment ask for a detection
/// each (experiments/scenes/dress.hpp). Throws compare::InputError where there is no such body.
void set_body_contact(compare::Scene& scene, compare::BodyContact contact);

}  // namespace ogc::experiments
