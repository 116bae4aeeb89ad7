// Tests activation: smoothness where its quadratic and its logarithmic branch meet, and the consequence of Eq. 19 as
// printed.
#include "reference/energies/activation.hpp"

#include <array>
#include <cmath>

#include "reference/illustrations/activation_drawing.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using compare::ContactActivation;

namespace {

reference::ActivationValue activation_at(double d, double r, double k,
                                         ContactActivation kind = ContactActivation::ogc) {
  return reference::activation_at(kind, d, r, k);
}

constexpr std::array all_kinds{ContactActivation::ogc, ContactActivation::ogc_as_printed, ContactActivation::quadratic,
                               ContactActivation::ipc_log, ContactActivation::cubic};

}  // namespace

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

TEST_CASE("activation: slope and curvature are the derivatives of the energy, of every activation and in both stages",
          "[property]") {
  const double r = 0.01, k = 50;
  for (const ContactActivation kind : all_kinds)
    for (double d = 0.0005; d < r; d += 0.00037) {
      const double h = d * 1e-4;
      const auto low = activation_at(d - h, r, k, kind), at = activation_at(d, r, k, kind),
                 high = activation_at(d + h, r, k, kind);
      if ((d - h < r / 2 && d + h >= r / 2) || d + h >= r) continue;
      // Near r the cubic's slope tends to 0, but the error of the difference, h²/6 · 4k/r, does not.
      CHECK((high.energy - low.energy) / (2 * h) == Approx(at.slope).epsilon(1e-6).margin(1e-7 * k * r));
      CHECK((high.slope - low.slope) / (2 * h) == Approx(at.curvature).epsilon(1e-6).margin(1e-7 * k));
    }
}

TEST_CASE("activation: every variant repels below r, is convex, and ends at r with its slope", "[property]") {
  const double r = 0.01, k = 50;
  for (const ContactActivation kind : all_kinds) {
    for (double d = 1e-5; d < r; d += 0.00037) {
      const auto at = activation_at(d, r, k, kind);
      CHECK(at.energy > 0);
      CHECK(at.slope < 0);
      CHECK(at.curvature > 0);
    }
    CHECK(activation_at(r, r, k, kind).energy == 0);
    CHECK(std::abs(activation_at(r * (1 - 1e-12), r, k, kind).slope) < 1e-11 * k * r);
  }
}

TEST_CASE("activation: the variants by hand at half the radius", "[unit]") {
  // r = 2, k = 3, d = 1, so the depth is 1. Energy, slope, curvature: quadratic 3/2, −3, 3; cubic 2 · 3/6 = 1, −3, 6;
  // IPC 3 ln 2, −3 (2 ln 2 + 1), 3 (2 ln 2 + 4 + 1).
  const auto quadratic = activation_at(1, 2, 3, ContactActivation::quadratic),
             cubic = activation_at(1, 2, 3, ContactActivation::cubic);
  const auto barrier = activation_at(1, 2, 3, ContactActivation::ipc_log);
  CHECK(quadratic.energy == 1.5);
  CHECK(quadratic.slope == -3);
  CHECK(cubic.energy == Approx(1).epsilon(1e-15));
  CHECK(cubic.slope == Approx(-3).epsilon(1e-15));
  CHECK(cubic.curvature == Approx(6).epsilon(1e-15));
  CHECK(barrier.energy == Approx(3 * std::log(2.0)).epsilon(1e-15));
  CHECK(barrier.slope == Approx(-3 * (2 * std::log(2.0) + 1)).epsilon(1e-15));
  CHECK(barrier.curvature == Approx(3 * (2 * std::log(2.0) + 5)).epsilon(1e-15));
}

TEST_CASE("activation: Eq. 19 as printed gives another slope at τ unless r − τ is one unit of length", "[unit]") {
  const double r = 0.01, tau = r / 2, k = 50;
  const double printed = tau * k * (tau - r) * (tau - r), corrected = tau * k * (r - tau);
  const double quadratic_slope = activation_at(tau, r, k).slope, below = std::nextafter(tau, 0.0);
  CHECK(activation_at(below, r, k, ContactActivation::ogc_as_printed).slope == Approx(-printed / tau).epsilon(1e-12));
  CHECK(-corrected / tau == Approx(quadratic_slope).epsilon(1e-14));
  CHECK(-printed / tau == Approx(quadratic_slope * (r - tau)).epsilon(1e-14));
}

TEST_CASE("activation: the two stages by hand, and their scales", "[unit]") {
  // r = 2, k = 3, τ = 1, so k' = 3. The energy is 3/2 · 1/4 at d = 3/2 and 3 ln 4 + 3/2 at d = 1/4.
  compare::ActivationIn in;
  in.distance = {1.5f, 0.25f, 2.0f};
  in.contact_radius = {2, 2, 2};
  in.stiffness = {3, 3, 3};
  in.activation.assign(3, ContactActivation::ogc);
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

TEST_CASE("activation: IPC's curvature over OGC's at equal force", "[unit]") {
  // Here k_c = r = 1, f is the force, and κ is IPC's stiffness over k_c. For κ = 1 the largest ratio of the curvatures
  // is 3.35, at f = 1/2, where OGC's formula changes; at f = 0.02 it is 0.52. For small f the depth of IPC's contact is
  // √(f/(3κ)), and the ratio is κ √(12 f/κ). For large f OGC's curvature is 4 f² and IPC's is f²/κ, up to a logarithm.
  using reference::curvature_ratio;
  CHECK(curvature_ratio(0.5, 1) == Approx(3.35).margin(0.005));
  CHECK(curvature_ratio(0.02, 1) == Approx(0.52).margin(0.005));
  for (const double kappa : reference::stiffness_ratios) {
    CHECK(curvature_ratio(1e-8, kappa) == Approx(std::sqrt(12e-8 * kappa)).epsilon(1e-3));
    CHECK(curvature_ratio(1e9, kappa) == Approx(0.25 / kappa).epsilon(1e-5));
    for (double f = 1e-3; f < 1e2; f *= 1.3) CHECK(curvature_ratio(f, kappa) <= curvature_ratio(0.5, kappa));
  }
}

TEST_CASE("activation: the curves of the drawing are those of the energies", "[unit]") {
  const std::vector<reference::DrawingPanel> panels = reference::activation_drawing();
  REQUIRE(panels.size() == 2);
  REQUIRE(panels[1].layers.size() == reference::stiffness_ratios.size());
  for (std::size_t i = 0; i < reference::stiffness_ratios.size(); ++i)
    for (const auto& point : panels[1].layers[i].points)
      CHECK(point[1] == reference::curvature_ratio(point[0], reference::stiffness_ratios[i]));
  // Forces below k_c r/2 belong to OGC's quadratic branch, whose curvature is k_c = 1. So the ratio equals IPC's
  // curvature, which is a value of the first panel's layer ipc_log.
  const reference::DrawingLayer& ipc = panels[0].layers[3];
  REQUIRE(ipc.name == "ipc_log");
  for (std::size_t i = 280; i < 399; ++i) {  // 0.7 r and beyond: forces up to 0.34
    REQUIRE(ipc.points[i][1] < 0.5);
    CHECK(reference::curvature_ratio(ipc.points[i][1], 1) == Approx(ipc.values[i]).epsilon(1e-9));
  }
}
