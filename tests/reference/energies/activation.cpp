// activation: smoothness where the stages meet, and what Eq. 19 as printed would do.
#include "reference/energies/activation.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace ogc;
using reference::activation_at;

TEST_CASE("activation: value, slope and curvature are continuous at τ", "[property]") {
  for (const double r : {1e-3, 0.005, 0.3, 1.0, 40.0}) {
    const double k = 1000, tau = r / 2;
    const auto quadratic = activation_at(tau, r, k), logarithmic = activation_at(std::nextafter(tau, 0.0), r, k);
    CHECK(quadratic.energy == Approx(k * tau * tau / 2).epsilon(1e-15));
    CHECK(quadratic.slope == Approx(-k * tau).epsilon(1e-15));
    CHECK(quadratic.curvature == k);
    CHECK(logarithmic.energy == Approx(quadratic.energy).epsilon(1e-14));
    CHECK(logarithmic.slope == Approx(quadratic.slope).epsilon(1e-14));
    CHECK(logarithmic.curvature == Approx(quadratic.curvature).epsilon(1e-14));
  }
}

TEST_CASE("activation: value and slope vanish at r, where the curvature jumps from k_c to 0", "[unit]") {
  const double r = 0.005, k = 100;
  const auto at = activation_at(r, r, k), below = activation_at(std::nextafter(r, 0.0), r, k);
  CHECK(at.energy == 0);
  CHECK(at.slope == 0);
  CHECK(at.curvature == 0);
  CHECK(below.energy <= 1e-30);
  CHECK(below.slope >= -1e-15);
  CHECK(below.curvature == k);
}

TEST_CASE("activation: slope and curvature are the derivatives of the energy in both stages", "[property]") {
  const double r = 0.01, k = 50;
  for (double d = 0.0005; d < r; d += 0.00037) {
    const double h = d * 1e-4;
    const auto low = activation_at(d - h, r, k), at = activation_at(d, r, k), high = activation_at(d + h, r, k);
    if (d - h < r / 2 && d + h >= r / 2) continue;
    CHECK((high.energy - low.energy) / (2 * h) == Approx(at.slope).epsilon(1e-6));
    CHECK((high.slope - low.slope) / (2 * h) == Approx(at.curvature).epsilon(1e-6));
  }
}

TEST_CASE("activation: Eq. 19 as printed gives another slope at τ unless r − τ is one unit of length", "[unit]") {
  const double r = 0.01, tau = r / 2, k = 50;
  const double printed = tau * k * (tau - r) * (tau - r), corrected = tau * k * (r - tau);
  const double quadratic_slope = activation_at(tau, r, k).slope;
  CHECK(-corrected / tau == Approx(quadratic_slope).epsilon(1e-14));
  CHECK(-printed / tau == Approx(quadratic_slope * (r - tau)).epsilon(1e-14));
}

TEST_CASE("activation: the two stages by hand, and their scales", "[unit]") {
  // r = 2, k = 3, τ = 1: k' = 3; d = 3/2: 3/2 · 1/4; d = 1/4: 3 ln 4 + 3/2.
  compare::ActivationIn in;
  in.distance = {1.5f, 0.25f, 2.0f};
  in.contact_radius = {2, 2, 2};
  in.stiffness = {3, 3, 3};
  const auto truth = reference::activation(in);
  CHECK(truth.energy[0] == 0.375);
  CHECK(truth.slope[0] == -1.5);
  CHECK(truth.curvature[0] == 3);
  CHECK(truth.energy[1] == Approx(3 * std::log(4.0) + 1.5).epsilon(1e-15));
  CHECK(truth.slope[1] == -12);
  CHECK(truth.curvature[1] == 48);
  CHECK(truth.energy_scale[1] == Approx(3 * std::log(4.0) + 1.5).epsilon(1e-15));
  CHECK(truth.slope_scale[1] == 12);
  CHECK(truth.energy[2] == 0);
  CHECK(truth.energy_scale[2] == 0);
}
