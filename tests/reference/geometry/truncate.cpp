// Tests truncate: the flag is exact, truncated positions lie on the sphere, and other positions stay unchanged.
#include "reference/geometry/truncate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using compare::Vec3f;

TEST_CASE("truncate: a 3-4-5 displacement against bounds at, below and above its length", "[unit]") {
  compare::TruncateIn in;
  in.previous.assign(5, {1, 2, 7});
  in.position.assign(5, {4, 6, 7});
  in.position[4] = {1, 2, 7};
  in.bound = {5, std::nextafter(5.0f, 0.0f), 2.5f, 0, 0};
  const auto truth = reference::truncate(in);
  CHECK(truth.cut == std::vector<std::uint8_t>{0, 1, 1, 1, 0});
  CHECK(truth.grey == std::vector<std::uint8_t>{1, 1, 0, 0, 0});
  CHECK(truth.position[0] == compare::Vec3{4, 6, 7});
  CHECK(truth.position[2] == compare::Vec3{2.5, 4, 7});
  CHECK(truth.position[3] == compare::Vec3{1, 2, 7});
  CHECK(truth.position[4] == compare::Vec3{1, 2, 7});
}

TEST_CASE("truncate: truncated positions keep direction and have the bound's length", "[property]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> coordinate(-1, 1), exponent(-15, 5);
  compare::TruncateIn in;
  for (int i = 0; i < 2000; ++i) {
    const float scale = std::exp2(exponent(random));
    in.previous.push_back({coordinate(random), coordinate(random), coordinate(random)});
    in.position.push_back({in.previous.back().x + scale * coordinate(random),
                           in.previous.back().y + scale * coordinate(random), in.previous.back().z});
    in.bound.push_back(scale * 0.4f);
  }
  const auto truth = reference::truncate(in);
  int cut = 0;
  for (std::size_t i = 0; i < in.bound.size(); ++i) {
    const Vec3f &p = in.previous[i], &x = in.position[i];
    const double dx = truth.position[i].x - p.x, dy = truth.position[i].y - p.y, length = std::hypot(dx, dy);
    cut += truth.cut[i];
    if (truth.cut[i]) CHECK(length == Approx(in.bound[i]).margin(1e-15));
    if (!truth.cut[i]) CHECK(length <= in.bound[i]);
    const double turned = dx * (static_cast<double>(x.y) - p.y) - dy * (static_cast<double>(x.x) - p.x);
    const double rounding = 0x1p-52 * (std::abs(truth.position[i].x) + std::abs(truth.position[i].y));
    CHECK(std::abs(turned) <= rounding * std::hypot(x.x - p.x, x.y - p.y));
  }
  CHECK((cut > 500 && cut < 1950));
}

namespace {

/// Returns a move from the origin to (3, 0, 5), which the half-space z ≤ 1 limits.
compare::TruncateIn below_a_ceiling(float bound, const std::array<float, 6>& block, bool is_prescribed) {
  compare::TruncateIn in{{{0, 0, 0}}, {{3, 0, 5}}, {bound}};
  in.half_spaces = {{0, 1}, {{{0, 0, 1}, 1}}, {{0, 0, 0}}, {block}, {static_cast<std::uint8_t>(is_prescribed)}};
  return in;
}

void check_near(const compare::TruncateTruth& truth, const compare::Vec3& expected) {
  CHECK(truth.cut[0] == 1);
  CHECK(truth.grey[0] == 0);
  CHECK(std::abs(truth.position[0].x - expected.x) <= 1e-15);
  CHECK(std::abs(truth.position[0].y - expected.y) <= 1e-15);
  CHECK(std::abs(truth.position[0].z - expected.z) <= 1e-15);
  CHECK(truth.accepted[0] < 1e-3);
}

constexpr std::array<float, 6> leaning{2, 0, 1, 1, 0, 1};  // H⁻¹(0, 0, 1) = (−1, 0, 2)

}  // namespace

TEST_CASE("truncate: a vertex slides along a half-space in the metric of its block, then into the ball", "[unit]") {
  check_near(reference::truncate(below_a_ceiling(10, compare::inertia_block, false)), {3, 0, 1});
  check_near(reference::truncate(below_a_ceiling(10, leaning, false)), {5, 0, 1});
  const double share = 2 / std::sqrt(10.0);
  check_near(reference::truncate(below_a_ceiling(2, compare::inertia_block, false)), {3 * share, 0, share});
}

TEST_CASE("truncate: a prescribed vertex stops on its way", "[unit]") {
  check_near(reference::truncate(below_a_ceiling(10, leaning, true)), {3 * 0.2, 0, 1});
  compare::TruncateIn in = below_a_ceiling(10, leaning, true);
  in.half_spaces.current = {{3, 0, 0}};
  check_near(reference::truncate(in), {3, 0, 1});
  const double share = 0.5 / std::sqrt(34.0);
  check_near(reference::truncate(below_a_ceiling(0.5f, leaning, true)), {3 * share, 0, 5 * share});
}

TEST_CASE("truncate: beside a half-space a prescribed vertex goes on to its end, between two it may stop", "[unit]") {
  // The vertex starts at (0, 0, 1), on the boundary of z ≤ 1, and moves along x to the surface of the ball.
  compare::TruncateIn in = below_a_ceiling(2, leaning, true);
  in.previous = in.half_spaces.current = {{0, 0, 1}};
  in.position = {{3, 0, 1}};
  check_near(reference::truncate(in), {2, 0, 1});
  CHECK(reference::truncate(in).accepted[0] < 1e-5);
  in.half_spaces.items.push_back({{0, 0, -1}, -1});
  in.half_spaces.offsets[1] = 2;
  CHECK(reference::truncate(in).accepted[0] >= 2);
  CHECK(reference::truncate(in).accepted[0] < 2.00001);
}

TEST_CASE("truncate: where two half-spaces hold a vertex it may choose; inside of all it stays", "[unit]") {
  compare::TruncateIn in = below_a_ceiling(10, leaning, false);
  in.half_spaces.items.push_back({{1, 0, 0}, 2});
  in.half_spaces.offsets[1] = 2;
  compare::TruncateTruth truth = reference::truncate(in);
  CHECK(truth.cut[0] == 1);
  CHECK(truth.accepted[0] == std::numeric_limits<double>::infinity());
  in.position = {{1.5f, 0, 0.75f}};
  truth = reference::truncate(in);
  CHECK(truth.cut[0] == 0);
  CHECK(truth.position[0] == compare::Vec3{1.5, 0, 0.75});
  CHECK(truth.accepted[0] == 0);
}

TEST_CASE("truncate: the half-space decides exactly, and within the slack of double either way", "[unit]") {
  compare::TruncateIn in = below_a_ceiling(10, leaning, false);
  in.position = {{3, 0, 1}};
  CHECK(reference::truncate(in).cut[0] == 0);
  CHECK(reference::truncate(in).grey[0] == 1);
  in.position = {{3, 0, std::nextafter(1.0f, 2.0f)}};
  CHECK(reference::truncate(in).cut[0] == 1);
  CHECK(reference::truncate(in).grey[0] == 0);
  // n·x = 0.3f − 3 · 0.1f = 7·10⁻⁹ > 0. This exceeds the rounding error of double, though not of single precision.
  in.half_spaces.items = {{{0.1f, 0.2f, 0.3f}, 0}};
  in.position = {{-3, 0, 1}};
  CHECK(reference::truncate(in).cut[0] == 1);
  CHECK(reference::truncate(in).grey[0] == 0);
}
