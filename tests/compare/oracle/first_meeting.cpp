#include "compare/oracle/first_meeting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.hpp"
#include "tests/compare/oracle/rational_intersection.hpp"
#include "tests/reference/ipc/ladder.hpp"

using namespace ogc::compare;
using ogc::tests::exactly_meet;
using ogc::tests::MotionLadder;
using ogc::tests::PairMotion;

namespace {

constexpr MeetingKind vertex = MeetingKind::vertex_triangle, edges = MeetingKind::edge_edge;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the pair in double; nothing if a position at the end of the motion is no double.
std::optional<MovingPair> pair_of(const PairMotion& m) {
  MovingPair pair{.kind = m.edges ? edges : vertex};
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<double, 3> to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      to[axis] = m.x[k][axis] + m.delta[k][axis];
      if (to[axis] - m.x[k][axis] != m.delta[k][axis] || to[axis] - m.delta[k][axis] != m.x[k][axis]) return {};
    }
    pair.from[k] = {m.x[k][0], m.x[k][1], m.x[k][2]};
    pair.to[k] = {to[0], to[1], to[2]};
  }
  return pair;
}

MovingPair with_delta(MeetingKind kind, const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& delta) {
  MovingPair pair{.kind = kind, .from = from};
  for (std::size_t k = 0; k < 4; ++k)
    pair.to[k] = {from[k].x + delta[k].x, from[k].y + delta[k].y, from[k].z + delta[k].z};
  return pair;
}

bool meets_at(const MovingPair& pair, double t) {
  std::array<Vec3, 4> x;
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  for (std::size_t k = 0; k < 4; ++k)
    x[k] = {mix(pair.from[k].x, pair.to[k].x), mix(pair.from[k].y, pair.to[k].y), mix(pair.from[k].z, pair.to[k].z)};
  if (pair.kind == edges) return ogc::tests::hulls_meet({x[0], x[1]}, {x[2], x[3], x[3]});
  return ogc::tests::hulls_meet({x[0], x[0]}, {x[1], x[2], x[3]});
}

MovingPair reversed(MovingPair pair) {
  std::swap(pair.from, pair.to);
  return pair;
}

MovingPair permuted(const MovingPair& pair, const std::array<std::size_t, 4>& order) {
  MovingPair result = pair;
  for (std::size_t k = 0; k < 4; ++k) result.from[k] = pair.from[order[k]], result.to[k] = pair.to[order[k]];
  return result;
}

}  // namespace

TEST_CASE(
    "first meeting: the ladders of gaps, needles, near misses and slides are decided as integers decide them, and "
    "the time is that of the first point",
    "[property]") {
  MotionLadder ladder(21);
  int asked = 0, met = 0, culled = 0;
  for (int i = 0; i < 1200; ++i) {
    const PairMotion m = ladder.next(i);
    const auto pair = pair_of(m);
    if (!pair) continue;
    ++asked;
    const auto time = first_meeting(*pair);
    const bool expected = exactly_meet(m.edges, m.x, m.delta);
    CAPTURE(i, m.edges);
    REQUIRE(time.has_value() == expected);
    const bool apart = certainly_apart(*pair);
    culled += apart;
    REQUIRE_FALSE((apart && expected));
    if (!time) continue;
    ++met;
    REQUIRE(time->low <= time->high);
    REQUIRE(time->high <= std::nextafter(time->low, infinity));
    if (time->low < 0x1p-40) continue;  // integers resolve no finer times
    REQUIRE(exactly_meet(m.edges, m.x, m.delta, time->high));
    REQUIRE_FALSE(exactly_meet(m.edges, m.x, m.delta, std::nextafter(time->low, 0)));
  }
  WARN(asked << " motions, " << met << " meet, " << culled << " parted in floating point");
  CHECK(asked > 1000);
  CHECK(met > asked / 10);
  CHECK(culled > (asked - met) / 2);
}

