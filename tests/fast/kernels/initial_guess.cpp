#include "fast/kernels/initial_guess.hpp"

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

// Three vertices on a line, targets 1, 1 and 0.1 away, bounds 0.25; the first is in a contact.
struct Line {
  Vec target[3] = {{1, 0, 0}, {1, 1, 0}, {0.1f, 2, 0}};
  Vec previous[3] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  Vec position[3] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  float bound[3] = {0.25f, 0.25f, 0.25f};
  int touched[3] = {1, 0, 0};
  StepControl control;

  void guess(bool hold) {
    control.active = 1;
    control.rounds = hold ? 1 : 0;
    for (int v = 0; v < 3; ++v) GuessVertex{target, {previous, bound}, touched, position, &control}(v);
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

TEST_CASE("from round 2 on a vertex in a contact stays and does not count", "[unit]") {
  Line line;
  line.guess(true);
  CHECK(line.position[0].x == 0);
  CHECK(line.position[1].x == 0.25f);
  CHECK(line.control.cut == 1);
}

TEST_CASE("in a frame that stopped no vertex moves and none is counted", "[unit]") {
  Line line;
  GuessVertex{line.target, {line.previous, line.bound}, line.touched, line.position, &line.control}(1);
  CHECK(line.position[1].x == 0);
  CHECK(line.control.cut == 0);
}

TEST_CASE("a step begins at its start with targets by mobility and the largest move", "[unit]") {
  const Vec start[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, velocity[3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const int number[3] = {-1, 0, -2};
  const Vec targets[2] = {{9, 9, 9}, {1, 0, 0.5f}};
  Vec position[3], target[3];
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
                          .control = &control};
  for (int v = 0; v < 3; ++v) begin(v);
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
