// Stage step: Algorithm 3 (method.md §5.2). Takes the positions and counts of an answer as given, and computes from
// them the right values of everything else in the answer.
#pragma once

#include <functional>

#include "compare/stages/step.hpp"
#include "reference/solvers/step_order.hpp"

namespace ogc::reference {

/// Counts the prescribed vertices that bounds keep behind their targets at x; zero if bounds are not planes. `stays`
/// tells for each vertex whether a contact keeps it in place in a round of the guess loop; it is empty if contacts keep
/// no vertex in place. A vertex that a contact keeps at `previous` is not counted, because it triggers no detection.
StepLag lag_of(const std::vector<compare::Vec3f>& x, const std::vector<compare::Vec3f>& previous,
               const std::vector<compare::Vec3f>& target, const std::vector<compare::Index>& groups,
               const compare::Settings& settings, const std::vector<bool>& stays = {});

/// Whether a vertex is deep inside a volume; doubtful if single-precision rounding decides.
enum class Depth { shallow, doubtful, deep };
/// Returns the depth of the deepest contact at x; deep means φ < −r/2. φ is computed with the frozen n and weights of
/// the detection. Skips contacts with indices that the mesh lacks.
Depth depth_of(const std::vector<compare::VolumeContact>& contacts, const compare::Topology& topology,
               const std::vector<compare::Vec3f>& x, double contact_radius);

/// Computes the truth about an answer: r_q, prescribed targets, the order of events, moves of the guess loop, and
/// velocities. The answer's target, position and velocity must have one entry for each vertex; its events may be
/// arbitrary.
compare::StepTruth step(const compare::StepIn& in, const compare::StepOut& answer);

}  // namespace ogc::reference
