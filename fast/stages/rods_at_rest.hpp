// Rest data of the segments of rods, made once on the host in double and rounded once.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/rest_state.hpp"
#include "fast/kernels/rods/segments.hpp"

namespace ogc::fast {

/// All segments of a scene, in the order of compare::rod_segments.
struct RodsAtRest {
  std::vector<SegmentRest> segments;
  std::vector<SegmentNeighbours> neighbours;
  std::vector<Quat> orientations;  ///< q°
  std::vector<int> body;           ///< of each segment
  std::vector<int> motion;         ///< of each segment: segment_free, segment_fixed, or number of a motion
  bool empty() const { return segments.empty(); }
};

/// Also adds half of ρ l of each segment of a body that moves to its ends [kg].
RodsAtRest rods_at_rest(const compare::Scene& scene, std::vector<double>& mass);

/// As the judge asks for them.
std::vector<compare::RestSegment> rest_segments(const RodsAtRest& rods);

/// With the numbers of an answer.
RodsAtRest rods_of(const compare::Scene& scene, const std::vector<compare::RestSegment>& segments);

/// A quaternion of either room, or several.
inline Quat quat(const compare::Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }
inline compare::Quaternion quaternion(const Quat& q) { return {q.x, q.y, q.z, q.w}; }
std::vector<Quat> quats(std::span<const compare::Quaternion> all);
std::vector<compare::Quaternion> quaternions(std::span<const Quat> all);

}  // namespace ogc::fast
