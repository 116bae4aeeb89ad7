// Mutation of captured states: what a run never quite reaches, from where runs are.
#pragma once

#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Moves a few points, in one or more of these ways: next to another point, or halfway between two others, up to a rung
/// of their distance; onto another point; by a rung; one coordinate taken over from another point; all points to few
/// binary digits. Of a step its velocities, of a sweep xᵗ and the targets, of the rest shape as long as it stays legal.
/// Distances go to, or a rung beside, another distance, the radius or its half.
void mutate(Random& random, TestCase& test);

/// The same for points alone.
void mutate_points(Random& random, std::span<Vec3f> points);
/// The same, of vectors that stay numbers of single precision.
std::vector<Vec3> mutated(Random& random, const std::vector<Vec3>& vectors);

/// The points of several arrays of a case, moved together.
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
