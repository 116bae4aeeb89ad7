#include "fast/stages/kinds/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/problem/rods.hpp"
#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

using RestFrame = QuatOf<double>;

RestFrame normal(const RestFrame& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length, a.w / length};
}
Quat rounded(const RestFrame& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z), static_cast<float>(a.w)};
}

RestVector unit_direction(const RestVector& a) {
  const double length = rest_length(a);
  return {a.x / length, a.y / length, a.z / length};
}
RestVector opposite(const RestVector& a) { return {-a.x, -a.y, -a.z}; }

/// The rotation by 180° about the first axis of a frame. It reverses the director.
constexpr RestFrame turned_round{1, 0, 0, 0};

/// Returns the rotation from one unit direction to another: (a × b, 1 + a·b), normalised.
RestFrame turn_between(const RestVector& a, const RestVector& b) {
  const RestVector axis = rest_cross(a, b);
  const double real = 1 + rest_dot(a, b);
  if (axis.x == 0 && axis.y == 0 && axis.z == 0 && !(real > 0)) return turned_round;
  return normal({axis.x, axis.y, axis.z, real});
}

/// The segments that meet at a vertex: index of the segment, index of its end at this vertex.
using Ends = std::vector<std::pair<int, int>>;

/// Finds the neighbours of segments. Computes rest frames by the walks along rods that compare/stages/rest_state.hpp
/// defines.
class Walks {
 public:
  Walks(const std::vector<SegmentRest>& segments, std::vector<RestVector> directions, std::size_t vertices)
      : directions_(std::move(directions)), neighbours_(segments.size(), {-1, -1}), enters_(segments.size(), {-1, -1}) {
    std::vector<Ends> around(vertices);
    for (int e = 0; e < static_cast<int>(segments.size()); ++e)
      for (const int end : {0, 1}) around[at(segments[at(e)].end[end])].emplace_back(e, end);
    for (const Ends& ends : around) {
      if (ends.size() != 2) continue;
      link(ends[0], ends[1]);
      link(ends[1], ends[0]);
    }
    frames_.resize(segments.size());
    is_set_.resize(segments.size());
    for (int e = 0; e < static_cast<int>(segments.size()); ++e)
      if (neighbours_[at(e)][0] < 0 || neighbours_[at(e)][1] < 0) walk_from(e);
    for (int e = 0; e < static_cast<int>(segments.size()); ++e) walk_from(e);
  }

  int neighbour(int e, int end) const { return neighbours_[at(e)][at(end)]; }
  const RestFrame& frame(int e) const { return frames_[at(e)]; }
  /// Returns p°, the rotation at rest between the frames of segment e and of its neighbour at `end`.
  RestFrame relative(int e, int end) const {
    const RestFrame &own = frame(e), &other = frame(neighbour(e, end));
    return end == 1 ? conjugate(own) * other : conjugate(other) * own;
  }

 private:
  void link(const std::pair<int, int>& from, const std::pair<int, int>& to) {
    neighbours_[at(from.first)][at(from.second)] = to.first;
    enters_[at(from.first)][at(from.second)] = to.second;
  }

  void walk_from(int first) {
    if (is_set_[at(first)]) return;
    frames_[at(first)] = turn_between({0, 0, 1}, directions_[at(first)]);
    is_set_[at(first)] = true;
    int e = first, end = neighbours_[at(e)][1] >= 0 ? 1 : 0;
    for (int next = neighbour(e, end); next >= 0 && !is_set_[at(next)]; next = neighbour(e, end)) {
      const int entered = enters_[at(e)][at(end)];
      const RestVector& to = directions_[at(next)];
      const bool runs_on = entered != end;
      const RestFrame moved = turn_between(directions_[at(e)], runs_on ? to : opposite(to)) * frames_[at(e)];
      frames_[at(next)] = normal(runs_on ? moved : moved * turned_round);
      is_set_[at(next)] = true;
      e = next, end = 1 - entered;
    }
  }

  std::vector<RestVector> directions_;
  std::vector<std::array<int, 2>> neighbours_, enters_;  ///< by end: the neighbour; the end of the neighbour
  std::vector<RestFrame> frames_;
  std::vector<bool> is_set_;
};

/// Returns the rods' data that do not depend on the rest shape: ends, materials, bodies and motions.
RodsAtRest without_shape(const compare::Scene& scene) {
  const std::vector<compare::Index> numbers = compare::rod_segments(scene), bodies = compare::body_of_vertex(scene);
  RodsAtRest rods;
  for (const compare::Index number : numbers) {
    const compare::Edge& ends = scene.mesh.loose_edges[at(number)];
    const int body = bodies[at(ends[0])];
    const compare::RodMaterial& material = *scene.bodies[at(body)].material.rod;
    rods.segments.push_back({{ends[0], ends[1]},
                             0,
                             static_cast<float>(material.stretch),
                             static_cast<float>(material.damping / scene.settings.time_step)});
    rods.body.push_back(body);
  }
  for (const compare::Index group : compare::segment_groups(scene, numbers))
    rods.motion.push_back(group < 0 ? segment_free : group == 0 ? segment_fixed : group - 1);
  rods.neighbours.resize(numbers.size());
  rods.orientations.resize(numbers.size());
  return rods;
}

}  // namespace

