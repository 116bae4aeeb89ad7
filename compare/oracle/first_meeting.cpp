#include "compare/oracle/first_meeting.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "compare/oracle/moments.hpp"
#include "compare/oracle/squared_distance.hpp"

namespace ogc::compare {
namespace {

using Path = DistanceVector<Polynomial>;
using Triple = std::array<std::size_t, 3>;

const Polynomial& component(const Path& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

constexpr std::array<Triple, 4> triples{{{0, 1, 2}, {0, 1, 3}, {2, 3, 0}, {2, 3, 1}}};

class Paths {
 public:
  explicit Paths(const MovingPair& pair) : kind_(pair.kind) {
    for (std::size_t k = 0; k < 4; ++k)
      points_[k] = {Polynomial::line(pair.from[k].x, pair.to[k].x), Polynomial::line(pair.from[k].y, pair.to[k].y),
                    Polynomial::line(pair.from[k].z, pair.to[k].z)};
    for (std::size_t k = 0; k < 4; ++k) areas_[k] = area(triples[k]);
  }

  /// Returns six times the volume of the four points, which is 0 whenever the faces share a point.
  Polynomial volume() const { return dot(areas_[0], minus(points_[3], points_[0])); }

  /// Returns all polynomials whose sign `meets` uses.
  std::vector<Polynomial> questions() const {
    std::vector<Polynomial> all;
    const auto add = [&](const Path& v) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!component(v, axis).is_zero()) all.push_back(component(v, axis));
    };
    for (const Path& a : areas_) add(a);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) add(minus(points_[i], points_[j]));
    return all;
  }

  /// Returns whether the faces meet at `time`. The volume of the four points must be 0 at this time.
  bool meets(Moment& time) const { return kind_ == MeetingKind::edge_edge ? edges_meet(time) : vertex_meets(time); }

 private:
  Path area(const Triple& t) const {
    return cross(minus(points_[t[1]], points_[t[0]]), minus(points_[t[2]], points_[t[0]]));
  }

  /// Returns the orientation of three points seen along an axis.
  int side(Moment& time, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) const {
    return time.sign(component(area({i, j, k}), axis));
  }

  /// Returns whether coordinate `axis` of k lies in the closed interval between the coordinates of i and j.
  bool between(Moment& time, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) const {
    const auto beyond = [&](std::size_t end) {
      return time.sign(component(points_[k], axis) - component(points_[end], axis));
    };
    return beyond(i) * beyond(j) <= 0;
  }

  /// Returns whether point k lies in the box around points i and j, all projected along `axis`. For collinear points
  /// this box is the closed segment from i to j.
  bool within(Moment& time, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) const {
    return between(time, i, j, k, (axis + 1) % 3) && between(time, i, j, k, (axis + 2) % 3);
  }

  /// Returns whether the edges meet. Projects the points along an axis that is not parallel to their plane, so the
  /// projection is one-to-one.
  bool edges_meet(Moment& time) const {
    for (const Triple& t : triples)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (side(time, t[0], t[1], t[2], axis) != 0) return planar_edges_meet(time, axis);
    for (std::size_t axis = 0; axis < 3; ++axis)  // all four points are on one line
      if (!overlap(time, axis)) return false;
    return true;
  }

  bool planar_edges_meet(Moment& time, std::size_t axis) const {
    const int s2 = side(time, 0, 1, 2, axis), s3 = side(time, 0, 1, 3, axis);
    const int s0 = side(time, 2, 3, 0, axis), s1 = side(time, 2, 3, 1, axis);
    if (s2 * s3 < 0 && s0 * s1 < 0) return true;
    return (s2 == 0 && within(time, 0, 1, 2, axis)) || (s3 == 0 && within(time, 0, 1, 3, axis)) ||
           (s0 == 0 && within(time, 2, 3, 0, axis)) || (s1 == 0 && within(time, 2, 3, 1, axis));
  }

  /// Returns whether the ranges of a coordinate on both edges overlap: an end of one range is in the other.
  bool overlap(Moment& time, std::size_t axis) const {
    return between(time, 0, 1, 2, axis) || between(time, 0, 1, 3, axis) || between(time, 2, 3, 0, axis) ||
           between(time, 2, 3, 1, axis);
  }

  bool vertex_meets(Moment& time) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (side(time, 1, 2, 3, axis) == 0) continue;
      const int a = side(time, 1, 2, 0, axis), b = side(time, 2, 3, 0, axis), c = side(time, 3, 1, 0, axis);
      return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
    return on_segment(time, 1, 2) || on_segment(time, 2, 3) || on_segment(time, 3, 1);  // a collapsed triangle
  }

  bool on_segment(Moment& time, std::size_t i, std::size_t j) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (side(time, i, j, 0, axis) != 0 || !between(time, i, j, 0, axis)) return false;
    return true;
  }

  MeetingKind kind_;
  std::array<Path, 4> points_;
  std::array<Path, 4> areas_;
};

}  // namespace

std::optional<MeetingTime> first_meeting(const MovingPair& pair) {
  const Paths paths(pair);
  if (const Polynomial volume = paths.volume(); !volume.is_zero()) {
    for (Moment& time : moments(volume)) {
      if (!paths.meets(time)) continue;
      const MomentBracket found = time.bracket();
      return MeetingTime{found.low, found.high};
    }
    return std::nullopt;
  }
  Moment start{CGAL::Mpzf(0)};
  if (paths.meets(start)) return MeetingTime{0, 0};
  std::optional<MeetingTime> first;
  for (const Polynomial& question : paths.questions())
    for (Moment& time : moments(question)) {
      if (!paths.meets(time)) continue;
      const MomentBracket found = time.bracket();
      first = first ? MeetingTime{std::min(first->low, found.low), std::min(first->high, found.high)}
                    : MeetingTime{found.low, found.high};
      break;  // later roots of this polynomial are later times
    }
  return first;
}

}  // namespace ogc::compare
