// Judges the frames of segments in a step: at its start, after the guess loop, at its end.
#pragma once

#include <string>
#include <vector>

#include "compare/stages/initial_guess.hpp"
#include "compare/stages/step.hpp"

namespace ogc::compare {

/// Frames as stage initial_guess judges them: the question, and the answer's frames.
struct TurnedFrames {
  InitialGuessIn in;    ///< turns alone
  InitialGuessOut out;  ///< orientations alone
};

/// Says what is wrong with the colours of segments; empty where nothing is.
std::string wrong_segment_colour(const Scene& scene, const StepOut& out);

/// Checks whether each list of orientations has one entry a segment, also in sweeps; says what is wrong, or nothing.
std::string wrong_orientation_count(const Scene& scene, const StepOut& out);

/// Returns the frames with which the step starts: the scene's, or those of the answer's rest state, turned to where
/// segments start. Writes into `wrong` what is wrong with frames that are given.
TurnedFrames start_frames(const StepIn& in, const StepOut& out, std::string& wrong);

/// Returns the frames after the guess loop, which ended at x: those of free segments, and of segments that a motion
/// carries without saying how it turns. Writes into `wrong` what is wrong with others.
TurnedFrames turned_frames(const StepIn& in, const StepOut& out, const std::vector<Vec3f>& x, std::string& wrong);

}  // namespace ogc::compare
