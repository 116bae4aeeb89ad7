// What a step is asked about the frames of segments: at its start, after the guess loop, at its end.
#pragma once

#include <string>
#include <vector>

#include "compare/stages/initial_guess.hpp"
#include "compare/stages/step.hpp"

namespace ogc::compare {

/// Frames as stage initial_guess judges them: what is asked, and the answer's.
struct TurnedFrames {
  InitialGuessIn in;    ///< turns alone
  InitialGuessOut out;  ///< orientations alone
};

/// What is wrong with the colours of segments; empty where nothing is.
std::string wrong_segment_colour(const Scene& scene, const StepOut& out);

/// Whether each list of orientations has one entry a segment, those of sweeps included; what is wrong, or nothing.
std::string wrong_orientation_count(const Scene& scene, const StepOut& out);

/// The frames that the step starts with: the scene's, or those of the answer's rest state, turned to where segments
/// start. What is wrong of those that are given goes into `wrong`.
TurnedFrames start_frames(const StepIn& in, const StepOut& out, std::string& wrong);

/// The frames after the guess loop, which ended at x, of free segments and of those that a motion carries which does
/// not say how it turns. What is wrong of others goes into `wrong`.
TurnedFrames turned_frames(const StepIn& in, const StepOut& out, const std::vector<Vec3f>& x, std::string& wrong);

}  // namespace ogc::compare
