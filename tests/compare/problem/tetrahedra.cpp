// Tests faces, boundary and orientation of tetrahedra, and each kind of problem that a solid can have.
#include "compare/problem/tetrahedra.hpp"

#include <algorithm>

#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"

using namespace ogc::compare;
using ogc::tests::block_mesh;
using ogc::tests::solid_scene;

namespace {

/// Returns two tetrahedra on both sides of the common face 1 2 3, with edges of length 1 and √2.
Mesh pair_of_tetrahedra() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {}, {}, {{0, 1, 2, 3}, {4, 1, 3, 2}}};
}

Scene scene_of(const Mesh& mesh) {
  Scene scene;
  scene.name = "solid";
  append_body(scene, {.name = "block", .material = {}}, mesh);
  return scene;
}

double signed_volume_under(const Mesh& mesh, const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface) {
    const Vec3 &p = mesh.positions[static_cast<std::size_t>(a)], &q = mesh.positions[static_cast<std::size_t>(b)],
               &r = mesh.positions[static_cast<std::size_t>(c)];
    sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
  }
  return sum / 6;
}

}  // namespace

TEST_CASE("the boundary is the faces of one tetrahedron, outward, by tetrahedron, then by the corner left out",
          "[unit]") {
  const std::vector<Triangle> alone = boundary_triangles(std::vector<Tetrahedron>{{5, 6, 7, 8}});
  CHECK(alone == std::vector<Triangle>{{6, 7, 8}, {5, 8, 7}, {5, 6, 8}, {5, 7, 6}});
  const Mesh two = pair_of_tetrahedra();
  CHECK(boundary_triangles(two.tetrahedra) ==
        std::vector<Triangle>{{0, 3, 2}, {0, 1, 3}, {0, 2, 1}, {4, 2, 3}, {4, 1, 2}, {4, 3, 1}});
  const Mesh block = block_mesh(3, 1);
  const std::vector<Triangle> surface = boundary_triangles(block.tetrahedra);
  CHECK(surface.size() == 48);
  CHECK(signed_volume_under(block, surface) == 8);
  const auto inside = [](const Triangle& t) { return std::ranges::count(t, 13) > 0; };
  CHECK(std::ranges::none_of(surface, inside));
}

TEST_CASE("orientation is exact: it tells one unit in the last place from none", "[unit]") {
  const Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  CHECK(orientation({}, a, b, c) == 1);
  CHECK(orientation({}, b, a, c) == -1);
  // The points lie in the plane x + y + z = 3·2²⁰. The terms of their determinant do not cancel in rounded arithmetic.
  const double big = 0x1p20, small = 0x1p-3;
  const Vec3 p{big, big, big}, q{big + 1, big - small, big + small - 1}, r{big - small, big + 2, big + small - 2};
  Vec3 s{big + 3, big - 7, big + 4};
  CHECK(orientation(p, q, r, s) == 0);
  s.z += 0x1p-4;
  const int above = orientation(p, q, r, s);
  s.z -= 0x1p-3;
  CHECK(above * orientation(p, q, r, s) == -1);
}

TEST_CASE("a solid's triangles are its boundary, and its scene has no problems", "[unit]") {
  const Scene scene = solid_scene();
  CHECK(validate(scene).empty());
  CHECK(scene.bodies[0].triangle_count == 48);
  CHECK(scene.bodies[0].is_solid());
  CHECK(validate(block_mesh(3, 0.1)).empty());
}

