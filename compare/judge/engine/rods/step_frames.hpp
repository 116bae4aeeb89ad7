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

/// Returns the frames that the step turns from rest to where their segments start. The other segments start with a
/// given frame, the scene's or that of the answer's rest state; `wrong` gets what is wrong with these.
TurnedFrames start_frames(const StepIn& in, const StepOut& out, std::string& wrong);

/// Returns the frames that the guess loop, which ended at x, turned with their segments: those of free segments, if the
/// scene's rod_start turns them, and of segments whose motion does not define a turn. `wrong` gets what is wrong with
/// all others.
TurnedFrames turned_frames(const StepIn& in, const StepOut& out, const std::vector<Vec3f>& x, std::string& wrong);

}  // namespace ogc::compare
