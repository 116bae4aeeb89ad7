#include "fast/kernels/initial_guess.hpp"

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

bool same(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// Holds three free vertices on a line, with targets at distances 1, 1 and 0.1 and bounds 0.25. With contacts, the first
// vertex touches the second one, at distance 1, since r is 1.5.
struct Line {
  Vec target[3] = {{1, 0, 0}, {1, 1, 0}, {0.1f, 2, 0}};
  Vec previous[3] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  Vec position[3] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  float bound[3] = {0.25f, 0.25f, 0.25f};
  Vec taken[6];
  int number[3] = {-1, -1, -1}, offsets[7] = {0, 1, 1, 1, 1, 1, 1};
  ContactIncidence contact{.index = {0, 0, 1, 0}, .stiffness = 1, .kind = ContactKind::point_point};
  StepControl control;

  void guess(bool hold) {
    control.active = 1;
    for (int v = 0; v < 3; ++v) guess_vertex(hold)(v);
  }
  GuessVertex guess_vertex(bool hold) {
    const GuessContacts contacts{{nullptr, 3}, hold ? offsets : nullptr, &contact, previous, target, taken, 1.5f};
    return {target, {previous, bound}, contacts, 3, taken, position, &control, number};
  }
};

}  // namespace

TEST_CASE("the guess goes to the target or to the bound, and counts what it cut", "[unit]") {
  Line line;
  line.guess(false);
  CHECK(line.position[0].x == 0.25f);
  CHECK(line.position[1].x == 0.25f);
  CHECK(line.position[2].x == 0.1f);
  CHECK(line.control.cut == 2);
}

TEST_CASE("the guess keeps from a move what closes a contact, and the next round knows what was kept", "[unit]") {
  for (const int rounds : {0, 1}) {
    Line line;
    line.control.rounds = rounds;
    line.target[0] = {0.125f, 1, 0};  // the partner is 1 away along y and moves sideways
    line.guess(true);
    CHECK(same(line.position[0], Vec{0.125f, 0, 0}));
    CHECK(line.position[1].x == 0.25f);
    CHECK(line.control.cut == 1);
    const Vec *now = line.taken + (rounds == 0 ? 3 : 0), *before = line.taken + (rounds == 0 ? 0 : 3);
    CHECK(same(now[0], Vec{0, -1, 0}));
    CHECK(same(before[0], Vec{}));
    CHECK(same(now[1], Vec{}));
  }
}

TEST_CASE("the guess moves a prescribed vertex that touches in its first round alone", "[unit]") {
  for (const int rounds : {0, 1}) {
    Line line;
    line.control.rounds = rounds;
    line.number[0] = 0;
    line.target[0] = {0.125f, 0.125f, 0};
    line.guess(true);
    CHECK(same(line.position[0], rounds == 0 ? line.target[0] : line.previous[0]));
  }
}

TEST_CASE("in a frame that stopped no vertex moves and none is counted", "[unit]") {
  Line line;
  line.guess_vertex(true)(1);
  CHECK(line.position[1].x == 0);
  CHECK(line.control.cut == 0);
}

TEST_CASE("a step begins at its start with targets by mobility and the largest move", "[unit]") {
  const Vec start[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, velocity[3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const int number[3] = {-1, 0, -2};
  const Vec targets[2] = {{9, 9, 9}, {1, 0, 0.5f}};
  Vec position[3], target[3], taken[3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  StepControl control;
  control.active = 1;
  control.steps_done = 1;
  BeginStep{&control, ControlSettings{}}(0);
  const BeginVertex begin{.start = start,
                          .velocity = velocity,
                          .prescribed_number = number,
                          .prescribed_targets = targets,
                          .prescribed_count = 1,
                          .acceleration = {0, -10, 0},
                          .step = 0.1f,
                          .position = position,
                          .target = target,
                          .taken = taken,
                          .control = &control};
  for (int v = 0; v < 3; ++v) begin(v);
  for (const Vec& nothing : taken) CHECK(same(nothing, Vec{}));
  CHECK(target[0].z == 0.1f);
  CHECK(target[0].y == Approx(-0.1));
  CHECK(target[1].z == 0.5f);
  CHECK(target[2].x == 2);
  CHECK(target[2].z == 0);
  CHECK(position[1].x == 1);
  CHECK(float_from_bits(control.largest_move) == 0.5f);
}

TEST_CASE("regions are certified before they are replaced, but not those of an earlier step", "[unit]") {
  for (const int rounds : {0, 1}) {
    Line line;
    line.control.rounds = rounds;
    line.position[1].x = 0.2500001f;
    for (int v = 0; v < 3; ++v)
      BeginRegions{line.position, {line.previous, line.bound}, line.previous, &line.control}(v);
    CHECK(line.control.violations == rounds);
    CHECK(line.previous[1].x == 0.2500001f);
  }
}
