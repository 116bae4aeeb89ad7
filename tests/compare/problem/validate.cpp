// Tests each kind of problem by one small change to a valid mesh or scene: only this problem must be found and named.
#include "compare/problem/validate.hpp"

#include <limits>

#include "tests/catch.hpp"
#include "tests/compare/problem/small_scene.hpp"

using namespace ogc::compare;
using ogc::tests::small_scene;

namespace {

Mesh square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}}; }

void check_only(const std::vector<Problem>& problems, const std::string& where, const std::string& what) {
  CHECK_THAT(describe(problems), ContainsSubstring(where) && ContainsSubstring(what));
  CHECK(problems.size() == 1);
}

}  // namespace

TEST_CASE("a valid mesh and a valid scene have no problems", "[unit]") {
  CHECK(validate(square()).empty());
  CHECK(validate(small_scene()).empty());
  CHECK(validate(Mesh{{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}}).empty());
  CHECK(describe({}).empty());
}

TEST_CASE("validate names each kind of problem of a mesh", "[unit]") {
  Mesh mesh = square();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  SECTION("no vertices") { check_only(validate(Mesh{}), "mesh", "no vertices"); }
  SECTION("index out of range") {
    mesh.triangles[1][2] = 4;
    check_only(validate(mesh), "triangle 1", "does not exist: 4; vertices are numbered from 0 to 3");
  }
  SECTION("negative index") {
    mesh.triangles[0][0] = -1;
    check_only(validate(mesh), "triangle 0", "does not exist: -1");
  }
  SECTION("loose edge out of range") {
    mesh.loose_edges = {{0, 9}};
    check_only(validate(mesh), "loose edge 0", "does not exist: 9");
  }
  SECTION("repeated vertex") {
    mesh.triangles.push_back({0, 1, 0});
    check_only(validate(mesh), "triangle 2", "same vertex twice: vertex 0");
  }
  SECTION("duplicate face, turned over") {
    mesh.triangles.push_back({2, 1, 0});
    check_only(validate(mesh), "triangle 2", "same vertices as another triangle: triangle 0");
  }
  SECTION("duplicate loose edge") {
    mesh.positions.push_back({2, 0, 0});
    mesh.loose_edges = {{1, 4}, {4, 1}};
    check_only(validate(mesh), "loose edge 1", "same vertices as another loose edge: loose edge 0");
  }
  SECTION("loose edge of a triangle") {
    mesh.loose_edges = {{0, 2}};
    check_only(validate(mesh), "loose edge 0", "edge of a triangle too");
  }
  SECTION("not a number") {
    mesh.positions[2].y = nan;
    check_only(validate(mesh), "vertex 2", "not finite");
  }
  SECTION("infinity") {
    mesh.positions[3].x = infinity;
    check_only(validate(mesh), "vertex 3", "not finite");
  }
  SECTION("coordinate too large") {
    mesh.positions[3].x = 0x1.1p20;
    check_only(validate(mesh), "vertex 3", "beyond 2²⁰ m");
  }
  SECTION("edge too short") {
    mesh.positions[1] = {1, 1 - 0x1p-22, 0};
    check_only(validate(mesh), "triangle 0", "edge length is not within 2⁻²⁰ … 2²⁰ m: vertices 1, 2");
  }
  SECTION("edge too long") {
    mesh.positions[0] = {-0x1p20, -0x1p20, 0};
    CHECK_THAT(describe(validate(mesh)), ContainsSubstring("edge length is not within"));
  }
  SECTION("isolated vertex") {
    mesh.positions.push_back({5, 5, 5});
    check_only(validate(mesh), "vertex 4", "belongs to no triangle");
  }
  SECTION("zero area") {
    mesh.positions[3] = {0.5, 0.5, 0};
    check_only(validate(mesh), "triangle 1", "zero area");
  }
}

TEST_CASE("an edge of zero length is named once, though its triangles have no area either", "[unit]") {
  Mesh mesh = square();
  mesh.positions[2] = mesh.positions[0];
  const std::string text = describe(validate(mesh));
  CHECK_THAT(text, ContainsSubstring("triangle 0 (vertices 0, 1, 2): edge of zero length: vertices 2, 0"));
  CHECK_THAT(text, ContainsSubstring("triangle 1 (vertices 0, 2, 3): triangle of zero area"));
  CHECK(validate(mesh).size() == 3);
}

