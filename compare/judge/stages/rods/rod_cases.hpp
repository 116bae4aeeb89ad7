// Helps the stages rod and orientation: checks the contract of a segment and lists its parameters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"

namespace ogc::compare::rod_cases {

/// Checks the contract of a segment's ends, now or at the start of the step.
inline void check_ends(FirstProblem& problem, std::span<const Vec3f> ends, float rest_length) {
  problem.vectors("a coordinate", ends);
  check_lengths(problem, ends, 0x1p-50f, 0x0p0f);
  const double length = std::hypot(double{ends[1].x} - ends[0].x, double{ends[1].y} - ends[0].y,
                                   double{ends[1].z} - ends[0].z);
  problem.require(length <= 0x1p30 * rest_length, "it has grown beyond the contract");
}

/// Checks the members that cases of rod and orientation share.
template <class Case>
void check_segment(FirstProblem& problem, const Case& c) {
  problem.number("a rest length", c.rest_length, least_length, most_length);
  check_ends(problem, c.vertex, c.rest_length);
  check_ends(problem, c.start, c.rest_length);
  check_unit(problem, c.orientation);
  check_unit(problem, c.orientation_start);
  problem.number("a stiffness", c.stretch, 0x1p-30f, vast);
  problem.number("a damping", c.damping, 0, most_length);
}

/// Parameters of the stages rod and orientation.
inline constexpr std::array segment_parameters{ParameterInfo{"k_s", "stiffness of stretch [N]", 0x1p-30f, ranges::vast},
                                               ParameterInfo{"l", "rest length [m]", ranges::least, ranges::most},
                                               ranges::damping};
template <class Case>
float* segment_parameter(Case& c, std::string_view name) {
  return name == "k_s" ? &c.stretch : name == "l" ? &c.rest_length : &c.damping;
}

}  // namespace ogc::compare::rod_cases
