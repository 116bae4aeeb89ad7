// Tests the oracle of volumes on cases decided by hand.
#include "compare/oracle/volume_audit.hpp"

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"

using namespace ogc::compare;

namespace {

/// Returns the surface of a cube of 1 m whose lowest corner is `corner`, facing outward. Vertex (i, j, k) has number 4i
/// + 2j + k.
Mesh cube(const Vec3& corner) {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) mesh.positions.push_back({corner.x + v / 4, corner.y + v / 2 % 2, corner.z + v % 2});
  for (const auto& [a, b, c, d] :
       {Tetrahedron{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({a, c, d});
  return mesh;
}

/// Returns the cube without its last two triangles, which are at z = 1.
Mesh open_box(const Vec3& corner) {
  Mesh mesh = cube(corner);
  mesh.triangles.resize(mesh.triangles.size() - 2);
  return mesh;
}

/// Returns a scene whose first body is a cloth of one triangle; each further body is a fixed volume with one of the
/// surfaces.
Scene scene_of(const std::array<Vec3, 3>& cloth, const std::vector<Mesh>& volumes) {
  Scene scene;
  scene.name = "volumes";
  append_body(scene, {.name = "cloth", .material = {}}, {{cloth.begin(), cloth.end()}, {{0, 1, 2}}, {}});
  for (const Mesh& mesh : volumes)
    append_body(scene, {.name = "volume", .fixed = true, .material = {}, .contact = BodyContact::volume}, mesh);
  return scene;
}

VolumePenetration audited(const Scene& scene) { return VolumeAuditor(scene).audit(scene.mesh.positions); }

}  // namespace

TEST_CASE("vertices inside a volume are counted, and the deepest is named", "[unit]") {
  const Scene scene = scene_of({{{0.5, 0.5, 0.25}, {0.125, 0.5, 0.5}, {0.5, 0.5, 2}}}, {cube({})});
  const VolumePenetration found = audited(scene);
  CHECK(found.vertices_inside == 2);
  CHECK(found.deepest_vertex == 0);
  CHECK(found.deepest == 0.25);
  CHECK(found.edges_meeting == 3);  // the two edges to the vertex outside, and the diagonal of the cube's face at z = 1
}

TEST_CASE("a vertex on the surface is outside, whichever face, edge or corner it is on", "[unit]") {
  for (const Vec3& x : {Vec3{0.5, 0.5, 0}, {0.5, 0.5, 1}, {0, 0.25, 0.25}, {1, 0.25, 0.25}, {0, 0, 0.5}, {1, 1, 1}}) {
    const Scene scene = scene_of({{x, {5, 5, 5}, {5, 5, 6}}}, {cube({})});
    CHECK(audited(scene).vertices_inside == 0);
  }
}

TEST_CASE("a ray through edges and corners counts as one beside them", "[unit]") {
  // The oracle's ray from the vertex along +x hits the diagonal of the far face, or corners of a second cube.
  for (const Vec3& x : {Vec3{0.5, 0.5, 0.5}, {0.25, 0.25, 0.75}, {0.5, 0.75, 0.25}}) {
    CHECK(audited(scene_of({{x, {0, -5, 5}, {0, -5, 6}}}, {cube({})})).vertices_inside == 1);
    CHECK(audited(scene_of({{x, {0, -5, 5}, {0, -5, 6}}}, {cube({3, 0.5, 0.5}), cube({})})).vertices_inside == 1);
    CHECK(audited(scene_of({{x, {0, -5, 5}, {0, -5, 6}}}, {cube({3, x.y, x.z})})).vertices_inside == 0);
  }
}

TEST_CASE("each part answers by itself, and a rim is closed by a fan", "[unit]") {
  const Scene overlapping = scene_of({{{0.75, 0.5, 0.5}, {5, 5, 5}, {5, 5, 6}}}, {cube({}), cube({0.5, 0, 0})});
  CHECK(audited(overlapping).vertices_inside == 1);
  // the vertex is 0.25 from x = 1 and from x = 0.5, and the larger depth counts
  CHECK(audited(overlapping).deepest == 0.25);
  const Scene open = scene_of({{{0.5, 0.5, 0.75}, {0.5, 0.5, 1.25}, {5, 5, 6}}}, {open_box({})});
  CHECK(audited(open).vertices_inside == 1);
  CHECK(audited(open).deepest == 0.5);  // distance from the walls, since the lid has no triangle
}

TEST_CASE("a vertex in the void of a part is outside, and one in its wall as deep as its nearer side says", "[unit]") {
  Mesh hollow = cube({});
  const std::size_t outer = hollow.triangles.size();
  for (std::size_t v = 0; v < 8; ++v) {
    const Vec3& x = hollow.positions[v];
    hollow.positions.push_back({0.25 + x.x / 2, 0.25 + x.y / 2, 0.25 + x.z / 2});
  }
  for (std::size_t t = 0; t < outer; ++t) {
    const auto [a, b, c] = hollow.triangles[t];
    hollow.triangles.push_back({a + 8, c + 8, b + 8});
  }
  const VolumePenetration found = audited(
      scene_of({{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.9375}, {0.5, 0.375, 0.8125}}}, {hollow}));
  CHECK(found.vertices_inside == 2);
  CHECK(found.deepest == 0.0625);
}

TEST_CASE("edges of a volume that pass a cloth between its vertices are counted", "[unit]") {
  const Scene scene = scene_of({{{-9, -9, 0.5}, {9, -9, 0.5}, {0, 18, 0.5}}}, {cube({})});
  const VolumePenetration found = audited(scene);
  CHECK(found.vertices_inside == 0);
  // Four edges of the cube along z and four diagonals of its upright faces meet the cloth.
  CHECK(found.edges_meeting == 8);
}

TEST_CASE("a scene without volumes lets nothing in, and positions must be the scene's", "[unit]") {
  const Scene scene = scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {});
  CHECK_FALSE(VolumeAuditor(scene).has_volumes());
  CHECK(audited(scene).vertices_inside == 0);
  const VolumeAuditor auditor(scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {cube({})}));
  CHECK_THROWS_AS(auditor.audit(scene.mesh.positions), InputError);
}