TEST_CASE("each kind of problem of a solid is named with its tetrahedron", "[unit]") {
  Mesh mesh = pair_of_tetrahedra();
  const auto check_only = [](const std::vector<Problem>& problems, const std::string& where, const std::string& what) {
    CHECK_THAT(describe(problems), ContainsSubstring(where) && ContainsSubstring(what));
    CHECK(problems.size() == 1);
  };
  SECTION("missing vertex") {
    mesh.tetrahedra[1][0] = 5;
    check_only(validate(mesh), "tetrahedron 1", "does not exist: 5");
  }
  SECTION("repeated vertex, not next to itself") {
    mesh.tetrahedra[0] = {0, 1, 0, 3};
    check_only(validate(mesh), "tetrahedron 0", "same vertex twice: vertex 0");
  }
  SECTION("the same tetrahedron twice") {
    mesh.tetrahedra.push_back({1, 0, 3, 2});
    CHECK_THAT(describe(validate(mesh)), ContainsSubstring("tetrahedron 2") &&
                                             ContainsSubstring("same vertices as another tetrahedron: tetrahedron 0"));
  }
  SECTION("a triangle of three tetrahedra") {
    mesh.positions.push_back({3, 1, 1});
    mesh.tetrahedra.push_back({5, 1, 3, 2});
    check_only(validate(mesh), "tetrahedron 2",
               "has a face that two other tetrahedra have: vertices 1, 2, 3 of tetrahedron 0 (vertices 0, 1, 2, 3) and "
               "tetrahedron 1");
  }
  SECTION("two on one side") {
    mesh.tetrahedra[1] = {4, 1, 2, 3};
    check_only(validate(mesh), "tetrahedron 1",
               "lies on the same side of a face as another tetrahedron: vertices 1, 2, 3");
  }
  SECTION("flat at rest") {
    mesh.positions[4] = {1.0 / 4, 1.0 / 4, 1.0 / 2};
    check_only(validate(scene_of(mesh)), "tetrahedron 1 of body 'block'", "is flat at rest");
  }
  SECTION("as good as flat at rest: its rest data would overflow") {
    for (Vec3& p : mesh.positions) p = {0x1p16 * p.x, 0x1p16 * p.y, 0x1p16 * p.z};
    mesh.tetrahedra.resize(1);
    mesh.positions.resize(4);
    mesh.positions[3] = {0x1p16, 0x1p16, 0x1p-46};
    check_only(validate(scene_of(mesh)), "tetrahedron 0 of body 'block'", "is flat at rest");
  }
  SECTION("inverted at rest") {
    mesh.positions[4] = {0.125, 0.125, 0.125};
    check_only(validate(scene_of(mesh)), "tetrahedron 1 of body 'block'", "is inverted at rest");
  }
  SECTION("inverted at the start alone is legal") {
    Scene scene = scene_of(mesh);
    scene.mesh.positions[4] = {0.125, 0.125, 0.125};
    CHECK(validate(scene).empty());
  }
  SECTION("an edge inside is measured, too") {
    mesh.positions[4] = {0, 0, 0x1p21};
    CHECK_THAT(describe(validate(mesh)), ContainsSubstring("beyond 2²⁰ m"));
  }
  SECTION("triangles that are not the boundary") {
    Scene scene = scene_of(mesh);
    std::swap(scene.mesh.triangles[0][0], scene.mesh.triangles[0][1]);
    check_only(validate(scene), "body 'block'", "triangles that are not their boundary");
  }
  SECTION("a tetrahedron without a body") {
    Scene scene = scene_of(mesh);
    --scene.bodies[0].tetrahedron_count;
    check_only(validate(scene), "scene", "1 of 2 tetrahedra");
  }
  SECTION("a tetrahedron on another body's vertices") {
    Scene scene = scene_of(mesh);
    append_body(scene, {.name = "other", .material = {}}, mesh);
    scene.mesh.tetrahedra[3][0] = 4;
    CHECK_THAT(describe(validate(scene)),
               ContainsSubstring("tetrahedron 1 of body 'other'") && ContainsSubstring("has vertices of another body"));
  }
  SECTION("density, moduli and damping out of range") {
    Scene scene = scene_of(mesh);
    scene.bodies[0].material.solid_density = 0;
    scene.bodies[0].material.solid_mu = 0;
    scene.bodies[0].material.solid_lambda = -1;
    scene.bodies[0].material.solid_damping = -1;
    CHECK_THAT(describe(validate(scene)),
               ContainsSubstring("solid_density is 0") && ContainsSubstring("solid_mu is 0") &&
                   ContainsSubstring("solid_lambda is -1") && ContainsSubstring("solid_damping is -1"));
  }
}
