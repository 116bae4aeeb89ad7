#include "fast/kernels/activation.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc::fast;

TEST_CASE("activation: value, slope and curvature join at tau, value and slope at r", "[unit]") {
  for (const float r : {0.002F, 0.005F, 1.0F}) {
    const float k = 100, tau = 0.5F * r, below = std::nextafter(tau, 0.0F);
    const double energy = 0.125 * k * r * r, slope = -0.5 * k * r;  // k/2 (r − τ)², −k (r − τ)
    CHECK(activation_energy(tau, r, k) == Approx(energy).epsilon(1e-6));
    CHECK(activation_energy(below, r, k) == Approx(energy).epsilon(1e-6));
    CHECK(activation_slope(tau, r, k).slope == Approx(slope).epsilon(1e-6));
    CHECK(activation_slope(below, r, k).slope == Approx(slope).epsilon(1e-6));
    CHECK(activation_slope(tau, r, k).curvature == k);
    CHECK(activation_slope(below, r, k).curvature == Approx(k).epsilon(1e-6));
    const float inside = std::nextafter(r, 0.0F);
    CHECK(activation_energy(inside, r, k) == Approx(0).margin(1e-10 * energy));
    CHECK(activation_slope(inside, r, k).slope == Approx(0).margin(1e-6 * -slope));
    CHECK(activation_energy(r, r, k) == 0);
    CHECK(activation_slope(r, r, k).curvature == 0);
  }
}

TEST_CASE("activation: slope and curvature are the derivatives of the energy in both stages", "[unit]") {
  const float r = 1, k = 3;
  for (const float d : {0.01F, 0.1F, 0.3F, 0.6F, 0.9F}) {
    const double step = 0.01 * d, low = d - step, high = d + step;
    const auto g = [&](double x) { return static_cast<double>(activation_energy(static_cast<float>(x), r, k)); };
    CHECK((g(high) - g(low)) / (2 * step) == Approx(activation_slope(d, r, k).slope).epsilon(1e-3));
    CHECK((g(high) - 2 * g(d) + g(low)) / (step * step) == Approx(activation_slope(d, r, k).curvature).epsilon(2e-2));
  }
}