namespace {

/// Returns two cubes of 1 m with six tetrahedra each, as one free volume, or as two if `apart`. `back`: length by which
/// the second cube reaches into the first [m].
Scene free_cubes(double back, bool apart) {
  Mesh mesh = ogc::tests::block_mesh(2, 1);
  const Mesh other = ogc::tests::block_mesh(2, 1, {1 - back, 0.25, 0.25});
  Scene scene;
  scene.name = "cubes";
  Body body{.name = "cubes", .material = {}, .contact = BodyContact::volume};
  if (apart) {
    append_body(scene, body, mesh);
    append_body(scene, body, other);
    return scene;
  }
  for (const Tetrahedron& t : other.tetrahedra) mesh.tetrahedra.push_back({t[0] + 8, t[1] + 8, t[2] + 8, t[3] + 8});
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  append_body(scene, body, mesh);
  return scene;
}

}  // namespace

TEST_CASE("vertices of free volumes inside each other, and inside their own body, are counted", "[unit]") {
  for (const bool apart : {true, false}) {
    const VolumePenetration found = audited(free_cubes(0.125, apart));
    // Vertex (0.875, 0.25, 0.25) of the second cube and vertex (1, 1, 1) of the first are inside. Their distances from
    // x = 1 and x = 0.875 are 0.125.
    CHECK(found.vertices_inside == 2);
    CHECK(found.deepest == 0.125);
    CHECK(found.edges_meeting > 0);
  }
  CHECK(audited(free_cubes(-0.125, false)).vertices_inside == 0);
  CHECK(audited(free_cubes(-0.125, false)).edges_meeting == 0);
  // A vertex that only touches another body is outside of it. A vertex that touches a tetrahedron of its own body
  // counts as inside.
  CHECK(audited(free_cubes(0, true)).vertices_inside == 0);
  CHECK(audited(free_cubes(0, false)).vertices_inside == 2);
}

TEST_CASE("a surface's vertices in a body of tetrahedra are counted, and a body at rest lies in none of itself",
          "[unit]") {
  Scene scene = free_cubes(-0.5, false);
  CHECK(audited(scene).vertices_inside == 0);
  CHECK(audited(scene).edges_meeting == 0);
  append_body(scene, {.name = "cloth", .material = {}},
              {{{0.5, 0.5, 0.25}, {0.5, 0.25, 0.5}, {0.5, 5, 5}}, {{0, 1, 2}}, {}});
  CHECK(audited(scene).vertices_inside == 2);
  CHECK(audited(scene).deepest == 0.25);
}
