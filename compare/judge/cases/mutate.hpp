// Mutates captured states. Mutants lie near the states of a run, and reach degeneracies that the run barely misses.
#pragma once

#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Moves a few points in one or more ways. A point moves next to another point, or next to the middle of two others, by
/// a rung times their distance. It takes the place or one coordinate of another point, moves by a rung, or all points
/// are rounded to few binary digits. In a step velocities move, in a sweep xᵗ and the targets. In rest_state the rest
/// shape moves as long as it stays legal. A distance becomes another distance, the radius or half of it, or moves by a
/// rung.
void mutate(Random& random, TestCase& test);

/// Moves points in the ways of `mutate`.
void mutate_points(Random& random, std::span<Vec3f> points);
/// Returns the vectors, moved in the ways of `mutate` and rounded to single precision.
std::vector<Vec3> mutated(Random& random, const std::vector<Vec3>& vectors);

/// Moves the points of several arrays together, so that a point may take the place of a point of another array.
template <class... Points>
void mutate_together(Random& random, Points&&... arrays) {
  std::vector<Vec3f> points;
  const auto gather = [&](const auto& array) { points.insert(points.end(), array.begin(), array.end()); };
  (gather(std::span<const Vec3f>(arrays)), ...);
  mutate_points(random, points);
  std::size_t at = 0;
  const auto put = [&](std::span<Vec3f> array) {
    for (Vec3f& p : array) p = points[at++];
  };
  (put(std::span<Vec3f>(arrays)), ...);
}

}  // namespace ogc::compare
