// Mutates captured states. Mutants lie near the states of a run, and reach degeneracies that the run barely misses.
#pragma once

#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Changes a few points, one to four times. One change
/// - moves a point by a rung times the distance of two points, or puts a point at this distance from another point or
///   from a midpoint,
/// - copies a point or a coordinate, or rounds all points to few binary digits.
/// In a step the velocities change; in a sweep xᵗ and the targets; in rest_state the rest shape, as long as it stays
/// legal. In activation the distance changes by a rung, or becomes about r or r/2.
void mutate(Random& random, TestCase& test);

/// Changes points as `mutate` does.
void mutate_points(Random& random, std::span<Vec3f> points);
/// Returns the vectors, changed as `mutate` does and rounded to single precision.
std::vector<Vec3> mutated(Random& random, const std::vector<Vec3>& vectors);

/// Changes the points of several arrays as one list, so that a point of one array may be copied into another array.
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
