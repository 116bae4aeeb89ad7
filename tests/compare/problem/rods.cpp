// Tests segments of rods, and each kind of problem that a rod can have.
#include "compare/problem/rods.hpp"

#include <algorithm>
#include <limits>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

/// Returns vertices on a zigzag, 1 m apart along x, with edges between neighbours.
Mesh chain(int count, double height = 0.5) {
  Mesh mesh;
  for (int v = 0; v < count; ++v) mesh.positions.push_back({double(v), v % 2 * height, 0});
  for (Index v = 0; v + 1 < count; ++v) mesh.loose_edges.push_back({v, v + 1});
  return mesh;
}

/// Returns a scene of two bodies: a sheet of one triangle, then the mesh as yarn, with a rod's material if `is_rod`.
Scene scene_of(const Mesh& mesh, bool is_rod = true) {
  Scene scene;
  scene.name = "rods";
  append_body(scene, {.name = "sheet", .material = {}}, {{{0, 9, 0}, {1, 9, 0}, {0, 9, 1}}, {{0, 1, 2}}, {}});
  Body body{.name = "yarn", .material = {}};
  if (is_rod) body.material.rod.emplace();
  append_body(scene, body, mesh);
  return scene;
}

std::string said(const Scene& scene) { return describe(validate(scene)); }

}  // namespace

TEST_CASE("segments are the loose edges of rods, in their order", "[unit]") {
  Scene scene = scene_of(chain(3));
  CHECK(said(scene).empty());
  Body held{.name = "wire", .fixed = true, .material = {}};
  append_body(scene, held, chain(4));
  append_body(scene, {.name = "more", .material = scene.bodies[1].material}, chain(2));
  CHECK(said(scene).empty());
  CHECK(rod_segments(scene) == std::vector<Index>{0, 1, 5});
  scene.bodies[1].material.rod.reset();
  CHECK(rod_segments(scene) == std::vector<Index>{5});
}

TEST_CASE("a chain, a ring, a branch and a straight chain are rods", "[unit]") {
  Mesh ring;
  ring.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ring.loose_edges = {{0, 1}, {1, 2}, {2, 0}};
  CHECK(said(scene_of(ring)).empty());
  Mesh branch = chain(4, 0);
  branch.positions.push_back({1, 1, 0});
  branch.loose_edges.push_back({1, 4});
  CHECK(said(scene_of(branch)).empty());
  CHECK(said(scene_of(chain(5, 0))).empty());
}

TEST_CASE("no step of a scene with rods ends by its vertices' moves alone", "[unit]") {
  Scene scene = scene_of(chain(3));
  scene.settings.settled_move = 0.5;
  CHECK_THAT(said(scene), ContainsSubstring("setting 'settled_move': is 0.5 in a scene with rods; give 0"));
  scene.bodies[1].fixed = true;
  scene.bodies[1].material.rod.reset();
  CHECK(said(scene).empty());
}

TEST_CASE("what no rod can be is named with what to do", "[unit]") {
  SECTION("a rod's material on a body without loose edges") {
    Scene scene = scene_of(chain(3));
    scene.bodies[0].material.rod.emplace();
    CHECK_THAT(said(scene), ContainsSubstring("body 'sheet': has a rod's material and no loose edge") &&
                                ContainsSubstring("leave 'rod' out"));
  }
  SECTION("loose edges without it") {
    const std::string text = said(scene_of(chain(3), false));
    CHECK_THAT(text, ContainsSubstring("vertex 0 of body 'yarn'") && ContainsSubstring("it has no mass") &&
                         ContainsSubstring("give the body's"));
    CHECK(std::ranges::count(text, '\n') == 2);  // each vertex is named once
  }
  SECTION("but those that are fixed, prescribed or carried by a triangle need none") {
    Scene fixed = scene_of(chain(3), false);
    fixed.bodies[1].fixed = true;
    CHECK(said(fixed).empty());
    Scene held = scene_of(chain(3), false);
    held.motions.push_back({.name = "hold", .vertices = {3, 4, 5}, .keyframes = {}});
    CHECK(said(held).empty());
    Mesh fringe;
    fringe.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    fringe.triangles = {{0, 1, 2}, {3, 4, 5}};
    fringe.loose_edges = {{1, 3}};
    CHECK(said(scene_of(fringe, false)).empty());
  }
  SECTION("constants out of range") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const RodInfo& info : rod_table())
      for (const double value : {-1.0, 1e300, 1e-46, nan}) {
        Scene scene = scene_of(chain(3));
        (*scene.bodies[1].material.rod).*info.field = value;
        CHECK_THAT(said(scene), ContainsSubstring("body 'yarn': rod: " + std::string(info.name) + " is ") &&
                                    ContainsSubstring("give a number"));
      }
    for (const char* name : {"density", "stretch"}) {
      Scene scene = scene_of(chain(3));
      const auto info = std::ranges::find(rod_table(), name, &RodInfo::name);
      (*scene.bodies[1].material.rod).*info->field = 0;
      CHECK_THAT(said(scene), ContainsSubstring(std::string(name) + " is 0"));
    }
  }
  SECTION("a segment that reverses onto its neighbour at rest, decided exactly") {
    Mesh folded = chain(4, 0);
    folded.positions[3] = {1.5, 0, 0};
    CHECK_THAT(said(scene_of(folded)), ContainsSubstring("loose edge 2 of body 'yarn'") &&
                                           ContainsSubstring("reverses onto its neighbour") &&
                                           ContainsSubstring("loose edge 1 of body 'yarn'"));
    folded.positions[3].y = 0x1p-149;
    CHECK(said(scene_of(folded)).empty());
    // Segments at a branch do not count as neighbours, so they may be folded onto each other.
    folded.positions[3].y = 0;
    folded.positions.push_back({2, 1, 0});
    folded.loose_edges.push_back({2, 4});
    CHECK(said(scene_of(folded)).empty());
    // The start may be folded; the rest shape must not be.
    Scene scene = scene_of(chain(4, 0));
    scene.mesh.positions[6] = {1.5, 0, 0};
    CHECK(said(scene).empty());
  }
  SECTION("orientations") {
    Scene scene = scene_of(chain(3));
    scene.orientations = {{0, 0, 0, 1}};
    CHECK_THAT(said(scene), ContainsSubstring("1 entries for 2 segments"));
    scene.orientations = {{0, 0, 0, 1}, {0, 0, 1, 1}};
    CHECK_THAT(said(scene), ContainsSubstring("orientation 1: is no unit quaternion"));
    scene.orientations[1] = {0, 0, std::numeric_limits<float>::quiet_NaN(), 1};
    CHECK_THAT(said(scene), ContainsSubstring("orientation 1: is no unit quaternion"));
    scene.orientations[1] = {0.6f, 0, 0, 0.8f};
    CHECK(said(scene).empty());
  }
}

TEST_CASE("constants of rods are rounded to single precision as all others", "[unit]") {
  Scene scene = scene_of(chain(3));
  scene.bodies[1].material.rod->bend = 1e-7;
  round_to_single(scene);
  for (const RodInfo& info : rod_table()) {
    const double value = (*scene.bodies[1].material.rod).*info.field;
    CHECK(value == static_cast<double>(static_cast<float>(value)));
  }
}
