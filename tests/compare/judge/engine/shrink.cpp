#include "compare/judge/engine/shrink.hpp"

#include <algorithm>

#include "compare/judge/cases/generators.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

bool has_triangle(const MeshCase& mesh, const std::array<Vec3f, 3>& points) {
  return std::any_of(mesh.topology->triangles.begin(), mesh.topology->triangles.end(), [&](const Triangle& t) {
    return mesh.positions[t[0]] == points[0] && mesh.positions[t[1]] == points[1] && mesh.positions[t[2]] == points[2];
  });
}

std::array<Vec3f, 3> points_of(const MeshCase& mesh, const Triangle& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

}  // namespace

TEST_CASE("shrinking a mesh keeps the two triangles that fail and drops all others with their vertices", "[property]") {
  for (std::uint64_t index = 0; index < 20; ++index) {
    const TestCase test = generate({Stage::detect_vertex_facet, "soup", 3, index, "", {}});
    const MeshCase& mesh = case_of<MeshCase>(test.data);
    if (mesh.topology->triangles.size() < 4) continue;
    const auto first = points_of(mesh, mesh.topology->triangles[1]),
               second = points_of(mesh, mesh.topology->triangles.back());
    const TestCase small = shrink(test, [&](const TestCase& candidate) {
      const MeshCase& c = case_of<MeshCase>(candidate.data);
      return has_triangle(c, first) && has_triangle(c, second);
    });
    const MeshCase& kept = case_of<MeshCase>(small.data);
    REQUIRE(kept.topology->triangles.size() == 2);
    REQUIRE(primitive_count(small) == 2);
    REQUIRE(kept.positions.size() <= 6);
    REQUIRE(kept.rigid_groups.size() == kept.positions.size());
    REQUIRE(kept.contact_radius > 0);
    REQUIRE(kept.contact_radius <= kept.query_radius);
    REQUIRE(small.name == test.name);
  }
}

TEST_CASE("shrinking bound keeps the distances of what is kept", "[property]") {
  const TestCase test = generate({Stage::bound, "soup", 3, 1, "", {}});
  const BoundCase& all = case_of<BoundCase>(test.data);
  const float smallest = *std::min_element(all.d_min_triangle.begin(), all.d_min_triangle.end());
  const TestCase small = shrink(test, [&](const TestCase& candidate) {
    const auto& distances = case_of<BoundCase>(candidate.data).d_min_triangle;
    return std::find(distances.begin(), distances.end(), smallest) != distances.end();
  });
  const BoundCase& kept = case_of<BoundCase>(small.data);
  REQUIRE(kept.topology->triangles.size() == 1);
  REQUIRE(kept.d_min_vertex.size() == 3);
  REQUIRE(kept.d_min_edge.size() == 3);
  REQUIRE(kept.d_min_triangle == std::vector<float>{smallest});
}

TEST_CASE("shrinking leaves coordinates with as few digits as the failure allows", "[property]") {
  const TestCase test = generate({Stage::closest_face, "uniform", 3, 7, "", {}});
  const float limit = case_of<ClosestFaceCase>(test.data).point.z;
  const TestCase small = shrink(test, [&](const TestCase& candidate) {
    const float z = case_of<ClosestFaceCase>(candidate.data).point.z;
    return std::abs(z) >= std::abs(limit) / 2 && z * limit > 0;
  });
  const ClosestFaceCase& c = case_of<ClosestFaceCase>(small.data);
  REQUIRE(c.point.x == 0);
  REQUIRE(c.triangle == std::array<Vec3f, 3>{});
  int exponent = 0;
  REQUIRE(std::abs(std::frexp(c.point.z, &exponent)) == 0.5f);  // one binary digit
}

TEST_CASE("a case that fails in no smaller form comes back as it is", "[property]") {
  for (const char* stage : {"detect_edge_edge", "activation", "closest_points"}) {
    const TestCase test = generate(
        parse_problem(std::string("stage=") + stage +
                      " gen=" + (std::string(stage) == "detect_edge_edge" ? "soup" : "uniform") + " seed=3 index=2"));
    std::size_t asked = 0;
    const TestCase small = shrink(test, [&](const TestCase&) { return ++asked, false; }, {.tries = 50});
    REQUIRE(asked <= 50);
    REQUIRE(primitive_count(small) == primitive_count(test));
  }
}
