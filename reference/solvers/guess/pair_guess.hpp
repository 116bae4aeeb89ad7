// The guess by certificate of pairs (compare/pair_guess.md): how the reference makes one, and what is true of anyone's.
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/pair_guess.hpp"

namespace ogc::reference {

/// Passes that scale moves before vertices are cut to their balls.
inline constexpr int scaling_passes = 8;

/// What R is at most: the cap of r_q [m].
float largest_reach(const compare::Settings& settings);

/// X + w for the moves w = y − X, each scaled until no pair is unsafe; what scaling does not settle is cut to its ball.
/// Safe on the stored positions. The same bits whatever the number of threads.
compare::PairGuessOut pair_guess(const compare::PairGuessIn& in);

/// Lists all pairs that can meet at all. The answer has one finite position for each vertex.
compare::PairGuessTruth pair_guess_truth(const compare::PairGuessIn& in, const compare::PairGuessOut& out);

/// Whether a vertex at `position` lies outside of its ball, exactly.
bool leaves_ball(const compare::PairGuessIn& in, const compare::Vec3f& position, std::size_t vertex);

}  // namespace ogc::reference
