#include "compare/problem/scene.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "compare/problem/material_table.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/small_scene.hpp"

using namespace ogc::compare;
using ogc::tests::small_scene;

namespace {

bool is_single(double value) { return static_cast<double>(static_cast<float>(value)) == value; }

bool is_single(const Vec3& v) { return is_single(v.x) && is_single(v.y) && is_single(v.z); }

double distance(const Vec3f& a, const Vec3f& b) {
  return std::hypot(static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y, static_cast<double>(a.z) - b.z);
}

// Largest distance by which two roundings move a point. Each rounding moves each coordinate by at most half an ulp,
// 2⁻²⁵ m, because coordinates are below 1 m in modulus.
constexpr double rounding = 2 * 1.74 * 0x1p-25;

}  // namespace

TEST_CASE("round_to_single leaves only numbers that single precision holds, once and for all", "[unit]") {
  Scene scene = small_scene();
  scene.rest_positions[0].x += 0.1;
  scene.velocities[1] = {0.1, 0.2, 0.3};
  scene.settings.time_step = 1.0 / 300;
  const PrescribedMotion motion = scene.motions[0];
  round_to_single(scene);
  for (const auto* vectors : {&scene.mesh.positions, &scene.rest_positions, &scene.velocities}) {
    for (const Vec3& v : *vectors) CHECK(is_single(v));
  }
  for (const SettingInfo& info : setting_table()) CHECK(is_single(get_setting(scene.settings, info)));
  for (const Body& body : scene.bodies) {
    for (const MaterialInfo& info : material_table()) CHECK(is_single(body.material.*info.field));
  }
  CHECK(is_single(scene.gravity));
  CHECK(scene.settings.time_step == static_cast<double>(1.0f / 300));
  CHECK(scene.motions[0] == motion);
  Scene again = scene;
  round_to_single(again);
  CHECK(again == scene);
  CHECK(to_double(to_single(scene.mesh.positions)) == scene.mesh.positions);
}

TEST_CASE("rigid groups: free, fixed, and one for each motion", "[unit]") {
  const Scene scene = small_scene();
  CHECK(rigid_groups(scene) == std::vector<Index>{1, -1, 2, -1, 0, 0, 0});
}

TEST_CASE("partners stand in the rows of both, once, ascending", "[unit]") {
  const std::vector<std::array<Index, 2>> pairs{{3, 1}, {1, 3}, {0, 3}, {1, 2}};
  const CompressedRows rows = partner_rows(5, pairs);
  const std::vector<std::vector<Index>> expected{{3}, {2, 3}, {1}, {0, 1}, {}};
  REQUIRE(rows.rows() == 5);
  for (std::size_t v = 0; v < 5; ++v)
    CHECK(std::equal(rows[v].begin(), rows[v].end(), expected[v].begin(), expected[v].end()));
  CHECK(pairs_of(rows) == std::vector<std::array<Index, 2>>{{0, 3}, {1, 2}, {1, 3}});
  CHECK(partner_rows(5, {}).rows() == 0);
}

TEST_CASE("a stitch to an end of the edge is a spring between two vertices; the pairs beside every stitch are excluded",
          "[unit]") {
  Scene scene = small_scene();
  scene.springs.clear();
  add_stitch(scene, 0, 1, 2, 0.25, 9);
  add_stitch(scene, 0, 1, 2, 0, 9);
  add_stitch(scene, 0, 1, 2, 1, 9);
  CHECK(scene.springs == std::vector<Spring>{{0, 1, 9, 0, 0, 2, 0.25}, {0, 1, 9, 0, 0, -1, 0}, {0, 2, 9, 0, 0, -1, 0}});
  CHECK(scene.excluded_pairs == std::vector<std::array<Index, 2>>{{0, 1}, {0, 2}, {0, 1}, {0, 2}});
  CHECK(validate(scene).empty());
}

