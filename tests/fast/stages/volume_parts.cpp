// Tests in which order the trees of volumes hold facets and tetrahedra.
#include "fast/stages/volume_parts.hpp"

#include <algorithm>
#include <numeric>

#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;

TEST_CASE("the order of volumes is that of the rest positions, wherever the scene begins", "[unit]") {
  compare::Scene scene = test::empty_scene();
  append_body(scene, {.name = "block", .material = {}}, tests::block_mesh(4, 0.1));
  scene.bodies[0].contact = compare::BodyContact::volume;
  const compare::Topology topology = compare::build_topology(scene);
  const VolumeParts parts = volume_parts(scene, topology);
  REQUIRE(parts.size() == 1);
  REQUIRE(parts[0].facets.size() == topology.triangles.size());
  REQUIRE_FALSE(parts[0].tetrahedra.empty());
  std::vector<int> numbers(parts[0].tetrahedra.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  CHECK(std::ranges::is_permutation(parts[0].tetrahedra, numbers));
  CHECK_FALSE(std::ranges::is_sorted(parts[0].tetrahedra));
  for (compare::Vec3& x : scene.mesh.positions) x = {x.z, 2 * x.x, -x.y};
  const VolumeParts moved = volume_parts(scene, topology);
  REQUIRE(moved.size() == 1);
  CHECK(moved[0].facets == parts[0].facets);
  CHECK(moved[0].tetrahedra == parts[0].tetrahedra);
}
