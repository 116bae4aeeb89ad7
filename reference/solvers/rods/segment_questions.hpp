// Converts the segments of a sweep to questions for the stages orientation and rod.
#pragma once

#include "compare/stages/sweep.hpp"

namespace ogc::reference {

/// Returns the question for the segment's quaternion. Neighbours of lower colour and prescribed vertices come from the
/// answer, all others from the state before the sweep.
compare::OrientationCase orientation_question(const compare::SweepIn& in, const compare::SweepOut& answer,
                                              std::size_t segment);

/// Returns the question for the force on the segment's end `end`; `ends` are the positions of both ends. The quaternion
/// comes from the answer.
compare::RodCase rod_question(const compare::SweepIn& in, const compare::SweepOut& answer, std::size_t segment,
                              std::size_t end, const std::array<compare::Vec3f, 2>& ends);

/// Fills `free_segments` and `orientation` of the truth about the answer.
void add_orientations(const compare::SweepIn& in, const compare::SweepOut& answer, compare::SweepTruth& truth);

/// Sets the reference's quaternions in `out`, colour by colour. The prescribed vertices of `out` must already have
/// moved.
void set_orientations(const compare::SweepIn& in, compare::SweepOut& out);

}  // namespace ogc::reference
