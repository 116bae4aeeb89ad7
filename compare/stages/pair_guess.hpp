// The guess by certificate of pairs (guess=pairs; compare/pair_guess.md): what the judge's stage step asks of a guess
// that leaves its balls.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/numbers.hpp"
#include "compare/stages/plane.hpp"

namespace ogc::compare {

/// The question: X and y by vertex of a mesh, and what is known about X.
struct PairGuessIn {
  const Topology* topology = nullptr;   ///< of the mesh
  ExclusionView exclusions;             ///< group 0: vertices that are fixed
  std::vector<Vec3f> previous, target;  ///< X, y [m]
  std::vector<float> bound;             ///< b_v at X [m]; of a vertex inside a solid anything
  float bound_relaxation = 0;           ///< γ_p
  float contact_radius = 0;             ///< r [m]
  float largest_reach = 0;              ///< R is at most the cap of r_q [m]
};

/// The answer: any positions to which the straight motion from X is safe. Exactly, on stored positions: of each pair of
/// primitives at distance d, moves of its two sides differ by no more than 2γ_p d, or the gap of both sides along n,
/// the unit vector between their closest points at X, shrinks by no more than 2γ_p of itself. And nothing is held back:
/// let no two moves, nor shares of them, differ by more than 2γ_p · largest_reach. A group of vertices that pairs
/// nearer than R connect stands at y if on the way there each of its pairs loses no more than a thirty-second of its
/// gap, or no more than γ_p of it and is r apart at the end.
struct PairGuessOut {
  std::vector<Vec3f> position;  ///< x [m]
};

/// The truth about an answer.
struct PairGuessTruth {
  std::vector<PrimitivePair> unsafe;  ///< pairs that are nearer along n than they may be, ascending
  std::vector<Index> held_back;       ///< vertices of groups that should stand at y, ascending
  std::size_t pairs = 0;              ///< decided
};

/// By how much a gap may be smaller than its least, in units of itself and of the largest difference of two moves of
/// the pair. A contestant's own n, rounded to single precision, is off by √3 · 2⁻²⁴ of its length, and by as much again
/// where the closest points come from distances in double at coordinates up to 2²⁰ times the gap (§2: dust and scenes);
/// together below 2⁻²².
inline constexpr double pair_guess_tolerance = 0x1p-22;

}  // namespace ogc::compare
