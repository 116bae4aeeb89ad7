// Tests the judge of a sweep: legal positions, and verdicts on answers with a truth written by hand.
#include "compare/judge/engine/sweep_question.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/stages/verdict.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("a position brought back to its bound obeys it exactly and is not far from it", "[property]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1, 1), exponent(-12, 3);
  for (int i = 0; i < 5000; ++i) {
    const Vec3f previous{unit(random), unit(random), unit(random)};
    const float bound = std::exp2(exponent(random)), far = std::exp2(exponent(random));
    const Vec3f wish{previous.x + far * unit(random), previous.y + far * unit(random), previous.z + far * unit(random)};
    const Vec3f x = within_bound(wish, previous, bound);
    REQUIRE(obeys_bound(x, previous, bound));
    if (obeys_bound(wish, previous, bound))
      REQUIRE(x == wish);
    else
      REQUIRE(std::hypot(x.x - previous.x, x.y - previous.y, x.z - previous.z) >= 0.99 * bound - 1e-6);
  }
}

namespace {

/// Holds two free vertices of a question without stencils, and a right answer in which the second vertex is cut.
struct Judged {
  Scene scene;
  RestStateOut rest;
  std::vector<Index> colour{0, 1};
  std::vector<Vec3f> zero{{}, {}}, target{{0.5f, 0, 0}, {2, 0, 0}};
  std::vector<float> bound{1, 1};
  SweepOut out{{{0.5f, 0, 0}, {1, 0, 0}}, 1};
  SweepTruth truth{{{0.5, 0, 0}, {1, 0, 0}}, {1e-6, 1e-6}, {0, 0}, 1, 0};
  TestCase test{{Stage::sweep, "sheets", 1, 0, "", {}}, SweepCase{}};

  Judged() { scene.mesh.positions.resize(2); }
  std::uint64_t mismatches() const {
    const SweepIn in{&scene, nullptr, &rest, colour, zero, zero, target, zero, bound, {}, {}};
    Tally tally(Stage::sweep);
    if (can_judge_sweep(test, in, out, tally)) judge_sweep(test, in, truth, out, tally);
    return tally.mismatched;
  }
};

}  // namespace

TEST_CASE("a right sweep passes; one beyond a bound, off its truth, miscounted, unfinished or not finite does not",
          "[unit]") {
  Judged judged;
  REQUIRE(judged.mismatches() == 0);
  judged.out.position[1].x = std::nextafter(1.0f, 2.0f);
  CHECK(judged.mismatches() == 1);
  judged = {};
  judged.out.position[0].y = 2e-6f;
  CHECK(judged.mismatches() == 1);
  judged = {};
  judged.out.cut = 2;
  CHECK(judged.mismatches() == 1);
  judged.truth.cut_doubtful = 1;
  CHECK(judged.mismatches() == 0);
  judged = {};
  judged.truth.accepted = {0, 0};
  CHECK(judged.mismatches() == 0);
  judged.out.position[0].z = std::numeric_limits<float>::denorm_min();
  CHECK(judged.mismatches() == 1);
  judged = {};
  judged.out.position.pop_back();
  CHECK(judged.mismatches() == 1);
  judged = {};
  judged.out.position[0].x = std::numeric_limits<float>::quiet_NaN();
  CHECK(judged.mismatches() == 1);
}
