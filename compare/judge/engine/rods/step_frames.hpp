// Judges the frames of segments in a step: at the start, after the guess loop, at the end.
#pragma once

#include <string>
#include <vector>

#include "compare/stages/initial_guess.hpp"
#include "compare/stages/step.hpp"

namespace ogc::compare {

/// Turned frames as a case of stage initial_guess: the question, and the contestant's frames.
struct TurnedFrames {
  InitialGuessIn in;    ///< only `turns`
  InitialGuessOut out;  ///< only `orientation`
};

/// Returns what is wrong with the colours of segments; empty if nothing is wrong.
std::string wrong_segment_colour(const Scene& scene, const StepOut& out);

/// Checks that each list of orientations, also in sweeps, has one entry for each segment. Returns what is wrong; empty
/// if nothing is.
std::string wrong_orientation_count(const Scene& scene, const StepOut& out);

/// Returns the segments whose frames must rotate at the start, from the rest direction to the direction at the start. A
/// frame rotates if the scene has no orientations and these directions differ. Any other segment must start with the
/// scene's frame or, if the scene has none, with the frame of the answer's rest state. `wrong` names a segment that
/// does not.
TurnedFrames start_frames(const StepIn& in, const StepOut& out, std::string& wrong);

/// Returns the segments whose frames must rotate with their directions in the guess loop, which ended at x. These are
/// free segments if the setting rod_start is `turned`, and prescribed segments if their motion does not define a
/// rotation. If another segment has a wrong frame, `wrong` names it.
TurnedFrames turned_frames(const StepIn& in, const StepOut& out, const std::vector<Vec3f>& x, std::string& wrong);

}  // namespace ogc::compare