RodsAtRest rods_at_rest(const compare::Scene& scene, std::vector<double>& mass) {
  RodsAtRest rods = without_shape(scene);
  if (rods.empty()) return rods;
  std::vector<RestVector> directions;
  std::vector<double> lengths;
  for (std::size_t e = 0; e < rods.segments.size(); ++e) {
    const int* end = rods.segments[e].end;
    const RestVector along = rest_difference(scene.rest_positions[at(end[1])], scene.rest_positions[at(end[0])]);
    lengths.push_back(rest_length(along));
    directions.push_back(unit_direction(along));
    rods.segments[e].length = static_cast<float>(lengths.back());
    const compare::Body& body = scene.bodies[at(rods.body[e])];
    if (body.fixed) continue;
    for (const int k : {0, 1}) mass[at(end[k])] += body.material.rod->density * lengths.back() / 2;
  }
  const Walks walks(rods.segments, std::move(directions), scene.rest_positions.size());
  for (int e = 0; e < static_cast<int>(rods.segments.size()); ++e) {
    rods.orientations[at(e)] = rounded(walks.frame(e));
    for (const int end : {0, 1}) {
      SegmentNeighbours& seen = rods.neighbours[at(e)];
      const int other = walks.neighbour(e, end);
      seen.number[end] = other >= 0 ? other : e;
      if (other < 0) continue;
      const double mean = (lengths[at(e)] + lengths[at(other)]) / 2;
      seen.rest[end] = {static_cast<float>(4 * scene.bodies[at(rods.body[at(e)])].material.rod->bend / mean),
                        rounded(walks.relative(e, end))};
    }
  }
  return rods;
}

std::vector<compare::RestSegment> rest_segments(const RodsAtRest& rods) {
  std::vector<compare::RestSegment> all;
  for (int e = 0; e < static_cast<int>(rods.segments.size()); ++e) {
    const SegmentRest& rest = rods.segments[at(e)];
    compare::RestSegment segment;
    segment.end = {rest.end[0], rest.end[1]};
    segment.body = rods.body[at(e)];
    segment.length = rest.length;
    segment.orientation = quaternion(rods.orientations[at(e)]);
    for (const int end : {0, 1}) {
      const SegmentNeighbours& seen = rods.neighbours[at(e)];
      segment.relative[at(end)] = {0, 0, 0, 0};
      if (seen.number[end] == e) continue;
      segment.neighbour[at(end)] = seen.number[end];
      segment.weight[at(end)] = seen.rest[end].weight;
      segment.relative[at(end)] = quaternion(seen.rest[end].rest);
    }
    all.push_back(segment);
  }
  return all;
}

RodsAtRest rods_of(const compare::Scene& scene, const std::vector<compare::RestSegment>& segments) {
  RodsAtRest rods = without_shape(scene);
  for (std::size_t e = 0; e < segments.size(); ++e) {
    const compare::RestSegment& from = segments[e];
    rods.segments[e].length = from.length;
    rods.orientations[e] = quat(from.orientation);
    for (const std::size_t end : {0, 1}) {
      SegmentNeighbours& to = rods.neighbours[e];
      to.number[end] = from.neighbour[end] >= 0 ? from.neighbour[end] : static_cast<int>(e);
      if (from.neighbour[end] >= 0) to.rest[end] = {from.weight[end], quat(from.relative[end])};
    }
  }
  return rods;
}

std::vector<Quat> quats(std::span<const compare::Quaternion> all) {
  std::vector<Quat> to;
  for (const compare::Quaternion& q : all) to.push_back(quat(q));
  return to;
}

std::vector<compare::Quaternion> quaternions(std::span<const Quat> all) {
  std::vector<compare::Quaternion> to;
  for (const Quat& q : all) to.push_back(quaternion(q));
  return to;
}

std::vector<float> AtRest<SegmentKind>::by_body(const RestShared& shared) const {
  std::vector<float> damping(shared.materials.size(), 0.0f);
  bool any = false;
  for (std::size_t e = 0; e < rods.segments.size(); ++e) {
    damping[as_index(rods.body[e])] = rods.segments[e].damping;
    any = any || rods.segments[e].damping > 0;
  }
  return any ? damping : std::vector<float>{};
}

}  // namespace ogc::fast
