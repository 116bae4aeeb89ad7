// Holds quaternions and segments, in double, for cases about rods.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare::rod_cases {

/// A quaternion: the factors of i, j, k, then the real part.
using Four = std::array<double, 4>;

/// Returns the quaternion a · b.
inline Four product(const Four& a, const Four& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
          a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}
inline Four conjugate(const Four& a) { return {-a[0], -a[1], -a[2], a[3]}; }

/// Returns q/‖q‖.
inline Four unit(Four q) {
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  for (double& x : q) x /= length;
  return q;
}

/// Returns q/‖q‖, rounded to single precision.
inline Quaternion single(const Four& q) {
  const Four u = unit(q);
  return {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2]), static_cast<float>(u[3])};
}
inline Four wide(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

/// Returns R(q) v for a unit quaternion.
inline Vec3 turned(const Four& q, const Vec3& v) {
  const Four p = product(product(q, {v.x, v.y, v.z, 0}), conjugate(q));
  return {p[0], p[1], p[2]};
}

/// Returns the rotation by an angle about an axis of unit length.
inline Four rotation(const Vec3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

/// Return a random direction and a random orientation.
inline Vec3 some_direction(Random& random) {
  for (;;) {
    const Vec3 v = placement::in_box(random, -1, 1);
    const double length = std::hypot(v.x, v.y, v.z);
    if (length > 0.1 && length <= 1) return placement::scaled(v, 1 / length);
  }
}
inline Four some_orientation(Random& random) {
  for (;;) {
    Four q;
    double squared = 0;
    for (double& x : q) x = random.between(-1, 1), squared += x * x;
    if (squared > 0.01 && squared <= 1) return unit(q);
  }
}

/// Returns q, or q rotated by a rung [rad].
inline Four beside(Random& random, const Four& q) {
  return product(q, rotation(some_direction(random), random.rung()));
}

/// Returns a frame with a random twist whose director is the direction of d; a random frame if d is 0.
inline Four frame_along(Random& random, const Vec3& d) {
  const double length = std::hypot(d.x, d.y, d.z);
  const Four twist = rotation({0, 0, 1}, random.between(-3, 3));
  const Vec3 half = length > 0 ? placement::sum(placement::scaled(d, 1 / length), {0, 0, 1}) : Vec3{};
  if (std::hypot(half.x, half.y, half.z) < 0x1p-20) return some_orientation(random);
  return product(unit({half.x, half.y, half.z, 0}), twist);  // a rotation by π about the bisector of e₃ and d
}

/// A segment made from an edge of a stored state of a run. Its rest length is about the length of the edge. Its ends at
/// the start of the step are the ends of the edge, moved a little.
struct EdgeOfState {
  std::array<Vec3f, 2> vertex, start;
  double length = 0;  ///< l [m]
  Four frame{}, frame_start{};

  EdgeOfState(Random& random, const std::array<Vec3f, 2>& edge) : vertex(edge), start(edge) {
    const Vec3 d{double{edge[1].x} - edge[0].x, double{edge[1].y} - edge[0].y, double{edge[1].z} - edge[0].z};
    const double now = std::hypot(d.x, d.y, d.z);
    length = std::clamp(now * random.between(0.8, 1.2), 0x1p-20, 0x1p20);
    for (Vec3f& x : start) {
      const Vec3 moved = placement::scaled(placement::in_box(random, -1, 1), 0.1 * length);
      x = placement::single(placement::sum({x.x, x.y, x.z}, moved));
    }
    frame = beside(random, frame_along(random, d));
    frame_start = product(frame, rotation(some_direction(random), random.between(-0.2, 0.2)));
  }
};

/// Returns one of the 24 unit quaternions of the cube's rotations that single precision holds exactly: ±1, ±i, ±j, ±k,
/// (±1 ± i ± j ± k)/2.
inline Four on_lattice(Random& random) {
  Four q{};
  if (random.one_in(2)) {
    q[static_cast<std::size_t>(random.below(4))] = random.sign();
  } else {
    for (double& x : q) x = 0.5 * random.sign();
  }
  return q;
}

/// Returns a length [m]: in most cases 10⁻⁴ … 1, as in yarns, in a quarter 2⁻²⁰ … 2²⁰.
inline double some_length(Random& random) {
  return random.one_in(4) ? std::ldexp(random.between(1, 2), random.below(40) - 20) : random.magnitude(-4, 0);
}

/// Checks that a quaternion has unit length, as the contract requires.
inline void check_unit(FirstProblem& problem, const Quaternion& q) {
  double squared = 0;
  for (const float x : q) squared += double{x} * x;
  problem.require(std::abs(squared - 1) <= unit_quaternion_slack, "an orientation is no unit quaternion");
}

}  // namespace ogc::compare::rod_cases