TEST_CASE("coordinates of any smallness are legal; it is lengths that have a least value", "[unit]") {
  for (const double small : {-0x1p-21, 6e-17, 0x1p-149, 5e-324}) {
    Mesh mesh = square();
    for (Vec3& p : mesh.positions) p.z = small;
    CHECK(validate(mesh).empty());
    mesh.positions[1].z = -small;
    CHECK(validate(mesh).empty());
  }
}

TEST_CASE("a triangle that is thin by one ulp is no error, one of exactly zero area is", "[unit]") {
  Mesh mesh{{{0.1, 0.1, 0}, {0.2, 0.2, 0}, {0.7, 0.7, 0}}, {{0, 1, 2}}, {}};
  check_only(validate(mesh), "triangle 0", "zero area");
  mesh.positions[1].y += 0x1p-55;
  CHECK(mesh.positions[1].y != mesh.positions[1].x);
  CHECK(validate(mesh).empty());
}

TEST_CASE("long lists are cut and counted", "[unit]") {
  Mesh mesh = square();
  for (int i = 0; i < 25; ++i) mesh.positions.push_back({static_cast<double>(i + 1), 5, 5});
  const std::vector<Problem> problems = validate(mesh, 10);
  REQUIRE(problems.size() == 11);
  CHECK(problems[9].where == "vertex 13");
  CHECK(problems[10].where == "15 more");
  CHECK(validate(mesh, 25).size() == 25);
}

TEST_CASE("validate names each kind of problem of a scene", "[unit]") {
  Scene scene = small_scene();
  SECTION("mesh") {
    scene.mesh.triangles[0][0] = 99;
    CHECK_THAT(
        describe(validate(scene)),
        ContainsSubstring("triangle 0 of body 'sheet' (vertices 99, 1, 2): names a vertex that does not exist: 99"));
  }
  SECTION("setting") {
    scene.settings.bounds_relaxation = 0.5;
    check_only(validate(scene), "setting 'bounds_relaxation'", "is 0.5; give a number from");
  }
  SECTION("lanes") {
    scene.settings.lanes = 3;
    check_only(validate(scene), "setting 'lanes'", "0, 2, 4, 8 or 16");
  }
  SECTION("density") {
    scene.bodies[0].material.density = 0;
    check_only(validate(scene), "body 'sheet'", "density is 0");
  }
  SECTION("stiffness") {
    scene.bodies[1].material.lame_mu = -1;
    check_only(validate(scene), "body 'floor'", "lame_mu is -1");
  }
  SECTION("friction") {
    scene.bodies[0].material.friction = std::numeric_limits<double>::quiet_NaN();
    check_only(validate(scene), "body 'sheet'", "friction is nan");
  }
  SECTION("rest positions missing") {
    scene.rest_positions.pop_back();
    check_only(validate(scene), "rest positions", "6 entries for 7 vertices");
  }
  SECTION("degenerate rest shape") {
    scene.rest_positions[1] = {0.05, 0, 0.05};
    check_only(validate(scene), "triangle 0", "rest triangle of zero area");
  }
  SECTION("velocity") {
    scene.velocities[3].z = std::numeric_limits<double>::infinity();
    check_only(validate(scene), "vertex 3", "velocity is not finite");
  }
  SECTION("gravity") {
    scene.gravity.y = std::numeric_limits<double>::quiet_NaN();
    check_only(validate(scene), "gravity", "not finite");
  }
  SECTION("scene name") {
    scene.name = "../up";
    check_only(validate(scene), "scene", "'../up'");
  }
  SECTION("body name twice") {
    scene.bodies[1].name = "sheet";
    check_only(validate(scene), "body 'sheet'", "name can't be used");
  }
  SECTION("gap between bodies") {
    scene.bodies[1].first_vertex = 5;
    check_only(validate(scene), "body 'floor'", "does not begin where the one before it ends");
  }
  SECTION("bodies do not cover the mesh") {
    scene.bodies.pop_back();
    check_only(validate(scene), "scene", "4 of 7 vertices, 2 of 3 triangles and 0 of 0 tetrahedra");
  }
  SECTION("triangle of two bodies") {
    scene.mesh.triangles[2] = {3, 5, 6};
    CHECK_THAT(describe(validate(scene)), ContainsSubstring("triangle 0 of body 'floor'") &&
                                              ContainsSubstring("2 in the scene): has vertices of another body"));
  }
}

