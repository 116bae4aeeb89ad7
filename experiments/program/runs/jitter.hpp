// `ogc run --jitter`: the same scene from a start that differs by random offsets below every length that matters. What
// runs of several seeds have in common is a property of the scene, what they differ in is chance.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// What moves a start.
struct Jitter {
  double largest = 0;      ///< of an offset, by coordinate [m]; 0: nothing moves
  std::uint64_t seed = 1;  ///< of the offsets
};

/// Throws compare::InputError where `largest` is not below a tenth of r. Two points then come
/// nearer by 2√3 · r/10 < 0.35 r at most: no offset passes one surface through another that is farther away, and the
/// audit of the start tells of all others.
void check_jitter(const Jitter& jitter, const compare::Settings& settings);

/// Adds to each coordinate of each free vertex an offset, uniform on multiples of 2⁻⁵² `largest` in [−1, 1) `largest`
/// and rounded to single precision; fixed and prescribed vertices stay. `positions`: by vertex [m]. An offset depends
/// on seed, number of the vertex and coordinate alone, and has the same bits on every machine: its one product is
/// rounded before the sum, so that no compiler contracts the two.
void add_jitter(const Jitter& jitter, const compare::Scene& scene, std::vector<compare::Vec3f>& positions);

}  // namespace ogc::experiments
