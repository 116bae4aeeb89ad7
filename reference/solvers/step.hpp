// Stage step: Algorithm 3 (method.md §5.2): computes what follows from an answer's own positions and counts.
#pragma once

#include <functional>

#include "compare/stages/step.hpp"
#include "reference/solvers/step_order.hpp"

namespace ogc::reference {

/// Counts prescribed vertices at x that bounds keep behind their targets; none where bounds are no planes. `stays`: by
/// vertex, whether a contact rather than its bound keeps it in a round of the guess loop; such a vertex triggers no
/// detection; empty: none.
StepLag lag_of(const std::vector<compare::Vec3f>& x, const std::vector<compare::Vec3f>& previous,
               const std::vector<compare::Vec3f>& target, const std::vector<compare::Index>& groups,
               const compare::Settings& settings, const std::vector<bool>& stays = {});

/// Whether a vertex lies deep inside a volume; doubtful where rounding to single precision decides.
enum class Depth { shallow, doubtful, deep };
/// Returns the depth of the deepest of these contacts at x, by the numbers that their detection froze: deep means φ <
/// −r/2. Any contacts are allowed: those with indices that the mesh lacks are skipped.
Depth depth_of(const std::vector<compare::VolumeContact>& contacts, const compare::Topology& topology,
               const std::vector<compare::Vec3f>& x, double contact_radius);

/// Computes r_q, prescribed targets, the order of events, moves of the guess loop, velocities. The answer's target,
/// position and velocity must have one entry a vertex; its events may be any.
compare::StepTruth step(const compare::StepIn& in, const compare::StepOut& answer);

}  // namespace ogc::reference