/// Coordinates are small integers, so that many triangles collapse, edges are points, motions lie in one plane or along
/// one line, and faces touch at the start or the end of the motion. At dyadic times positions are doubles, and rational
/// arithmetic decides whether the faces meet.
TEST_CASE(
    "first meeting: degenerate motions on a grid agree with rational arithmetic at 17 times, and with themselves "
    "backwards and in any order of vertices",
    "[property]") {
  std::mt19937 engine(5);
  int met = 0, planar = 0;
  for (int i = 0; i < 600; ++i) {
    const int flat = i % 4;  // 3, 2, 1 or 3 coordinates vary
    const auto coordinate = [&](int axis) {
      return flat > 0 && flat < 3 && axis >= 3 - flat ? 1.0 : std::uniform_int_distribution<int>(0, 2)(engine);
    };
    MovingPair pair{.kind = i % 2 == 0 ? edges : vertex};
    for (auto* state : {&pair.from, &pair.to})
      for (Vec3& x : *state) x = {coordinate(0), coordinate(1), coordinate(2)};
    const auto time = first_meeting(pair);
    CAPTURE(i);
    for (int k = 0; k <= 16; ++k) {
      const double t = k / 16.0;
      if (!meets_at(pair, t)) continue;
      REQUIRE(time.has_value());
      REQUIRE(time->low <= t);
      break;
    }
    if (time) {
      ++met, planar += flat == 1 || flat == 2;
      if (time->low == time->high && std::ldexp(time->low, 20) == std::floor(std::ldexp(time->low, 20)))
        REQUIRE(meets_at(pair, time->low));
      REQUIRE_FALSE(certainly_apart(pair));
    }
    REQUIRE(first_meeting(reversed(pair)).has_value() == time.has_value());
    const MovingPair other = pair.kind == edges ? permuted(pair, {3, 2, 0, 1}) : permuted(pair, {0, 3, 1, 2});
    const auto same = first_meeting(other);
    REQUIRE(same.has_value() == time.has_value());
    if (time) REQUIRE((same->low == time->low && same->high == time->high));
  }
  CHECK(met > 60);
  CHECK(planar > 20);
}

TEST_CASE("first meeting: an irrational time lies between two neighbouring doubles", "[unit]") {
  // The vertex falls by 2t while the triangle's plane rotates. The vertex meets the triangle at the irrational root of
  // 128 − 288t + 3t².
  const MovingPair pair = with_delta(vertex, {{{0.25, 0.25, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},
                                     {{{0, 0, -2}, {0, 0, 0}, {0, 0, 3}, {0.5, 0, 1}}});
  const auto time = first_meeting(pair);
  REQUIRE(time);
  CHECK(time->low < time->high);
  CHECK(std::nextafter(time->low, 1) == time->high);
  CHECK_FALSE(certainly_apart(pair));
}

TEST_CASE(
    "first meeting: two edges that stay in one plane meet when an end reaches the other, 2^-40 less is no meeting",
    "[unit]") {
  for (const double slope : {0.0, 2.0}) {  // the plane z = slope·x
    const auto at = [&](double x, double y) { return Vec3{x, y, slope * x}; };
    const auto closing = [&](double way) {
      return with_delta(edges, {at(-1, 0), at(1, 0), at(0, 1), at(0, 2)},
                        {Vec3{}, Vec3{}, Vec3{0, -way, 0}, Vec3{0, -way, 0}});
    };
    CHECK(first_meeting(closing(1))->low == 1);
    CHECK(first_meeting(closing(4))->low == 0.25);
    CHECK_FALSE(first_meeting(closing(1 - 0x1p-40)));
    // The edges move along one line.
    const auto on_line = [&](double way) {
      return with_delta(edges, {at(0, 0), at(1, 0), at(2, 0), at(3, 0)},
                        {Vec3{}, Vec3{}, Vec3{-way, 0, -slope * way}, Vec3{-way, 0, -slope * way}});
    };
    CHECK(first_meeting(on_line(2))->low == 0.5);
    CHECK_FALSE(first_meeting(on_line(1 - 0x1p-40)));
  }
}

TEST_CASE("first meeting: what touches at the start meets at time 0, whatever it does", "[unit]") {
  const std::array<Vec3, 4> crossing{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  const auto leaving = first_meeting(with_delta(edges, crossing, {{{0, 0, 1}, {0, 0, 1}, {}, {}}}));
  REQUIRE(leaving);
  CHECK(leaving->high == 0);
  CHECK(first_meeting(with_delta(edges, crossing, {}))->high == 0);
  CHECK(first_meeting(with_delta(vertex, {{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {}))->high == 0);
}

TEST_CASE("first meeting: faces that pass through a point in passing, and numbers of any size", "[unit]") {
  for (const double size : {1e-300, 1e-30, 1.0, 1e30, 1e300}) {
    const auto scaled = [&](Vec3 v) { return Vec3{size * v.x, size * v.y, size * v.z}; };
    const auto all = [&](std::array<Vec3, 4> x) {
      for (Vec3& v : x) v = scaled(v);
      return x;
    };
    // The triangle collapses to a segment at t = 1/2, when the vertex is on it.
    const MovingPair pair{.kind = vertex,
                          .from = all({{{0.5, -1, 0}, {0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}}}),
                          .to = all({{{0.5, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}}})};
    const auto time = first_meeting(pair);
    REQUIRE(time);
    CHECK(time->low == 0.5);
    MovingPair beside = pair;
    beside.from[0].z = beside.to[0].z = 0x1p-40 * size;
    CHECK_FALSE(first_meeting(beside));
    CHECK((certainly_apart(beside) || size < 1e-290 || size > 1e290));
  }
}
