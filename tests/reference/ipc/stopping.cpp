// Tests which bodies define the length to which the tolerance of a step is relative.
#include "reference/ipc/stopping.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("IPC: a tolerance is a share of the smallest body that moves freely, whatever is around it", "[unit]") {
  compare::Scene scene;
  scene.name = "sheets";
  add_sheet(scene, 5, 0.2, 0, false);
  const double own = std::sqrt(2.0) * 0.2;
  CHECK(reference::moving_diagonal(scene) == Approx(own).epsilon(1e-6));
  add_sheet(scene, 2, 50, -1, true);  // fixed
  CHECK(reference::moving_diagonal(scene) == Approx(own).epsilon(1e-6));
  add_sheet(scene, 3, 7, 90, false);  // far away, larger
  CHECK(reference::moving_diagonal(scene) == Approx(own).epsilon(1e-6));
  CHECK(reference::rest_diagonal(scene) > 90);
  add_sheet(scene, 2, 0.1, 1, false);  // driven as a whole, smaller
  compare::PrescribedMotion motion;
  motion.vertices = {38, 39, 40, 41};
  scene.motions.push_back(motion);
  CHECK(reference::moving_diagonal(scene) == Approx(own).epsilon(1e-6));
  CHECK(reference::ipc_end_speed(scene) == Approx(0.01 * own).epsilon(1e-6));
  set_setting(scene.settings, "ipc_stopping", "velocity");
  CHECK(reference::ipc_end_speed(scene) == Approx(1e-3));
}

TEST_CASE("IPC: where nothing moves freely the tolerance is a share of the whole scene", "[unit]") {
  compare::Scene scene;
  scene.name = "fixed";
  add_sheet(scene, 3, 2, 0, true);
  CHECK(reference::moving_diagonal(scene) == Approx(std::sqrt(8.0)).epsilon(1e-6));
}
