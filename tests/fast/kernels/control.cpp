#include "fast/kernels/control.hpp"

#include <cmath>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

StepControl running() {
  StepControl c;
  c.active = 1;
  BeginStep{&c, ControlSettings{}}(0);
  return c;
}

}  // namespace

TEST_CASE("another round of the guess needs enough cut vertices and a round left", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 3;
  settings.guess_rounds = 2;
  StepControl c = running();
  CHECK(c.guess == 1);
  c.cut = 3;
  EndRound{&c, settings}(0);
  CHECK(c.guess == 1);
  CHECK(c.cut == 0);
  c.cut = 3;
  EndRound{&c, settings}(0);
  CHECK(c.guess == 0);  // no round left
  c = running();
  c.cut = 2;
  EndRound{&c, settings}(0);
  CHECK(c.guess == 0);  // too few cut vertices
}

TEST_CASE("round k of the guess asks for another where k γ_e K vertices were cut, at least one", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 2.5;
  constexpr int least[] = {3, 5, 8, 10, 13};  // ⌈2.5 k⌉
  for (const int last : {1, 2, 5}) {
    StepControl c = running();
    for (int k = 1; k <= last; ++k) {
      CHECK(c.guess == 1);
      c.cut = least[k - 1] - (k < last ? 0 : 1);
      EndRound{&c, settings}(0);
    }
    CHECK(c.guess == 0);
    CHECK(c.rounds == last);
  }
  settings.redetect_vertices = 0;
  CHECK(settings.least_cut(7) == 1);
}

TEST_CASE("an iteration asks for a detection at the threshold or when it is due, and says how many were cut",
          "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  StepControl c = running();
  const int overflow = 0;
  const auto iterate = [&](int cut) {
    c.cut = cut;
    EndIteration{&c, settings}(0);
    const int asked = c.detect;
    if (asked != 0) EndDetection{&c, &overflow}(0);
    return asked;
  };
  CHECK(iterate(4) == 0);
  CHECK(c.cut_last == 4);
  CHECK(iterate(5) == 1);
  CHECK(c.detect == 0);
  settings.detection_every = 2;
  CHECK(iterate(0) == 0);
  CHECK(iterate(0) == 1);
  CHECK(c.detections == 2);
  CHECK(c.iterations == 4);
}

TEST_CASE("within detection_gap iterations of a detection neither cuts, lags nor deep vertices ask", "[unit]") {
  ControlSettings settings;
  settings.detection_gap = 3;
  StepControl c = running();
  const int overflow = 0;
  const auto iterate = [&] {
    c.cut = 2;
    c.deep_inside = 1;
    c.count_lag(false);
    EndIteration{&c, settings}(0);
    const int asked = c.detect;
    if (asked != 0) EndDetection{&c, &overflow}(0);
    CHECK(c.cut + c.lagging + c.deep_inside == 0);
    return asked;
  };
  CHECK(iterate() + iterate() == 0);
  CHECK(c.lag_asked == 0);  // a lag that was not heard may still cause its one detection
  CHECK(iterate() == 1);
  CHECK(iterate() + iterate() == 0);
  settings.detection_every = 3;
  settings.detection_gap = 5;
  CHECK(iterate() == 1);
}

TEST_CASE("a deep vertex makes a single cut ask, unless the setting forbids it", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  StepControl c = running();
  const auto asks = [&](int cut) {
    c.cut = cut;
    c.deep_inside = 1;
    EndIteration{&c, settings}(0);
    CHECK(c.cut + c.deep_inside == 0);
    return c.detect;
  };
  CHECK(asks(0) == 0);
  CHECK(asks(1) == 1);
  settings.deep_asks = false;
  CHECK(asks(1) == 0);
  CHECK(asks(5) == 1);
}

