#include "fast/kernels/ipc/ccd.hpp"

#include <cmath>
#include <random>

#include "compare/oracle/first_meeting.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

MovingFaces with_motion(CcdKind kind, const std::array<Vec, 4>& from, const std::array<Vec, 4>& motion) {
  MovingFaces faces{kind, {}, {}};
  for (int k = 0; k < 4; ++k) {
    faces.from[k] = from[static_cast<std::size_t>(k)];
    faces.to[k] = from[static_cast<std::size_t>(k)] + motion[static_cast<std::size_t>(k)];
  }
  return faces;
}

const std::array<Vec, 4> above{{{0.25f, 0.25f, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
const std::array<Vec, 4> crossing{{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}};

}  // namespace

TEST_CASE("impact time: a vertex that falls on a triangle stops with a tenth of the gap left or less, before it meets",
          "[unit]") {
  for (const float speed : {1.5f, 4.0f, 1000.0f}) {
    const float time = impact_time(with_motion(CcdKind::vertex_triangle, above, {{{0, 0, -speed}, {}, {}, {}}}));
    CHECK(time < 1 / speed);
    CHECK(time > 0.89f / speed);
  }
  CHECK(impact_time(with_motion(CcdKind::vertex_triangle, above, {{{0, 0, -0.5f}, {}, {}, {}}})) == 1);
}

TEST_CASE("impact time: what slides past, moves away or together is not held up", "[unit]") {
  std::array<Vec, 4> low = above;
  low[0].z = 1e-5f;
  CHECK(impact_time(with_motion(CcdKind::vertex_triangle, low, {{{100, 0, 0}, {}, {}, {}}})) == 1);
  CHECK(impact_time(with_motion(CcdKind::vertex_triangle, low, {{{0, 0, 100}, {}, {}, {}}})) == 1);
  const Vec common{2, -4, 8};
  CHECK(impact_time(with_motion(CcdKind::vertex_triangle, above, {{common, common, common, common}})) == 1);
  CHECK(impact_time(with_motion(CcdKind::edge_edge, crossing, {{{2.5f, 0, -2}, {2.5f, 0, -2}, {}, {}}})) == 1);
}

TEST_CASE("impact time: faces that touch have none", "[unit]") {
  std::array<Vec, 4> touching = above, met = crossing;
  touching[0].z = met[0].z = met[1].z = 0;
  CHECK(impact_time(with_motion(CcdKind::vertex_triangle, touching, {{{0, 0, 1}, {}, {}, {}}})) == 0);
  CHECK(impact_time(with_motion(CcdKind::edge_edge, met, {{{0, 0, 1}, {0, 0, 1}, {}, {}}})) == 0);
}

TEST_CASE("impact time: swapped edges and reversed faces change no time by more than its last tenth, and none is late",
          "[property]") {
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> draw(-1, 1);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const CcdKind kind = i % 2 == 0 ? CcdKind::edge_edge : CcdKind::vertex_triangle;
    MovingFaces faces{kind, {}, {}}, other{kind, {}, {}};
    compare::MovingPair pair{.kind = kind == CcdKind::edge_edge ? compare::MeetingKind::edge_edge
                                                                : compare::MeetingKind::vertex_triangle};
    for (int k = 0; k < 4; ++k) {
      faces.from[k] = {draw(engine), draw(engine), draw(engine)};
      faces.to[k] = {draw(engine), draw(engine), draw(engine)};
      const auto j = static_cast<std::size_t>(k);
      pair.from[j] = {faces.from[k].x, faces.from[k].y, faces.from[k].z};
      pair.to[j] = {faces.to[k].x, faces.to[k].y, faces.to[k].z};
    }
    const int order[2][4] = {{0, 3, 1, 2}, {3, 2, 0, 1}};
    for (int k = 0; k < 4; ++k) {
      const int j = order[kind == CcdKind::edge_edge ? 1 : 0][k];
      other.from[k] = faces.from[j];
      other.to[k] = faces.to[j];
    }
    const float time = impact_time(faces), again = impact_time(other);
    const auto exact = compare::first_meeting(pair);
    met += exact.has_value();
    if (exact) {
      REQUIRE(time <= exact->low);
      REQUIRE(again <= exact->low);
    }
    REQUIRE(std::abs(time - again) <= 0.75f * std::max(time, again));
  }
  CHECK(met > 100);
}