TEST_CASE(
    "keyframes: each comes back bit for bit, straight lines lead from one to the next, and it rests before and after",
    "[unit]") {
  Scene scene = small_scene();
  PrescribedMotion motion;
  motion.vertices = {0, 2};
  motion.keyframes.times = {0.5, 1, 3};
  const Vec3f a{0.1f, 0.2f, 0.3f}, b{1, 2, 3}, c{-1, 0.5f, 7};
  motion.keyframes.positions = {a, b, b, c, c, a};
  const auto at = [&](double t) { return prescribed_targets(scene, motion, t); };
  CHECK(at(0) == std::vector<Vec3f>{a, b});
  CHECK(at(0.5) == std::vector<Vec3f>{a, b});
  CHECK(at(1) == std::vector<Vec3f>{b, c});
  CHECK(at(3) == std::vector<Vec3f>{c, a});
  CHECK(at(9) == std::vector<Vec3f>{c, a});
  CHECK(at(2)[0] == Vec3f{0, 1.25f, 5});  // the middle between b and c
}

TEST_CASE("each vertex knows its body", "[unit]") {
  const Scene scene = small_scene();
  CHECK(body_of_vertex(scene) == std::vector<Index>{0, 0, 0, 0, 1, 1, 1});
}

TEST_CASE("append_body shifts faces and starts at rest in the rest shape", "[unit]") {
  const Scene scene = small_scene();
  CHECK(scene.mesh.triangles.back() == Triangle{4, 5, 6});
  CHECK(scene.rest_positions == scene.mesh.positions);
  CHECK(scene.velocities == std::vector<Vec3>(7));
  CHECK(scene.bodies[1].first_vertex == 4);
  CHECK(scene.bodies[1].first_triangle == 2);
}

TEST_CASE("before its start a motion gives back the start positions bit for bit", "[unit]") {
  Scene scene = small_scene();
  round_to_single(scene);
  PrescribedMotion motion = scene.motions[0];
  motion.vertices = {0, 1, 2, 3};
  motion.centre = {1e3, 1.0 / 3, -7};
  motion.axis = {1, 2, 3};
  motion.angular_velocity = 5;
  motion.velocity = {1, 1, 1};
  motion.start = 2;
  const std::vector<Vec3f> start = to_single(scene.mesh.positions);
  for (const double t : {0.0, 1.0, 2.0}) {
    CHECK(prescribed_targets(scene, motion, t) == std::vector<Vec3f>(start.begin(), start.begin() + 4));
  }
  CHECK(prescribed_targets(scene, motion, 2.001) != std::vector<Vec3f>(start.begin(), start.begin() + 4));
}

TEST_CASE("after its end a motion stands still", "[unit]") {
  Scene scene = small_scene();
  PrescribedMotion& motion = scene.motions[0];
  motion.end = 0.75;
  CHECK(prescribed_targets(scene, motion, 0.75) == prescribed_targets(scene, motion, 100));
  CHECK(prescribed_targets(scene, motion, 0.75) != prescribed_targets(scene, motion, 0.5));
}

TEST_CASE("a quarter turn follows the right-hand rule about the centre, and translation adds up", "[unit]") {
  Scene scene = small_scene();
  scene.mesh.positions[0] = {0.5, 0.25, 0};
  PrescribedMotion motion;
  motion.vertices = {0};
  motion.centre = {0.25, 0, 0};
  motion.axis = {0, 0, 4};
  motion.angular_velocity = std::numbers::pi / 2;
  motion.velocity = {0, 0, 0.5};
  const Vec3f target = prescribed_targets(scene, motion, 1)[0];
  CHECK(distance(target, {0, 0.25f, 0.5f}) <= rounding);
}

TEST_CASE("prescribed motion is rigid: distances stay, whatever axis, centre and time", "[property]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5), angle(-100, 100);
  for (int i = 0; i < 1000; ++i) {
    Scene scene = small_scene();
    const auto draw = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
    for (Vec3& v : scene.mesh.positions) v = draw();
    PrescribedMotion motion;
    motion.vertices = {0, 1, 2};
    motion.axis = draw();
    motion.angular_velocity = angle(random);
    const std::vector<Vec3f> start = to_single(scene.mesh.positions), moved = prescribed_targets(scene, motion, 0.5);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      CHECK(std::abs(distance(moved[k], moved[next]) - distance(start[k], start[next])) <= 2 * rounding);
    }
  }
}
