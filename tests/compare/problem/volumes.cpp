// Tests the parts of volumes, and each kind of problem that a volume can have.
#include "compare/problem/volumes.hpp"

#include <algorithm>
#include <limits>

#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"

using namespace ogc::compare;
using ogc::tests::block_mesh;

namespace {

/// Returns the surface of a cube of 1 m whose lowest corner is `corner`, facing outward. Vertex (i, j, k) has number 4i
/// + 2j + k.
Mesh cube(const Vec3& corner = {}) {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) mesh.positions.push_back({corner.x + v / 4, corner.y + v / 2 % 2, corner.z + v % 2});
  for (const auto& [a, b, c, d] :
       {Tetrahedron{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({a, c, d});
  return mesh;
}

Mesh joined(Mesh mesh, const Mesh& more) {
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  return mesh;
}

Mesh reversed(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Returns a box without a lid: the cube without its last two triangles.
Mesh open_box(const Vec3& corner = {}) {
  Mesh mesh = cube(corner);
  mesh.triangles.resize(mesh.triangles.size() - 2);
  return mesh;
}

/// Returns a scene of two bodies: a sheet of one triangle, then the mesh as a volume.
Scene scene_of(const Mesh& mesh, bool fixed = true) {
  Scene scene;
  scene.name = "volumes";
  append_body(scene, {.name = "sheet", .material = {}}, {{{0, 9, 0}, {1, 9, 0}, {0, 9, 1}}, {{0, 1, 2}}, {}});
  append_body(scene, {.name = "body", .fixed = fixed, .material = {}, .contact = BodyContact::volume}, mesh);
  return scene;
}

std::string said(const Scene& scene) { return describe(validate(scene)); }

}  // namespace

TEST_CASE("a volume's parts are its connected surfaces, with the edges that have one triangle in its sense", "[unit]") {
  const std::vector<VolumePart> parts = volume_parts(scene_of(joined(cube(), open_box({0.5, 0, 0}))));
  REQUIRE(parts.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(parts[k].body == 1);
    CHECK(parts[k].triangles.front() == static_cast<Index>(1 + 12 * k));
    CHECK(std::ranges::is_sorted(parts[k].triangles));
  }
  CHECK(parts[0].triangles.size() == 12);
  CHECK(parts[0].rims.empty());
  CHECK(parts[1].triangles.size() == 10);
  // In the vertex numbers of open_box the rim is 1 → 3 → 7 → 5, in the directions of its triangles. In the scene, 11
  // vertices precede the box: 3 of the sheet and 8 of the cube.
  std::vector<Edge> rims = parts[1].rims;
  std::ranges::sort(rims);
  CHECK(rims == std::vector<Edge>{{12, 14}, {14, 18}, {16, 12}, {18, 16}});
  CHECK(volume_parts(scene_of(joined(cube(), cube({1, 0, 0})))).size() == 2);
  Scene without = scene_of(cube());
  without.bodies[1].contact = BodyContact::surface;
  CHECK(volume_parts(without).empty());
}

TEST_CASE("closed surfaces, rims, overlapping parts and solids are volumes, wherever they lie", "[unit]") {
  for (const double shift : {0.0, 1.0, -1000.0}) {
    const Vec3 corner{shift, 2 * shift, -shift};
    for (const Mesh& mesh : {cube(corner), open_box(corner), joined(cube(corner), open_box(corner))}) {
      CHECK(said(scene_of(mesh)) == "");
      CHECK_THAT(said(scene_of(reversed(mesh))),
                 ContainsSubstring("begins a part of a volume that is turned inside out"));
    }
    CHECK(said(scene_of(block_mesh(2, 1, corner), false)) == "");
  }
}

namespace {

/// Returns a cube about the origin with edges of length `size`.
Mesh cube_of(double size) {
  Mesh mesh = cube();
  for (Vec3& x : mesh.positions) x = {size * (x.x - 0.5), size * (x.y - 0.5), size * (x.z - 0.5)};
  return mesh;
}
Mesh void_of(double size) { return reversed(cube_of(size)); }

Mesh shifted(Mesh mesh, double by) {
  for (Vec3& x : mesh.positions) x.x += by;
  return mesh;
}

constexpr const char* inside_out = "begins a part of a volume that is turned inside out";

}  // namespace

TEST_CASE("a closed sheet that faces inward within a part is a cavity of it, and of one part with it", "[unit]") {
  const Scene hollow = scene_of(joined(cube_of(4), void_of(2)));
  CHECK(said(hollow) == "");
  REQUIRE(volume_parts(hollow).size() == 1);
  CHECK(volume_parts(hollow)[0].triangles.size() == 24);
  CHECK(std::ranges::is_sorted(volume_parts(hollow)[0].triangles));
  // In the scene the sheet has the first three vertices, and the outer cube the next eight.
  const std::vector<Edge> cavities = volume_cavities(hollow);
  REQUIRE(cavities.size() == 1);
  CHECK((cavities[0][0] >= 11 && cavities[0][0] < 19));
  CHECK((cavities[0][1] >= 3 && cavities[0][1] < 11));
  CHECK(volume_surface(hollow).cavities == cavities);
  // The order and the position of the two shells do not matter.
  CHECK(said(scene_of(joined(void_of(2), cube_of(4)))) == "");
  CHECK(said(scene_of(shifted(joined(cube_of(4), void_of(2)), 1000))) == "");
  CHECK(volume_parts(scene_of(joined(joined(cube_of(4), shifted(void_of(1), -1)), shifted(void_of(1), 1)))).size() ==
        1);
}

TEST_CASE("an island in a void is a part of its own, and a cavity belongs to the innermost part around it", "[unit]") {
  const Scene scene = scene_of(joined(joined(cube_of(8), void_of(6)), joined(cube_of(4), void_of(2))));
  CHECK(said(scene) == "");
  const std::vector<VolumePart> parts = volume_parts(scene);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].triangles.front() == 1);
  CHECK(parts[0].triangles.back() == 24);
  CHECK(parts[1].triangles.front() == 25);
  // A second part overlaps the cavity without containing it. So the cavity belongs to the first part, which surrounds
  // it.
  CHECK(volume_parts(scene_of(joined(joined(cube_of(4), void_of(2)), shifted(cube_of(1), 1)))).size() == 2);
}

TEST_CASE("a sheet that faces inward in nothing, across a part, in a void or in an open part is inside out", "[unit]") {
  CHECK_THAT(said(scene_of(joined(cube_of(2), void_of(4)))),
             ContainsSubstring("triangle 12 of body 'body'") && ContainsSubstring(inside_out) &&
                 ContainsSubstring("lies within a closed part of the same body"));
  CHECK_THAT(said(scene_of(joined(cube_of(4), shifted(void_of(2), 1.5)))), ContainsSubstring(inside_out));
  CHECK_THAT(said(scene_of(joined(cube_of(4), shifted(void_of(2), 9)))), ContainsSubstring(inside_out));
  CHECK_THAT(said(scene_of(joined(joined(cube_of(8), void_of(4)), void_of(2)))),
             ContainsSubstring("triangle 24 of body 'body'") && ContainsSubstring(inside_out) &&
                 !ContainsSubstring("triangle 12 of"));
  Mesh open = cube_of(4);
  open.triangles.resize(open.triangles.size() - 2);
  CHECK_THAT(said(scene_of(joined(open, void_of(2)))), ContainsSubstring(inside_out));
  Scene two = scene_of(cube_of(4));
  append_body(two, {.name = "void", .fixed = true, .material = {}, .contact = BodyContact::volume}, void_of(2));
  CHECK_THAT(said(two), ContainsSubstring("triangle 0 of body 'void'") && ContainsSubstring(inside_out));
}

TEST_CASE("the boundary of hollow tetrahedra is one part, and inside out where they are at the start", "[unit]") {
  Mesh mesh = block_mesh(4, 1);
  std::erase_if(mesh.tetrahedra, [&](const Tetrahedron& t) {
    return std::ranges::all_of(t, [&](Index v) {
      const Vec3& x = mesh.positions[static_cast<std::size_t>(v)];
      return std::min({x.x, x.y, x.z}) > 0.1 && std::max({x.x, x.y, x.z}) < 2.9;
    });
  });
  Scene scene = scene_of(mesh, false);
  CHECK(said(scene) == "");
  REQUIRE(volume_parts(scene).size() == 1);
  CHECK(volume_parts(scene)[0].triangles.size() == 6 * 18 + 12);
  CHECK(volume_cavities(scene).empty());
  for (std::size_t v = 3; v < scene.mesh.positions.size(); ++v) scene.mesh.positions[v].x *= -1;
  CHECK_THAT(said(scene), ContainsSubstring(inside_out));
}

TEST_CASE("a volume of triangles is driven: all of its vertices are fixed or prescribed", "[unit]") {
  Scene scene = scene_of(cube(), false);
  CHECK_THAT(said(scene),
             ContainsSubstring("body 'body': is a volume of triangles, and 8 of its 8 vertices move freely; fix it, "
                               "prescribe all of its vertices, or give it tetrahedra"));
  PrescribedMotion motion;
  motion.name = "path";
  for (Index v = 3; v < 10; ++v) motion.vertices.push_back(v);
  scene.motions = {motion};
  CHECK_THAT(said(scene), ContainsSubstring("and 1 of its 8 vertices move freely"));
  scene.motions[0].vertices.push_back(10);
  CHECK(said(scene) == "");
}

TEST_CASE("each bad volume is named with its place and a remedy", "[unit]") {
  Mesh mesh = cube();
  SECTION("a triangle turned round") {
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    CHECK_THAT(said(scene_of(mesh)),
               ContainsSubstring(
                   "edge from vertex 0 of body 'body' (3 in the scene) to vertex 1 of body 'body' (4 in the "
                   "scene): of a volume is run through in one sense by both of its triangles: triangle 0 of body "
                   "'body'") &&
                   ContainsSubstring("turn one of them round") && !ContainsSubstring("inside out"));
  }
  SECTION("a third triangle at an edge") {
    mesh.positions.push_back({0.5, 0.5, 2});
    mesh.triangles.push_back({1, 5, 8});
    CHECK_THAT(said(scene_of(mesh)),
               ContainsSubstring("of a volume has more than two triangles: 3, among them triangle") &&
                   ContainsSubstring("leave the body a surface"));
  }
  SECTION("one part of two inside out, and which") {
    CHECK_THAT(said(scene_of(joined(cube(), reversed(cube({5, 0, 0}))))),
               ContainsSubstring("triangle 12 of body 'body'") &&
                   ContainsSubstring("inside out: 12 triangles, 0 edges at rims"));
  }
  SECTION("a flat sheet") {
    CHECK_THAT(said(scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}})),
               ContainsSubstring("begins a part of a volume that encloses nothing: 1 triangles, 3 edges at rims"));
  }
  SECTION("a loose edge") {
    mesh.positions.push_back({5, 5, 5});
    mesh.loose_edges = {{7, 8}};
    CHECK_THAT(said(scene_of(mesh)), ContainsSubstring("of a volume belongs to no triangle, and has no inner side"));
  }
  SECTION("edges alone") {
    CHECK_THAT(said(scene_of({{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}})),
               ContainsSubstring("body 'body': is a volume without triangles; leave it a surface"));
  }
  SECTION("coordinates that are no numbers, beside what is wrong with its edges") {
    mesh.positions[7].x = std::numeric_limits<double>::quiet_NaN();
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    CHECK_THAT(said(scene_of(mesh)), ContainsSubstring("position is not finite") && ContainsSubstring("in one sense"));
  }
}

TEST_CASE("whoever can't simulate volumes says so by name", "[unit]") {
  Scene scene = scene_of(cube());
  CHECK_THROWS_WITH(refuse_volumes(scene, "ipc", "do so"),
                    "body 'body' is a volume, which ipc does not simulate; do so");
  scene.bodies[1].contact = BodyContact::surface;
  CHECK_NOTHROW(refuse_volumes(scene, "ipc", "do so"));
}
