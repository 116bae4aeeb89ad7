// Makes questions to the stages orientation and rod from the segments of a sweep.
#pragma once

#include "compare/stages/sweep.hpp"

namespace ogc::reference {

/// Returns the question from which the segment's quaternion is set: neighbours of lower colour and prescribed vertices
/// are read in the answer, all others where the sweep began.
compare::OrientationCase orientation_question(const compare::SweepIn& in, const compare::SweepOut& answer,
                                              std::size_t segment);

/// Returns the question for the force on the segment's end `end`, at positions of its ends; its quaternion is the
/// answer's.
compare::RodCase rod_question(const compare::SweepIn& in, const compare::SweepOut& answer, std::size_t segment,
                              std::size_t end, const std::array<compare::Vec3f, 2>& ends);

/// Fills `free_segments` and `orientation` of the truth about the answer.
void add_orientations(const compare::SweepIn& in, const compare::SweepOut& answer, compare::SweepTruth& truth);

/// Sets the reference's own quaternions in `out`, colour by colour; prescribed vertices of `out` must have moved
/// already.
void set_orientations(const compare::SweepIn& in, compare::SweepOut& out);

}  // namespace ogc::reference
