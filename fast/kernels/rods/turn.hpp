// Rotates the orientations of segments after the guess loop of a step, and commits them at the end of the step
// (compare/rods.md).
#pragma once

#include "fast/kernels/control.hpp"
#include "fast/kernels/rods/segments.hpp"

namespace ogc::fast {

/// Returns q after a rotation by π about the first axis of q's frame, which reverses the director.
OGC_HD inline Quat turned_round(const Quat& q) { return {q.w, q.z, -q.y, -q.x}; }

/// Returns q after the smallest rotation that takes the direction `from` to `to`. For opposite directions this is a
/// rotation by π about the first axis of q. Returns q if a direction is 0. With unit vectors a, b at the angle θ, (a ×
/// b, 1 + a·b) is the quaternion of this rotation times 2 cos θ/2.
OGC_HD inline Quat turned_along(const Vec& from, const Vec& to, const Quat& q) {
  const float first = sqrtf(dot(from, from)), second = sqrtf(dot(to, to));
  if (!(first > 0 && second > 0)) return q;
  // For opposite directions `twice` is 0 except for rounding errors of about 2⁻²⁴, whose squares stay far below this
  // limit.
  constexpr float lost = 0x1p-40f;
  const Vec a = (1.0f / first) * from, b = (1.0f / second) * to, axis = cross(a, b);
  const Quat twice{axis.x, axis.y, axis.z, 1.0f + dot(a, b)};
  if (!(dot(twice, twice) > lost)) return turned_round(q);
  return unit(unit(twice) * q);
}

/// Computes the direction c of rod_rest_direction. Runs once for each segment; launched only if strains are damped.
struct SetDirection {
  const SegmentRest* segments;    ///< by segment
  const Vec* start;               ///< xᵗ by vertex [m]
  const Quat* orientation_start;  ///< qᵗ by segment
  Vec* direction;                 ///< c by segment, written

  OGC_HD void operator()(int e) const {
    const SegmentRest rest = segments[e];
    direction[e] = rod_rest_direction(rest, rest.damping, orientation_start[e],
                                      start[rest.end[1]] - start[rest.end[0]]);
  }
};

/// Sets q after the guess loop: rotates qᵗ as the segment was rotated since the start of the step, or by the segment's
/// prescribed motion. Runs once for each segment.
struct TurnSegment {
  const SegmentRest* segments;  ///< by segment
  const int* motion;            ///< by segment: motion, as in segments.hpp
  /// [step since the last stored state][motion]: rotation of a prescribed motion in the step; a motion without rotation
  /// has w = 2
  const Quat* motion_turns;
  int motions;                    ///< prescribed motions: length of a row of motion_turns
  const Vec* start;               ///< xᵗ by vertex [m]
  const Vec* position;            ///< x by vertex [m], after the guess loop
  const Quat* orientation_start;  ///< qᵗ by segment
  Quat* orientation;              ///< q by segment, written
  bool turns;                     ///< false: free segments keep qᵗ (rod_start=kept)
  const StepControl* control;     ///< on the backend; `steps_done` is read

  OGC_HD void operator()(int e) const {
    const SegmentRest rest = segments[e];
    const Quat before = orientation_start[e];
    const Vec apart = start[rest.end[1]] - start[rest.end[0]], now = position[rest.end[1]] - position[rest.end[0]];
    const int held = motion[e];
    Quat q = before;
    if (held >= 0) {
      const Quat turn = motion_turns[control->steps_done * motions + held];
      q = turn.w <= 1.0f ? unit(turn * before) : turned_along(apart, now, before);
    } else if (held == segment_free && turns) {
      q = turned_along(apart, now, before);
    }
    orientation[e] = q;
  }
};

/// Sets qᵗ = q for a step that did not fail. Runs once for each segment.
struct CommitSegment {
  const Quat* orientation;     ///< q by segment
  const StepControl* control;  ///< on the backend; if not active the step failed, and nothing is written
  Quat* orientation_start;     ///< qᵗ by segment, written

  OGC_HD void operator()(int e) const {
    if (control->active != 0) orientation_start[e] = orientation[e];
  }
};

}  // namespace ogc::fast