TEST_CASE("validate names each kind of problem of a motion", "[unit]") {
  Scene scene = small_scene();
  PrescribedMotion& motion = scene.motions[0];
  SECTION("unknown vertex") {
    motion.vertices.push_back(7);
    check_only(validate(scene), "motion 'left', vertex 7", "does not exist; vertices are numbered from 0 to 6");
  }
  SECTION("fixed vertex") {
    motion.vertices.push_back(4);
    check_only(validate(scene), "motion 'left', vertex 0 of body 'floor' (4 in the scene)", "fixed body");
  }
  SECTION("doubly prescribed vertex") {
    motion.vertices.push_back(2);
    check_only(validate(scene), "motion 'right', vertex 2", "prescribed already");
  }
  SECTION("zero axis") {
    motion.axis = {};
    check_only(validate(scene), "motion 'left'", "zero axis");
  }
  SECTION("not finite") {
    motion.angular_velocity = std::numeric_limits<double>::quiet_NaN();
    check_only(validate(scene), "motion 'left'", "not finite");
  }
  SECTION("ends before it starts") {
    motion.end = -1;
    check_only(validate(scene), "motion 'left'", "ends before it starts");
  }
  SECTION("no vertices") {
    motion.vertices.clear();
    check_only(validate(scene), "motion 'left'", "moves no vertex");
  }
  SECTION("name") {
    motion.name = "";
    check_only(validate(scene), "motion ''", "name can't be used");
  }
}

TEST_CASE("validate names an excluded pair that is none, and keyframes that tell no motion", "[unit]") {
  Scene scene = small_scene();
  SECTION("pairs") {
    scene.excluded_pairs = {{0, 6}, {3, 3}, {1, 7}, {-1, 2}};
    const std::vector<Problem> problems = validate(scene);
    REQUIRE(problems.size() == 3);
    CHECK(problems[0].where == "excluded pair 1");
    CHECK(problems[2].what.find("vertex -1 of the scene, which does not exist, vertex 2 of body 'sheet'") !=
          std::string::npos);
  }
  PrescribedMotion& motion = scene.motions[0];
  motion.angular_velocity = 0;
  motion.velocity = {};
  motion.keyframes.times = {0, 1};
  motion.keyframes.positions.assign(2 * motion.vertices.size(), Vec3f{});
  SECTION("right") { CHECK(validate(scene).empty()); }
  SECTION("one frame") {
    motion.keyframes.times = {0};
    motion.keyframes.positions.resize(motion.vertices.size());
    check_only(validate(scene), "motion 'left'", "has 1 keyframes");
  }
  SECTION("times") {
    motion.keyframes.times = {1, 1};
    check_only(validate(scene), "motion 'left'", "do not rise");
  }
  SECTION("count") {
    motion.keyframes.positions.pop_back();
    check_only(validate(scene), "motion 'left'", "positions in 2 keyframes");
  }
  SECTION("not a number") {
    motion.keyframes.positions.back().z = std::numeric_limits<float>::quiet_NaN();
    check_only(validate(scene), "motion 'left', keyframe 1, vertex " + std::to_string(motion.vertices.back()),
               "not finite");
  }
  SECTION("two motions in one") {
    motion.velocity = {1, 0, 0};
    check_only(validate(scene), "motion 'left'", "keyframes and velocities");
  }
}

TEST_CASE("validate names a spring that joins no two vertices, or has a number out of range", "[unit]") {
  Scene scene = small_scene();
  scene.springs = {{1, 5, 10, 0.2, 0}};
  CHECK(validate(scene).empty());
  SECTION("a point on no line") {
    for (const auto& [third, ratio] :
         std::vector<std::pair<Index, double>>{{-1, 0.5}, {5, 0.5}, {1, 0.5}, {7, 0.5}, {2, 1.5}, {2, -0.5}, {-2, 0}}) {
      scene.springs[0].third = third;
      scene.springs[0].ratio = ratio;
      check_only(validate(scene), "spring 0", "has no such point");
    }
  }
  SECTION("unknown vertex") {
    scene.springs[0].second = 7;
    check_only(validate(scene), "spring 0",
               "does not join two vertices: vertex 1 of body 'sheet', vertex 7 of the scene, which does not exist");
  }
  SECTION("one vertex twice") {
    scene.springs[0].second = 1;
    check_only(validate(scene), "spring 0", "does not join two vertices");
  }
  SECTION("negative stiffness") {
    scene.springs[0].stiffness = -1;
    check_only(validate(scene), "spring 0", "out of range: -1 N/m");
  }
  SECTION("a rest length that is no length") {
    scene.springs[0].rest_length = 0x1p-30;
    check_only(validate(scene), "spring 0", "out of range");
  }
  SECTION("not a number") {
    scene.springs[0].damping = std::numeric_limits<double>::quiet_NaN();
    check_only(validate(scene), "spring 0", "out of range");
  }
}
