#include "fast/kernels/models/rod.hpp"

#include <random>

#include "fast/kernels/models/orientation.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;

Quat some_orientation(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return unit(Quat{normal(random), normal(random), normal(random), normal(random)});
}

Vec some_vector(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return {normal(random), normal(random), normal(random)};
}

double size(const Quat& q) {
  return std::sqrt(double{q.x} * q.x + double{q.y} * q.y + double{q.z} * q.z + double{q.w} * q.w);
}

}  // namespace

TEST_CASE("quaternions turn as their product says, back as their conjugates do, and units are units", "[property]") {
  std::mt19937 random(81);
  double worst = 0;
  for (int i = 0; i < 10000; ++i) {
    const Quat q = some_orientation(random);
    const Vec v = some_vector(random);
    const Quat by_product = q * pure(v) * conjugate(q);
    // Error limits, with u = 2⁻²⁴: each of two products errs by 8 u, the rotation by 14 u. The error of q's length, 8
    // u, counts twice.
    REQUIRE(length(turned(q, v) - Vec{by_product.x, by_product.y, by_product.z}) <= 46 * u * length(v));
    REQUIRE(length(turned_back(q, turned(q, v)) - v) <= 44 * u * length(v));
    worst = std::max(worst, std::abs(size(q) - 1));
  }
  CHECK(worst <= 4 * u);
}

TEST_CASE("the force of a segment is the slope of its energy, its block the slope of the force", "[property]") {
  std::mt19937 random(86);
  for (int i = 0; i < 1000; ++i) {
    const Quat q = some_orientation(random), start = some_orientation(random);
    const SegmentRest segment{{0, 1}, 0.5f, 3, 0.25f};
    const Vec before = some_vector(random);
    const std::vector<D3> x{wide(some_vector(random)), wide(some_vector(random))};
    // Returns a segment's vector v, rotated back by the segment's orientation `frame`.
    const auto seen = [](const Quat& frame, const D3& v) { return wide(turned_back(frame, narrow(v))); };
    const D3 strain_then = 2.0 * seen(start, wide(before));
    const auto energy = [&](const std::vector<D3>& at) {
      const D3 strain = 2.0 * (at[1] - at[0]), elastic = strain - wide(director(q)),
               changed = strain - wide(turned(q, narrow(strain_then)));
      return 0.5 * 3 * 0.5 * (dot(elastic, elastic) + 0.25 * dot(changed, changed));
    };
    const Vec direction = rod_rest_direction(segment, 0.25f, start, before);
    for (std::size_t end = 0; end < 2; ++end) {
      ForceAndBlock sum;
      add_rod(segment, 0.25f, static_cast<int>(end), narrow(x[1] - x[0]), q, direction, sum);
      // The energy is quadratic, so central differences err only by rounding: 2⁻⁵³ of the energy, divided by the step.
      const D3 slope = force_by_differences(energy, x, end, 1e-3);
      REQUIRE(length(wide(sum.force) - slope) <= 3 * 100 * u * (1 + length(x[1] - x[0]) + length(before)));
      REQUIRE(sum.block.xx == Approx(3 * 1.25 / 0.5));
      REQUIRE(std::abs(sum.block.xy) + std::abs(sum.block.xz) + std::abs(sum.block.yz) == 0);
    }
  }
}

TEST_CASE("a neighbour asks for the frame that stands to its own as at rest, its damped twin as at the start",
          "[property]") {
  std::mt19937 random(87);
  const float weight = 2, damping = 0.5f;
  for (int i = 0; i < 1000; ++i) {
    // `relative` is the neighbour's rotation relative to the segment: now, at rest, and at the start of the step. So
    // elastic force and damping both pull towards the present orientation `now`.
    const Quat now = some_orientation(random), own_start = some_orientation(random),
               relative = some_orientation(random), elsewhere = some_orientation(random);
    for (const bool is_ahead : {false, true}) {
      const auto beside = [&](const Quat& q) { return is_ahead ? q * relative : q * conjugate(relative); };
      const auto sum = [&](float k, const Quat& rest, const Quat& other_start) {
        Quat b{0, 0, 0, 0};
        add_neighbour({weight, rest}, is_ahead, k, beside(now), other_start, own_start, now, b);
        return b;
      };
      // Each product errs by 8 u (u = 2⁻²⁴), normalising by 4 u.
      CHECK(size(sum(0, relative, elsewhere) - weight * now) <= 20 * u * weight);
      CHECK(size(sum(damping, relative, beside(own_start)) - weight * (1 + damping) * now) <= 80 * u * weight);
      // The difference contains only the pull of damping, without the pull towards the relative rotation at rest.
      const Quat twin = sum(damping, elsewhere, beside(own_start)) - sum(0, elsewhere, elsewhere);
      CHECK(size(twin - weight * damping * now) <= 80 * u * weight);
    }
  }
}

TEST_CASE("where nothing decides the old orientation does", "[unit]") {
  const Quat old{0.6f, 0, 0, 0.8f}, none{0, 0, 0, 0};
  const Vec axis{0, 0, 1};
  const Quat stays = rod_orientation(1, {0, 0, 0}, axis, none, old);
  CHECK(size(stays - old) == 0);
  const Quat along = rod_orientation(1, {0, 2, 0}, axis, none, old);
  CHECK(length(director(along) - Vec{0, 1, 0}) <= 16 * u);
  // Here c = e₃, the direction that q rotates towards D, is opposite to D. All minimisers are then orthogonal to the
  // old orientation, the quaternion 1, and the minimiser nearest to the quaternion i is returned.
  const Quat reversed = rod_orientation(1, {0, 0, -1}, axis, none, {0, 0, 0, 1});
  CHECK(length(director(reversed) - Vec{0, 0, -1}) <= 16 * u);
  // With damping, c may be opposite to D along x. Then all minimisers are orthogonal to i, too, and the minimiser
  // nearest to j is returned.
  const Quat across = rod_orientation(1, {2, 0, 0}, {-1, 0, 0}, none, {0, 0, 0, 1});
  CHECK(size(across - Quat{0, 1, 0, 0}) <= 4 * u);
  CHECK(length(turned(across, {-1, 0, 0}) - Vec{1, 0, 0}) <= 16 * u);
  // neighbours only
  const Quat alone = rod_orientation(1, {0, 0, 0}, axis, {0, 3, 4, 0}, old);
  CHECK(size(alone - Quat{0, 0.6f, 0.8f, 0}) <= 4 * u);
  // The neighbours' pull towards a reversed director is weaker than the stretch, so the twist of the old orientation
  // stays.
  const Quat held = rod_orientation(1, {0, 0, 1}, axis, {0.1f, 0, 0, 0}, {0, 0, 0.6f, 0.8f});
  CHECK(std::abs(size(held) - 1) <= 4 * u);
  CHECK(held.z / held.w == Approx(0.75));
  CHECK(held.x == Approx(0.1 / 4));
}
