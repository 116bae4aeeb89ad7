#include "fast/kernels/sweep_view.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

TEST_CASE("a move is beyond a length where it is farther along an axis, decided without rounding", "[unit]") {
  const Vec from{1, -2, 3};
  const float most = 0.25f, more = std::nextafter(most, 1.0f);
  for (const float sign : {1.0f, -1.0f})
    for (float Vec::*axis : {&Vec::x, &Vec::y, &Vec::z}) {
      Vec to = from;
      to.*axis += sign * most;
      CHECK_FALSE(moves_beyond(from, to, most));
      CHECK(moves_beyond(from, to, std::nextafter(most, 0.0f)));
      CHECK_FALSE(moves_beyond(to, from, more));
    }
  CHECK_FALSE(moves_beyond({0, 0, 0}, {most, most, most}, most));
  // 1 + 2⁻³⁰ would round to 1 in single precision
  CHECK(moves_beyond({-0x1p-30f, 0, 0}, {1, 0, 0}, 1));
  CHECK_FALSE(moves_beyond({0x1p-30f, 0, 0}, {1, 0, 0}, 1));
}

TEST_CASE("a written move is noted where it is farther than settled_move, and never where that is 0", "[unit]") {
  PaddedVec buffers[2] = {PaddedVec{{0, 0, 0}}, {}};
  Vec position;
  StepControl control;
  SweepShared view;
  view.old = buffers;
  view.to_fresh = 1;
  view.position = &position;
  view.control = &control;
  const auto notes = [&](float settled_move, const Vec& x) {
    control.moved = 0;
    view.settled_move = settled_move;
    view.write(0, x);
    CHECK(position.y == x.y);
    CHECK(buffers[1].y == x.y);
    return control.moved;
  };
  CHECK(notes(0, {0, 5, 0}) == 0);
  CHECK(notes(5, {0, 5, 0}) == 0);
  CHECK(notes(4, {0, 5, 0}) == 1);
  view.write(0, {});
  CHECK(control.moved == 1);
}
