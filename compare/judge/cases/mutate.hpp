// Mutates captured states, to reach what a run never quite reaches from the states where runs are.
#pragma once

#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Moves a few points in one or more of these ways: next to another point or halfway between two others, up to a rung
/// of their distance; onto another point; by a rung; by taking over one coordinate of another point; by rounding all
/// points to few binary digits. In a step it moves velocities, in a sweep xᵗ and the targets, in rest_state the rest
/// shape as long as that stays legal. Distances become another distance, the radius or its half, or lie a rung beside
/// it.
void mutate(Random& random, TestCase& test);

/// Moves points alone in the same ways.
void mutate_points(Random& random, std::span<Vec3f> points);
/// Moves vectors in the same ways; they stay numbers of single precision.
std::vector<Vec3> mutated(Random& random, const std::vector<Vec3>& vectors);

/// Moves the points of several arrays of a case together.
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
