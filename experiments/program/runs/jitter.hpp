// Implements `ogc run --jitter`: the same scene from a start that differs by random offsets below every length that
// matters. What runs of several seeds have in common is a property of the scene; their differences are chance.
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

/// Throws compare::InputError if `largest` is not below a tenth of r. Below it two points approach each other by 2√3 ·
/// r/10 < 0.35 r at most, so that no offset passes one surface through another that is farther away; the audit of the
/// start reports all other cases.
void check_jitter(const Jitter& jitter, const compare::Settings& settings);

/// Adds to each coordinate of each free vertex an offset, uniform on multiples of 2⁻⁵² `largest` in [−1, 1) `largest`
/// and rounded to single precision; fixed and prescribed vertices stay. `positions`: by vertex [m]. An offset depends
/// on the seed, the number of the vertex and the coordinate alone, and has the same bits on every machine: its only
/// product is rounded before the sum, so that no compiler contracts the two.
void add_jitter(const Jitter& jitter, const compare::Scene& scene, std::vector<compare::Vec3f>& positions);

}  // namespace ogc::experiments
