// Selects the kind of contact of driven bodies and of bodies of tetrahedra. Each is either a surface, which the
// guarantee covers, or a volume (§3.9).
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns the indices of the driven bodies: bodies of triangles whose vertices all have a prescribed motion.
std::vector<std::size_t> driven_bodies(const compare::Scene& scene);

/// Sets the kind of contact of driven bodies and of bodies with tetrahedra. If there are driven bodies, also sets γ_e.
/// For volumes γ_e is the paper's 0.01. For surfaces γ_e is 0, so that one cut vertex triggers a detection: a driven
/// surface obeys bounds, and only few vertices lie between it and a garment (experiments/scenes/dress.hpp). Throws
/// compare::InputError if the scene has no driven body and no body with tetrahedra.
void set_body_contact(compare::Scene& scene, compare::BodyContact contact);

}  // namespace ogc::experiments
