// Tests that differences from a local origin are exact, that single precision represents them, and that printed
// coordinates equal those of the file.
#include "compare/problem/local_origin.hpp"

#include <cmath>
#include <random>

#include "compare/problem/scene.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("a mesh near 0 for its size has no local origin, one far away an exact one in the far coordinates",
          "[unit]") {
  CHECK(local_origin({}) == Vec3{});
  CHECK(local_origin({{5e5, 0, 0}}) == Vec3{});  // a single point has no length
  CHECK(local_origin({{14, 0, 0}, {15, 1, 0}}) == Vec3{});
  CHECK(local_origin({{16, 0, 0}, {17, 1, 0}}) == Vec3{17, 0, 0});
  CHECK(local_origin({{512345.678, 3, 5403210.5}, {512445.678, 4, 5403300.25}}) == Vec3{512384, 0, 5403264});
  CHECK(local_origin({{0, 0, std::nan("")}, {1e9, 1, 0}}) == Vec3{});
  CHECK(describe_origin({{512345.5, 0, 0}, {512445.5, 1, 0}}, {512384, 0, 0}, "remedy") ==
        "coordinates lie 5.12e+05 m from 0, 5.12e+03 times the mesh's size: remedy");
  CHECK(describe_origin({}, {}, "remedy").empty());
}

TEST_CASE("coordinates with millimetres come back to their digits through single precision and a local origin",
          "[property]") {
  std::mt19937_64 random(13);
  std::vector<Vec3> positions;
  const auto draw = [&](double centre) {  // returns multiples of 0.001 within 50 m of the centre
    return std::round(1000 * centre + std::uniform_int_distribution<int>(-50000, 50000)(random)) / 1000;
  };
  for (int i = 0; i < 2000; ++i) positions.push_back({draw(512345), draw(150), draw(-5403210)});
  const Vec3 origin = local_origin(positions);
  CHECK(origin.x == 512320);
  CHECK(origin.y == 0);
  CHECK(origin.z == -5403200);
  const std::vector<Vec3> local = relative_to(origin, positions);
  for (std::size_t v = 0; v < local.size(); ++v) {
    CHECK(local[v].x + origin.x == positions[v].x);
    CHECK(local[v].z + origin.z == positions[v].z);
  }
  CHECK(in_file(origin, to_single(local)) == positions);
  CHECK(in_file({}, to_single(local)) == to_double(to_single(local)));
  // Relative to the origin, the length of an edge of 5 cm changes by at most 2⁻²³ of a box of 100 m, 1.2e-5 m. At 512
  // km an ulp of single precision is 0.03 m, so the length would be lost.
  const std::vector<Vec3f> edge = to_single(relative_to(origin, {{512345.1, 0, 0}, {512345.15, 0, 0}}));
  CHECK(std::abs(double{edge[1].x} - double{edge[0].x} - 0.05) < 100 * 0x1p-23);
  CHECK(std::abs(static_cast<double>(512345.15f) - static_cast<double>(512345.1f) - 0.05) > 0.01);
}
