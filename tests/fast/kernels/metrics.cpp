// Tests the kernels that compute a step's metrics, because no stage judges them. All inputs are different.
#include "fast/kernels/metrics.hpp"

#include <array>
#include <cmath>

#include "fast/kernels/sums/step_sums.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

using Sums = std::array<double, sum_columns>;

// Holds one vertex of 3 kg that moved from (1, 2, 4) to (2, 5, 9) with the target (4, 9, 16). Steps have half a second,
// and the acceleration is (−1, 2, −10).
struct OneVertex {
  Vec position{2, 5, 9}, start{1, 2, 4}, target{4, 9, 16}, previous{1, 2, 4};
  PaddedVec before[2] = {PaddedVec{{2, 4, 11}}, PaddedVec{{2, 5, 10}}};  // the two buffers of the sweeps
  int sweeps = 3;                                                        // the third one read the first buffer
  float mass = 3, bound = 10;

  VertexTerm term(const int& prescribed) const {
    return {.position = &position,
            .before = {before, 1, &sweeps},
            .start = &start,
            .target = &target,
            .mass = &mass,
            .prescribed_number = &prescribed,
            .acceleration = {-1, 2, -10},
            .step = 0.5};
  }
  Sums terms(int prescribed) const {
    Sums sums{};
    term(prescribed)(0, sums.data());
    return sums;
  }
  StepControl checked(int prescribed) const {
    StepControl control;
    control.active = 1;
    BeginStep{&control, ControlSettings{}}(0);
    CheckVertex{&position, {&previous, &bound}, &target, &prescribed, &control}(0);
    return control;
  }
};

}  // namespace

TEST_CASE("kinetic and gravity energy and the momenta of a vertex", "[unit]") {
  const Sums sums = OneVertex{}.terms(-1);
  CHECK(sums[sum_kinetic] == 0.5 * 3 * (1 + 9 + 25) / 0.25);
  CHECK(sums[sum_gravity] == -3 * (-2.0 + 10 - 90));
  CHECK(sums[sum_lost] == 3 * -2.0);
  CHECK(sums[sum_lost + 1] == 3 * -4.0);
  CHECK(sums[sum_lost + 2] == 3 * -7.0);
  CHECK(sums[sum_moved] == 3 * 3.0);
  CHECK(sums[sum_moved + 1] == 3 * 7.0);
  CHECK(sums[sum_moved + 2] == 3 * 12.0);
  CHECK(sums[sum_last] == 3 * (1.0 + 4));
  CHECK(sums[sum_way] == 3 * (1.0 + 9 + 25));
}

TEST_CASE("the last motion of a step is that since the buffer which its last sweep read", "[unit]") {
  OneVertex vertex;
  for (const int sweeps : {1, 2, 7, 8}) {
    vertex.sweeps = sweeps;
    CHECK(vertex.terms(-1)[sum_last] == 3 * (sweeps % 2 == 0 ? 1.0 : 5.0));
  }
}

TEST_CASE("a vertex that is held has energies, and no momentum to lose", "[unit]") {
  for (const int prescribed : {-2, 0, 3}) {
    const Sums sums = OneVertex{}.terms(prescribed);
    CHECK(sums[sum_kinetic] == 210);
    CHECK(sums[sum_gravity] == 246);
    for (int k = sum_lost; k < sum_moved + 3; ++k) CHECK(sums[static_cast<std::size_t>(k)] == 0);
  }
}

TEST_CASE("terms of vertices add up", "[unit]") {
  Sums sums = OneVertex{}.terms(-1);
  const OneVertex other;
  const int prescribed = -1;
  other.term(prescribed)(0, sums.data());
  const Sums one = other.terms(-1);
  for (std::size_t k = 0; k < sums.size(); ++k) CHECK(sums[k] == 2 * one[k]);
}

TEST_CASE("the share of momentum lost is the quotient of two lengths, and 0 where nothing was to move", "[unit]") {
  Sums sums{};
  const std::array<double, 6> lengths{2, -3, 6, -4, 4, 7};  // two vectors, of lengths 7 and 9
  for (std::size_t k = 0; k < 6; ++k) sums[static_cast<std::size_t>(sum_lost) + k] = lengths[k];
  CHECK(momentum_lost(sums.data()) == Approx(7.0 / 9).epsilon(1e-15));
  for (std::size_t k = 0; k < 3; ++k) sums[sum_moved + k] = 0;
  CHECK(momentum_lost(sums.data()) == 0);
}

TEST_CASE(
    "at the end of a step the smallest bound, the lag of what is prescribed, and what broke its bound or is not finite",
    "[unit]") {
  OneVertex vertex;
  vertex.target = {4, 8, 15};  // (2, 3, 6) away, at distance 7
  StepControl control = vertex.checked(2);
  CHECK(control.smallest_bound == 10);
  CHECK(float_from_bits(control.largest_lag) == 7);
  CHECK(control.violations == 0);
  CHECK(control.not_finite == 0);
  CHECK(float_from_bits(vertex.checked(0).largest_lag) == 7);
  CHECK(float_from_bits(vertex.checked(-1).largest_lag) == 0);
  vertex.bound = 5.5f;  // it has moved by √35
  control = vertex.checked(-1);
  CHECK(control.smallest_bound == 5.5f);
  CHECK(control.violations == 1);
  vertex.position.y = HUGE_VALF;
  CHECK(vertex.checked(-1).not_finite == 1);
}

