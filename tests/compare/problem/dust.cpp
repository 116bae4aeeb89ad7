#include "compare/problem/dust.hpp"

#include <cmath>
#include <limits>

#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/small_scene.hpp"

using namespace ogc::compare;
using ogc::tests::small_scene;

TEST_CASE("dust begins below 2⁻⁴⁰ of the largest coordinate, is counted, and becomes 0; nothing else changes",
          "[unit]") {
  const double least = 3 * 0x1p-40, below = std::nextafter(least, 0);
  Mesh mesh{{{3, least, -least}, {below, -below, 0}, {-0.0, 5e-324, 1}}, {{0, 1, 2}}, {}};
  const Dust dust = clear_dust(mesh);
  CHECK(dust.count == 3);
  CHECK(dust.largest == below);
  CHECK(mesh.positions == std::vector<Vec3>{{3, least, -least}, {0, 0, 0}, {0, 0, 1}});
  CHECK(clear_dust(mesh).count == 0);
  CHECK_THAT(describe(dust), ContainsSubstring("3 coordinates are dust") && ContainsSubstring("taken as 0"));
  CHECK_THAT(describe(dust, "kept"), ContainsSubstring("m): kept"));
  CHECK(describe(Dust{}).empty());
}

TEST_CASE(
    "the dust of a scene is measured by the largest coordinate of all bodies and of rest shapes, and counted once",
    "[unit]") {
  Scene scene = small_scene();
  scene.mesh.positions[0].y = scene.rest_positions[0].y =
      1e-13;  // above the limit of dust for a body of 0.1 m, but the scene's floor extends to ±1 m
  scene.mesh.positions[1].y = 2e-13;
  scene.rest_positions[1].y = 3e-13;
  const Dust dust = clear_dust(scene);
  CHECK(dust.count == 3);
  CHECK(dust.largest == 3e-13);
  CHECK(scene == small_scene());
  scene.rest_positions[2].x = 100;
  scene.mesh.positions[0].y = 2e-11;
  CHECK(clear_dust(scene).count == 1);
}

TEST_CASE("what is not finite is no measure of dust, and stays for validation to name", "[unit]") {
  Mesh mesh{{{1, 1e-16, 0},
             {std::numeric_limits<double>::infinity(), 0.5, 0},
             {std::numeric_limits<double>::quiet_NaN(), 0, 1}},
            {{0, 1, 2}},
            {}};
  CHECK(clear_dust(mesh).count == 1);
  CHECK(mesh.positions[1].y == 0.5);
  CHECK_THAT(describe(validate(mesh)), ContainsSubstring("vertex 1: position is not finite") &&
                                           ContainsSubstring("vertex 2: position is not finite"));
}

TEST_CASE("rounding to single precision makes no dust of what was none", "[property]") {
  for (const double largest : {1.0, 1 + 0x1p-24, 1 + 3 * 0x1p-25, 0.1, 1234.567, 0x1p-19}) {
    Mesh mesh{{{largest, 0, 0}}, {}, {}};
    for (int ulp = -3; ulp <= 3; ++ulp) mesh.positions.push_back({0, 0x1p-40 * largest * (1 + ulp * 0x1p-25), 0});
    clear_dust(mesh);
    mesh.positions = to_double(to_single(mesh.positions));
    CHECK(clear_dust(mesh).count == 0);
  }
}

TEST_CASE("a triangle that is degenerate without its dust is an error after it", "[unit]") {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 1e-16, 0}}, {{0, 1, 2}}, {}};
  CHECK(validate(mesh).empty());
  clear_dust(mesh);
  CHECK_THAT(describe(validate(mesh)), ContainsSubstring("zero area"));
}
