#include "reference/ipc/additive_ccd.hpp"

#include <cstdlib>

#include "tests/catch.hpp"
#include "tests/reference/ipc/ladder.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::ContactSides;
using reference::additive_ccd;

namespace {

ContactSides sides_of(bool edges) { return edges ? ContactSides::edge_edge : ContactSides::point_triangle; }

/// Returns the number of cases: OGC_CCD_CASES if this variable is set, else 6000.
int ladder_cases() {
  const char* text = std::getenv("OGC_CCD_CASES");
  return text ? std::atoi(text) : 6000;
}

struct Tally {
  int cleared = 0, stopped = 0, false_positives = 0, touching = 0;
};

}  // namespace

TEST_CASE("exact meeting: a vertex falls through, beside and onto the rim of a triangle", "[unit]") {
  const Points4 x{{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Points4 delta{};
  delta[0] = {0, 0, -2};
  CHECK(exactly_meet(false, x, delta));
  CHECK_FALSE(exactly_meet(false, x, delta, 0.5 - 0x1p-40));
  CHECK(exactly_meet(false, x, delta, 0.5));
  delta[0] = {2, 0, -2};
  CHECK_FALSE(exactly_meet(false, x, delta));
  delta[0] = {0.5, 0, -1};  // ends on the hypotenuse
  CHECK(exactly_meet(false, x, delta));
  delta[0] = {0.5 + 0x1p-40, 0, -1};
  CHECK_FALSE(exactly_meet(false, x, delta));
}

TEST_CASE("exact meeting: edges cross, pass each other's ends, and stay parallel", "[unit]") {
  const Points4 x{{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}};
  Points4 delta{};
  delta[0] = delta[1] = {0, 0, -2};
  CHECK(exactly_meet(true, x, delta));
  delta[0] = delta[1] = {2, 0, -2};  // the end touches in the middle of the motion
  CHECK(exactly_meet(true, x, delta));
  delta[0] = delta[1] = {2 + 0x1p-40, 0, -2};
  CHECK_FALSE(exactly_meet(true, x, delta));
  const Points4 parallel{{{-1, 0, 1}, {1, 0, 1}, {-1, 0, 0}, {1, 0, 0}}};
  delta[0] = delta[1] = {0, 0, -0.5};
  CHECK_FALSE(exactly_meet(true, parallel, delta));
}

TEST_CASE("CCD: no meeting is missed on the ladders of gaps, angles, needles, near misses and slides", "[property]") {
  MotionLadder ladder(7);
  Tally tally;
  const int cases = ladder_cases();
  for (int i = 0; i < cases; ++i) {
    const PairMotion m = ladder.next(i);
    const double time = additive_ccd(sides_of(m.edges), m.x, m.delta, 0);
    if (time > 0 && exactly_meet(m.edges, m.x, m.delta, time)) {
      CAPTURE(i, m.edges, time);
      FAIL_CHECK("a meeting was missed");
    }
    ++(time == 1 ? tally.cleared : time == 0 ? tally.touching : tally.stopped);
    if (time < 1 && !exactly_meet(m.edges, m.x, m.delta, 1, 60)) ++tally.false_positives;
  }
  WARN(cases << " cases: " << tally.cleared << " cleared, " << tally.stopped << " stopped, " << tally.touching
             << " without a gap that can be told from rounding; "
             << "of the last two " << tally.false_positives << " do not meet at all");
  CHECK(tally.cleared > cases / 10);
  CHECK(tally.stopped > cases / 10);
  // CCD keeps a tenth of the gap, so it also stops motions that end closer than that without a meeting. Most false
  // positives are such motions.
  CHECK(tally.false_positives < cases / 4);
}

TEST_CASE("CCD: a vertex that falls onto a triangle stops with a tenth of the gap left or less, and before it meets",
          "[unit]") {
  const Points4 x{{{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Points4 delta{};
  delta[0] = {0, 0, -4};
  const double time = additive_ccd(ContactSides::point_triangle, x, delta, 0);
  CHECK(time < 0.25);
  CHECK(1 - 4 * time >= 0.1 * (1 - 1e-12));
  CHECK(1 - 4 * time <= 0.11);
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 0.5) == Approx(0.45 / 4).epsilon(0.01));
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 0, 0.1) == 0.1);
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 1) == 0);
}

TEST_CASE("CCD: a long slide at a hair's breadth, away from a triangle, and a common motion are not held up",
          "[unit]") {
  const Points4 x{{{0.25, 0.25, 1e-6}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Points4 delta{};
  delta[0] = {100, 0, 0};
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 0) == 1);
  delta[0] = {0, 0, 100};
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 0) == 1);
  delta.fill({3, -5, 7});
  CHECK(additive_ccd(ContactSides::point_triangle, x, delta, 0) == 1);
}

/// The first safe step ends where the gap is smaller than its rounding error. There the vector between the closest
/// points is only rounding error. The edges move apart along this vector, but this proves nothing.
TEST_CASE("CCD: two nearly parallel edges that meet after 2e-12 of their way are stopped before", "[unit]") {
  const Points4 x{{{0.80323611859320732, -0.19054859758035292, 0.28876038511262969},
                   {0.80187377197897902, -0.19347845971359057, 0.28876038511262969},
                   {0.80418212396323963, -0.18851411877550284, 0.28876038511264746},
                   {0.802819777349014, -0.19144398090874137, 0.28876038511262969}}};
  const reference::Triple<double> first{-0.4853704120804041, 0.028829359573007807, 0.0018239962865722603};
  const reference::Triple<double> second{-0.48416185691808877, 0.030531462066612391, 0};
  const double time = additive_ccd(ContactSides::edge_edge, x, {first, first, second, second}, 0);
  CHECK(time < 1.96e-12);
}

TEST_CASE("CCD: primitives that touch at the start are stopped at once, whatever they do", "[unit]") {
  const Points4 touching{{{0.25, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  Points4 delta{};
  delta[0] = {0, 0, 1};
  CHECK(additive_ccd(ContactSides::point_triangle, touching, delta, 0) == 0);
  const Points4 crossing{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  CHECK(additive_ccd(ContactSides::edge_edge, crossing, delta, 0) == 0);
}
