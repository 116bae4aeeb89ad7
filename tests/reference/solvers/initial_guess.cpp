#include "reference/solvers/initial_guess.hpp"

#include <cmath>
#include <cstdint>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using compare::InitialGuessCase;

namespace {

compare::InitialGuessTruth truth_of(const InitialGuessCase& c) { return reference::initial_guess({{c}}); }

}  // namespace

TEST_CASE("initial guess: free fall and a throw, with the moduli of their terms", "[unit]") {
  InitialGuessCase c;
  c.start = {1, 2, -3};
  c.velocity = {4, 0, 1};
  c.acceleration = {0, -8, 0};
  c.time_step = 0.5f;
  const auto truth = truth_of(c);
  CHECK(truth.target[0] == compare::Vec3{3, 0, -2.5});
  CHECK(truth.target_scale[0] == 4);
}

TEST_CASE("initial guess: what cancels is not lost", "[unit]") {
  InitialGuessCase c;
  c.start = {1, 0, 0};
  c.velocity = {-2, 0, 0};
  c.acceleration = {0x1p-40f, 0, 0};
  c.time_step = 0.5f;
  CHECK(truth_of(c).target[0].x == 0x1p-42);
}

TEST_CASE("initial guess: exact on numbers of few bits, where integers can count", "[property]") {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> number(-1000, 1000);
  for (int k = 0; k < 1000; ++k) {
    const int x = number(random), v = number(random), a = number(random), shift = 1 + k % 12;
    InitialGuessCase c;
    c.start.y = static_cast<float>(x);
    c.velocity.y = static_cast<float>(v);
    c.acceleration.y = static_cast<float>(a);
    c.time_step = std::ldexp(1.0f, -shift);
    const std::int64_t scaled = (std::int64_t{x} << 2 * shift) + (std::int64_t{v} << shift) + a;
    REQUIRE(truth_of(c).target[0].y == std::ldexp(static_cast<double>(scaled), -2 * shift));
  }
}