TEST_CASE("a prescribed vertex that lags asks alone where it advances, and once a step where it does not", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  StepControl c = running();
  const int overflow = 0;
  const auto iterate = [&](bool advances) {
    c.count_lag(advances);
    EndIteration{&c, settings}(0);
    const int asked = c.detect;
    if (asked != 0) EndDetection{&c, &overflow}(0);
    return asked;
  };
  CHECK(iterate(true) == 1);
  CHECK(c.cut_last == 1);
  CHECK(iterate(true) == 1);
  CHECK(iterate(false) == 0);  // a lag without advance causes one detection a step
  c = running();
  CHECK(iterate(false) == 1);
  CHECK(iterate(false) == 0);
  CHECK(iterate(true) == 1);
}

TEST_CASE("iterations take turns, none while a detection is due, and after the last no detection is", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  settings.iterations = 3;
  StepControl c = running();
  const int overflow = 0;
  CHECK(c.turn == 0);
  EndIteration{&c, settings, 1}(0);  // not its turn
  CHECK(c.iterations == 0);
  EndIteration{&c, settings, 0}(0);
  CHECK(c.turn == 1);
  c.cut = 5;
  EndIteration{&c, settings, 1}(0);
  CHECK(c.detect == 1);
  CHECK(c.turn == -1);
  c.cut = 2;
  EndIteration{&c, settings, 2}(0);
  CHECK(c.iterations == 2);
  CHECK(c.cut == 2);
  EndDetection{&c, &overflow}(0);
  CHECK(c.turn == 2);
  c.cut = 7;
  EndIteration{&c, settings, 2}(0);
  CHECK(c.iterations == 3);
  CHECK(c.cut_last == 7);
  CHECK(c.detect == 0);
}

TEST_CASE(
    "an iteration settles a step where nothing moved, was cut or lags and no detection is due; none has a turn after "
    "it",
    "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  settings.detection_gap = 3;
  settings.iterations = 12;
  settings.settled_move = 1;
  StepControl c = running();
  const int overflow = 0;
  const auto iterate = [&] {
    EndIteration{&c, settings, c.iterations}(0);
    return c.turn >= settings.iterations;
  };
  c.note_move();
  CHECK_FALSE(iterate());
  CHECK(c.turn == 1);
  c.cut = 1;  // too few for a detection
  CHECK_FALSE(iterate());
  EndDetection{&c, &overflow}(0);
  c.cut = 5;  // enough, but too early for a detection
  CHECK_FALSE(iterate());
  CHECK(c.detect == 0);
  c.lag_asked = 1;
  c.count_lag(false);  // it has asked already, and can't move
  CHECK_FALSE(iterate());
  c.count_lag(true);  // too early for a detection
  CHECK_FALSE(iterate());
  settings.detection_every = 4;
  CHECK_FALSE(iterate());  // too few since the last detection
  CHECK(c.detect == 1);
}

TEST_CASE("a step that settles has neither a turn nor a detection left, and its turn tells the buffer of x", "[unit]") {
  const int overflow = 0;
  for (const int iterations : {6, 7})
    for (int last = 1; last <= iterations; ++last) {
      ControlSettings settings;
      settings.iterations = iterations;
      settings.settled_move = 1e-30f;
      StepControl c = running();
      for (int i = 0; i < last; ++i) {
        if (i + 1 < last) c.note_move();
        EndIteration{&c, settings, i}(0);
      }
      CHECK(c.iterations == last);
      CHECK(c.turn >= iterations);
      CHECK(c.turn <= iterations + 1);
      CHECK(c.turn % 2 == c.iterations % 2);
      CHECK(c.detect == 0);
      CHECK(c.moved == 0);
      for (int i = 0; i < iterations; ++i) EndIteration{&c, settings, i}(0);  // not their turn
      CHECK(c.iterations == last);
    }
  ControlSettings settings;
  settings.settled_move = 1;
  settings.detection_every = 2;
  StepControl c = running();
  c.note_move();
  EndIteration{&c, settings, 0}(0);
  EndIteration{&c, settings, 1}(0);  // a detection is due
  CHECK(c.turn == -1);
  EndDetection{&c, &overflow}(0);
  CHECK(c.turn == 2);
  EndIteration{&c, settings, 2}(0);
  CHECK(c.turn >= settings.iterations);
  c.note_move();
  BeginStep{&c, settings}(0);
  CHECK(c.moved == 0);
  settings.settled_move = 0;
  EndIteration{&c, settings, 0}(0);
  CHECK(c.turn == 1);
}

