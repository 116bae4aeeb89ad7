// Compares the loss of the guess loop with values computed by hand. The loss is relative to Σ m ‖y − xᵗ‖, so it is
// valid even if opposite momenta cancel.
#include "experiments/program/runs/momentum_share.hpp"

#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::experiments;

namespace {

/// Returns two equal sheets of 3 × 3 vertices, far apart, without gravity.
compare::Scene two_sheets() {
  compare::Scene scene;
  scene.name = "two_sheets";
  append_body(scene, {.name = "left", .material = {}}, grid(3, 1, 0));
  append_body(scene, {.name = "right", .material = {}}, grid(3, 1, 5));
  scene.gravity = {0, 0, 0};
  round_to_single(scene);
  return scene;
}

std::vector<compare::Vec3f> velocities(float left, float right) {
  std::vector<compare::Vec3f> all(9, {0, left, 0});
  all.insert(all.end(), 9, {0, right, 0});
  return all;
}

/// Returns a row of steps.csv with the largest number of guess rounds and with `lost`, the lost share of the net
/// momentum.
compare::StepMetrics row_of(std::int64_t step, double lost) {
  compare::StepMetrics row;
  row.step = step;
  row.guess_rounds = compare::Settings{}.guess_rounds;
  row.momentum_lost_guess = lost;
  return row;
}

}  // namespace

// One sheet moves up at 1 m/s, the other down at 0.9 m/s. The net momentum is (1 − 0.9)/(1 + 0.9), a nineteenth of the
// sum of moduli. If the whole motion down is lost, the loss is 0.9/0.1 of the net momentum and 0.9/1.9 of the sum of
// moduli.
TEST_CASE("what is lost is a share of what was to move, whatever cancels in the sum", "[unit]") {
  MomentumShare share(two_sheets());
  share.begin_after(4, velocities(1, -0.9f));
  CHECK(share.lost(row_of(5, 9)).value() == Approx(0.9 / 1.9).epsilon(1e-6));
  share.begin_after(5, velocities(1, 1));
  CHECK(share.lost(row_of(6, 0.3)).value() == Approx(0.3).epsilon(1e-6));
}

TEST_CASE("nothing is said of steps whose start is not known, whose guess ended early, or in which nothing was to move",
          "[unit]") {
  MomentumShare share(two_sheets());
  share.begin_after(4, velocities(1, 1));
  CHECK(share.lost(row_of(4, 0.5)) == std::nullopt);
  CHECK(share.lost(row_of(6, 0.5)) == std::nullopt);
  compare::StepMetrics early = row_of(5, 0.5);
  --early.guess_rounds;
  CHECK(share.lost(early) == std::nullopt);
  share.begin_after(5, velocities(0, 0));
  CHECK(share.lost(row_of(6, 0)) == 0.0);
}

// In h = 10 ms gravity changes velocities by 98.1 mm/s, which cancels a motion up at 98.1 mm/s.
TEST_CASE("what gravity changes in the step is part of what was to move, and fixed bodies are not", "[unit]") {
  compare::Scene scene = two_sheets();
  scene.gravity = {0, -9.81, 0};
  MomentumShare share(scene);
  share.begin_after(0, velocities(0.0981f, 0));
  CHECK(share.lost(row_of(1, 1)).value() == Approx(1).epsilon(1e-5));
  scene.bodies[0].fixed = true;
  MomentumShare other(scene);
  other.begin_after(0, velocities(-50, 0));
  CHECK(other.lost(row_of(1, 0.25)).value() == Approx(0.25).epsilon(1e-5));
}
