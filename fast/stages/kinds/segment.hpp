// Holds the rest data of rods' segments, made once on the host in double and rounded once.
#pragma once

#include <span>
#include <vector>

#include "fast/stages/kinds/at_rest.hpp"

namespace ogc::fast {

/// Holds all segments of a scene, in the order of compare::rod_segments.
struct RodsAtRest {
  std::vector<SegmentRest> segments;
  std::vector<SegmentNeighbours> neighbours;
  std::vector<Quat> orientations;  ///< q°
  std::vector<int> body;           ///< by segment
  std::vector<int> motion;         ///< by segment: segment_free, segment_fixed, or the number of a motion
  bool empty() const { return segments.empty(); }
};

/// Returns the rods of a scene at rest. Also adds half the mass of each segment, except on fixed bodies, to each of its
/// ends [kg].
RodsAtRest rods_at_rest(const compare::Scene& scene, std::vector<double>& mass);

/// Returns the segments in the judge's format.
std::vector<compare::RestSegment> rest_segments(const RodsAtRest& rods);

/// Returns the scene's rods. Their lengths, orientations and neighbours are taken from `segments`, the rest state that
/// a contestant has computed for the judge.
RodsAtRest rods_of(const compare::Scene& scene, const std::vector<compare::RestSegment>& segments);

template <>
struct AtRest<SegmentKind> : PlainAtRest<SegmentKind> {
  RodsAtRest rods;

  const std::vector<SegmentRest>& elements() const { return rods.segments; }
  void add(const RestBuild& build) { rods = rods_at_rest(build.scene, build.mass); }
  void add(const compare::RestStateIn& in, const compare::RestStateOut& out) {
    rods = rods_of(*in.scene, out.segments);
  }
  void give(compare::RestStateOut& out) const { out.segments = rest_segments(rods); }
  bool damps(const RestShared&, int segment) const { return rods.segments[as_index(segment)].damping > 0; }
  /// Returns k_d/h by body; empty if no body is damped.
  std::vector<float> by_body(const RestShared& shared) const;
};

/// Convert quaternions between the types of `compare` and of the kernels.
inline Quat quat(const compare::Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }
inline compare::Quaternion quaternion(const Quat& q) { return {q.x, q.y, q.z, q.w}; }
std::vector<Quat> quats(std::span<const compare::Quaternion> all);
std::vector<compare::Quaternion> quaternions(std::span<const Quat> all);

}  // namespace ogc::fast