TEST_CASE("a list that was too small, a violation or a number that is not finite stops the step and all that follow",
          "[unit]") {
  const int overflow = 1, none = 0;
  StepControl c = running();
  EndDetection{&c, &overflow}(0);
  CHECK(c.status == compare::step_list_grew);
  CHECK(c.active == 0);
  CHECK(c.guess == 0);
  BeginStep{&c, ControlSettings{}}(0);
  CHECK(c.attempted == 0);
  CHECK(c.guess == 0);
  c = running();
  c.count_violation();
  EndDetection{&c, &none}(0);
  CHECK(c.status == compare::step_bound_violated);
  c = running();
  c.cut = 1000;
  c.count_not_finite();
  EndIteration{&c, ControlSettings{}}(0);
  CHECK(c.status == compare::step_not_finite);
  CHECK(c.detect == 0);
}

TEST_CASE("the trees are sorted in the first step and then every few steps, and not while steps are no-ops", "[unit]") {
  ControlSettings settings;
  settings.sort_every = 3;
  StepControl c;
  const auto sorts = [&] {
    BeginStep{&c, settings}(0);
    return c.sort;
  };
  CHECK(sorts() == 0);
  c.active = 1;
  std::vector<int> found;
  for (int step = 0; step < 7; ++step) found.push_back(sorts());
  CHECK((found == std::vector<int>{1, 0, 0, 1, 0, 0, 1}));
}

TEST_CASE("the query radius is the contact radius plus the largest move, up to its cap", "[unit]") {
  ControlSettings settings;
  settings.contact_radius = 0.005f;
  settings.largest_query_radius = 0.02f;
  StepControl c = running();
  c.largest_move = float_bits(0.001f);
  ChooseQueryRadius{&c, settings}(0);
  CHECK(c.query_radius == 0.005f + 0.001f);
  c.largest_move = float_bits(1.0f);
  ChooseQueryRadius{&c, settings}(0);
  CHECK(c.query_radius == 0.02f);
}

TEST_CASE("bits of non-negative floats have their order", "[property]") {
  const float ascending[] = {0, 1e-40f, 1e-20f, 0.5f, 1, 3, 1e30f};
  for (int i = 0; i + 1 < 7; ++i) CHECK(float_bits(ascending[i]) < float_bits(ascending[i + 1]));
  CHECK(float_from_bits(float_bits(0.1f)) == 0.1f);
}

TEST_CASE("each coordinate that is not a number or infinite is noticed", "[unit]") {
  CHECK(is_finite(Vec{1, -2, 0}));
  for (const float odd : {std::nanf(""), INFINITY, -INFINITY}) {
    CHECK_FALSE(is_finite(Vec{odd, 0, 0}));
    CHECK_FALSE(is_finite(Vec{0, odd, 0}));
    CHECK_FALSE(is_finite(Vec{0, 0, odd}));
  }
}

TEST_CASE("with a detection due after every iteration each one asks for it, and begins to count anew", "[unit]") {
  ControlSettings settings;
  settings.redetect_vertices = 5;
  settings.detection_every = 1;
  StepControl c = running();
  c.cut = 2;
  EndIteration{&c, settings}(0);
  CHECK(c.detect == 1);
  CHECK(c.cut == 0);
  settings.detection_every = 0;
  EndIteration{&c, settings}(0);
  CHECK(c.detect == 0);
}