TEST_CASE("the row of a step holds what was counted; one that a list stopped or that was not begun writes none",
          "[unit]") {
  const int contacts[2] = {11, 12};
  ContactView view{};
  view.vertex_facet_count = &contacts[0], view.edge_edge_count = &contacts[1];
  std::array<double, guess_columns + sum_columns> sums{};
  double *const guess = sums.data(), *const end = guess + guess_columns;
  guess[sum_lost] = 1, guess[sum_moved] = 4;
  end[sum_lost] = 1, end[sum_moved] = 2;
  for (int k = 0; k < 2; ++k) end[sum_kinetic + k] = 20.0 + k;
  for (int k = 0; k < 4; ++k) end[sum_membrane + k] = 30 * std::pow(2.0, k);
  end[sum_last] = 1, end[sum_way] = 16;
  StepControl control;
  control.active = control.attempted = 1;
  control.steps_done = 1;
  control.detections = 3, control.rounds = 4, control.iterations = 5, control.cut_last = 6;
  control.query_radius = 7, control.smallest_bound = 8;
  control.largest_lag = float_bits(9.0f);
  StepRow rows[3];
  FinishStep{&control, view, sums.data(), rows}(0);
  CHECK(control.steps_done == 2);
  const StepRow& row = rows[1];
  CHECK(row.status == 0);
  CHECK(std::array{row.vertex_facet_contacts, row.edge_edge_contacts, row.detections, row.rounds, row.iterations,
                   row.cut_last} == std::array{11, 12, 3, 4, 5, 6});
  CHECK(std::array{row.query_radius, row.smallest_bound, row.largest_lag} == std::array{7.0f, 8.0f, 9.0f});
  CHECK(std::array{row.lost_guess, row.lost_end, row.kinetic, row.gravity, row.elastic, row.contact} ==
        std::array{0.25, 0.5, 20.0, 21.0, 90.0, 360.0});
  CHECK(row.last_motion == 0.25);
  control.status = compare::step_list_grew;
  FinishStep{&control, view, sums.data(), rows}(0);
  control.status = 0, control.attempted = 0;
  FinishStep{&control, view, sums.data(), rows}(0);
  CHECK(control.steps_done == 2);
  CHECK(rows[2].detections == 0);
  control.active = 0, control.attempted = 1;  // a step that failed: the next step overwrites its row
  FinishStep{&control, view, sums.data(), rows}(0);
  CHECK(control.steps_done == 2);
  CHECK(rows[2].detections == 3);
}

TEST_CASE("the row of a step with rods has their energy, mean and largest stretch, and nearest contact", "[unit]") {
  const int contacts[2] = {};
  ContactView view{};
  view.vertex_facet_count = &contacts[0], view.edge_edge_count = &contacts[1];
  std::array<double, guess_columns + sum_columns> sums{};
  double* const end = sums.data() + guess_columns;
  end[sum_membrane] = 1, end[sum_rod] = 2, end[sum_stretch] = 6;
  StepControl control;
  control.active = control.attempted = 1;
  control.longest_segment = float_bits(1.75f), control.nearest_contact = 0.25f;
  StepRow row;
  FinishStep{&control, view, sums.data(), &row, 4}(0);
  CHECK(std::array{row.elastic, row.mean_stretch} == std::array{3.0, 1.5});
  CHECK(std::array{row.largest_stretch, row.smallest_contact} == std::array{0.75f, 0.25f});
}

TEST_CASE("what a step leaves of forces: means over those that nothing holds, over all at its begin", "[unit]") {
  const int contacts[2] = {};
  ContactView view{};
  view.vertex_facet_count = &contacts[0], view.edge_edge_count = &contacts[1];
  const std::array<LeftForce, 4> forces{{{8, 1, 0.25f, 0}, {8, 3, 0.25f, 0}, {8, 100, 50, 1}, {8, 2, 0.25f, 0}}};
  std::array<double, left_columns> left{};
  for (int chunk = 0; chunk < 3; ++chunk) LeftSums{forces.data(), 4}.add(chunk, 3, left.data());
  const std::array<double, guess_columns + sum_columns> sums{};
  StepControl control;
  control.active = control.attempted = 1;
  StepRow row;
  const auto finish = [&](const double* of_step) {
    control.steps_done = 0;
    FinishStep{
        .control = &control, .contacts = view, .sums = sums.data(), .rows = &row, .left = of_step, .free_vertices = 4}(
        0);
  };
  finish(left.data());
  CHECK(row.left_residual == 2.0 / 8);
  CHECK(row.left_rounding == 0.25 / 8);
  CHECK(row.left_held == 1);
  finish(nullptr);
  CHECK(std::array{row.left_residual, row.left_rounding} == std::array{0.0, 0.0});
  left = {0, 1, 1, 4};  // no force to compare with and no free vertex: no quotient of zeros
  finish(left.data());
  CHECK(std::array{row.left_residual, row.left_rounding} == std::array{0.0, 0.0});
}
