// Stage step: Algorithm 3 (method.md §5.2). Computes what follows from an answer's own positions and counts.
#pragma once

#include <functional>

#include "compare/stages/step.hpp"
#include "reference/solvers/step_order.hpp"

namespace ogc::reference {

/// Counts prescribed vertices at x that bounds keep behind their targets; none if bounds are not planes. `stays`, by
/// vertex (empty: none): whether a contact keeps the vertex in a round of the guess loop; it then triggers no
/// detection.
StepLag lag_of(const std::vector<compare::Vec3f>& x, const std::vector<compare::Vec3f>& previous,
               const std::vector<compare::Vec3f>& target, const std::vector<compare::Index>& groups,
               const compare::Settings& settings, const std::vector<bool>& stays = {});

/// Tells whether a vertex lies deep inside a volume; doubtful if single-precision rounding decides.
enum class Depth { shallow, doubtful, deep };
/// Returns the depth of the deepest contact at x, from the frozen numbers of its detection: deep means φ < −r/2. Skips
/// contacts with indices that the mesh lacks.
Depth depth_of(const std::vector<compare::VolumeContact>& contacts, const compare::Topology& topology,
               const std::vector<compare::Vec3f>& x, double contact_radius);

/// Computes r_q, prescribed targets, the order of events, moves of the guess loop, velocities. The answer's target,
/// position and velocity must have one entry for each vertex; its events may be any.
compare::StepTruth step(const compare::StepIn& in, const compare::StepOut& answer);

}  // namespace ogc::reference
