#include "fast/kernels/ipc/barrier.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// b of the gap, from differences that do not cancel.
double barrier_of(double gap, double support) { return -(gap - support) * (gap - support) * std::log(gap / support); }

}  // namespace

TEST_CASE("barrier: slope and curvature are differences of the energy, with and without a thickness", "[unit]") {
  for (const float thickness : {0.0f, 0.125f, 2.0f})
    for (const double share : {1e-6, 0.01, 0.3, 0.7, 0.95}) {
      const float distance = 0.25f;
      const double support = distance * (distance + 2.0 * thickness), square = double{thickness} * thickness;
      const auto squared = static_cast<float>(square + share * support);
      const double gap = double{squared} - square, step = 1e-4 * std::min(gap, support - gap);
      const BarrierValue b = ipc_barrier(squared, distance, thickness);
      const double before = barrier_of(gap - step, support), here = barrier_of(gap, support),
                   after = barrier_of(gap + step, support);
      CHECK(b.energy == Approx(here).epsilon(1e-5));
      CHECK(b.slope == Approx((after - before) / (2 * step)).epsilon(1e-5));
      CHECK(b.curvature == Approx((after - 2 * here + before) / (step * step)).epsilon(1e-4));
    }
}

TEST_CASE("barrier: ends at its support, without a jump of value, slope or curvature", "[unit]") {
  const float end = 0.0625f;  // of d̂ = 0.25
  CHECK(ipc_barrier(end, 0.25f, 0).curvature == 0);
  CHECK(ipc_barrier(2 * end, 0.25f, 0).energy == 0);
  const BarrierValue inside = ipc_barrier(std::nextafter(end, 0.0f), 0.25f, 0);
  CHECK(inside.energy > 0);
  CHECK(inside.slope < 0);
  CHECK(inside.curvature > 0);
  CHECK(inside.curvature < 1e-6f);
}
