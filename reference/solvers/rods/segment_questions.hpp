// Converts the segments of a sweep to cases of the stages orientation and rod.
#pragma once

#include "compare/stages/sweep.hpp"

namespace ogc::reference {

/// Returns the case for the segment's quaternion. Prescribed vertices and neighbour segments of lower colour have the
/// values of the answer. All other vertices and segments have the values before the sweep.
compare::OrientationCase orientation_question(const compare::SweepIn& in, const compare::SweepOut& answer,
                                              std::size_t segment);

/// Returns the case for the force on the segment's end `end`; `ends` are the positions of both ends. The quaternion
/// comes from the answer.
compare::RodCase rod_question(const compare::SweepIn& in, const compare::SweepOut& answer, std::size_t segment,
                              std::size_t end, const std::array<compare::Vec3f, 2>& ends);

/// Fills `free_segments` and `orientation` of the truth about the answer.
void add_orientations(const compare::SweepIn& in, const compare::SweepOut& answer, compare::SweepTruth& truth);

/// Computes the reference's quaternions, colour by colour, and writes them to `out`. The prescribed vertices of `out`
/// must already have moved.
void set_orientations(const compare::SweepIn& in, compare::SweepOut& out);

}  // namespace ogc::reference
