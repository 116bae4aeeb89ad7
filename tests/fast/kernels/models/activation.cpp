#include "fast/kernels/models/activation.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

constexpr ContactActivation all_kinds[]{ContactActivation::ogc, ContactActivation::ogc_as_printed,
                                        ContactActivation::quadratic, ContactActivation::ipc_log,
                                        ContactActivation::cubic};

float energy_of(float d, float r, float k, ContactActivation kind = ContactActivation::ogc) {
  return AnyActivation{kind}.energy(d, r, k);
}
ActivationSlope slope_of(float d, float r, float k, ContactActivation kind = ContactActivation::ogc) {
  return AnyActivation{kind}.slope(d, r, k);
}

}  // namespace

TEST_CASE("activation: value, slope and curvature join at tau, value and slope at r", "[unit]") {
  for (const float r : {0.002F, 0.005F, 1.0F}) {
    const float k = 100, tau = 0.5F * r, below = std::nextafter(tau, 0.0F);
    const double energy = 0.125 * k * r * r, slope = -0.5 * k * r;  // k/2 (r − τ)², −k (r − τ)
    CHECK(energy_of(tau, r, k) == Approx(energy).epsilon(1e-6));
    CHECK(energy_of(below, r, k) == Approx(energy).epsilon(1e-6));
    CHECK(slope_of(tau, r, k).slope == Approx(slope).epsilon(1e-6));
    CHECK(slope_of(below, r, k).slope == Approx(slope).epsilon(1e-6));
    CHECK(slope_of(tau, r, k).curvature == k);
    CHECK(slope_of(below, r, k).curvature == Approx(k).epsilon(1e-6));
    const float inside = std::nextafter(r, 0.0F);
    CHECK(energy_of(inside, r, k) == Approx(0).margin(1e-10 * energy));
    CHECK(slope_of(inside, r, k).slope == Approx(0).margin(1e-6 * -slope));
    CHECK(energy_of(r, r, k) == 0);
    CHECK(slope_of(r, r, k).curvature == 0);
  }
}

TEST_CASE("activation: slope and curvature are the derivatives of the energy, of every activation and in both stages",
          "[unit]") {
  const float r = 1, k = 3;
  for (const ContactActivation kind : all_kinds)
    for (const float d : {0.01F, 0.1F, 0.3F, 0.6F, 0.9F}) {
      // A hundredth of the distance to the nearer end of the formula's range: a central difference is then wrong by
      // about 10⁻⁴.
      const double step = 0.01 * std::min(d, r - d), low = d - step, high = d + step;
      const auto g = [&](double x) { return static_cast<double>(energy_of(static_cast<float>(x), r, k, kind)); };
      const double noise = 0x1p-22 * g(d);  // a few roundings of the energy, and of d
      CHECK((g(high) - g(low)) / (2 * step) ==
            Approx(slope_of(d, r, k, kind).slope).epsilon(3e-3).margin(noise / step));
      CHECK((g(high) - 2 * g(d) + g(low)) / (step * step) ==
            Approx(slope_of(d, r, k, kind).curvature).epsilon(3e-2).margin(4 * noise / (step * step)));
    }
}

TEST_CASE("activation: no activation acts from r on, and each two differ below it", "[unit]") {
  const float r = 0.005F, k = 100;
  for (const ContactActivation kind : all_kinds) {
    CHECK(slope_of(r, r, k, kind).slope == 0);
    CHECK(energy_of(2 * r, r, k, kind) == 0);
    for (const ContactActivation other : all_kinds)
      if (kind != other) CHECK(slope_of(0.3F * r, r, k, kind).slope != slope_of(0.3F * r, r, k, other).slope);
  }
}
