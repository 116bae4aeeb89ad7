// Implements `ogc run --jitter`: starts a scene with random offsets that are smaller than every relevant length. What
// runs with different seeds have in common is a property of the scene. Differences between them are chance.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Describes the offsets of a start.
struct Jitter {
  double largest = 0;      ///< largest offset of a coordinate [m]; 0: no offsets
  std::uint64_t seed = 1;  ///< seed of the offsets
};

/// Throws compare::InputError if `largest` is not below a tenth of r. Below this limit two points approach each other
/// by at most 2√3 · r/10 < 0.35 r. No offset then moves one surface through another that is farther away; the audit of
/// the start reports all other cases.
void check_jitter(const Jitter& jitter, const compare::Settings& settings);

/// Adds an offset to each coordinate of each free vertex; fixed and prescribed vertices stay. Offsets are uniformly
/// distributed multiples of 2⁻⁵² `largest`, at least −`largest` and less than `largest`, and are rounded to single
/// precision. `positions`: by vertex [m]. An offset depends only on the seed, the vertex's number and the coordinate.
/// It has the same bits on every machine, because its only product is rounded before the sum, so that no compiler
/// contracts the two operations.
void add_jitter(const Jitter& jitter, const compare::Scene& scene, std::vector<compare::Vec3f>& positions);

}  // namespace ogc::experiments
