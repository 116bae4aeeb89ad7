// Tests driven volumes in the resident simulation (§3.9): they reach their targets, push vertices out, and drag them
// along by friction.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "compare/oracle/audit.hpp"
#include "compare/oracle/volume_audit.hpp"
#include "compare/problem/validate.hpp"
#include "fast/cpu/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;
using compare::Index;
using compare::Scene;
using compare::Vec3;

namespace {

bool same_bits(const std::vector<compare::Vec3f>& a, const std::vector<compare::Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(compare::Vec3f)) == 0;
}

/// Adds a box from `low` to `high` [m] as a fixed volume of twelve triangles.
compare::Body& add_box(Scene& scene, const Vec3& low, const Vec3& high, double friction = 0.2) {
  compare::Mesh mesh;
  for (int v = 0; v < 8; ++v)
    mesh.positions.push_back(
        {v / 4 == 0 ? low.x : high.x, v / 2 % 2 == 0 ? low.y : high.y, v % 2 == 0 ? low.z : high.z});
  for (const auto& [a, b, c, d] :
       {compare::Tetrahedron{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({a, c, d});
  compare::Material material;
  material.friction = friction;
  append_body(scene, {.name = "box", .fixed = true, .material = material, .contact = compare::BodyContact::volume},
              mesh);
  return scene.bodies.back();
}

/// Moves the last body with this velocity [m/s], and rotates it about the y axis.
void drive(Scene& scene, const Vec3& velocity, double angular_velocity = 0) {
  compare::Body& body = scene.bodies.back();
  body.fixed = false;
  compare::PrescribedMotion motion;
  motion.name = "driven";
  for (Index v = 0; v < body.vertex_count; ++v) motion.vertices.push_back(body.first_vertex + v);
  motion.velocity = velocity;
  motion.axis = {0, 1, 0};
  motion.angular_velocity = angular_velocity;
  scene.motions.push_back(motion);
}

/// Returns a sheet over a box that supports it; r = 5 mm.
Scene sheet_over_box(double height, double friction = 0.5) {
  Scene scene = empty_scene();
  compare::Material material;
  material.friction = friction;
  add_sheet(scene, 8, 0.1, height, false, material);
  add_box(scene, {-0.3, -0.1, -0.3}, {0.3, 0, 0.3}, friction);
  scene.settings.iterations = 20;
  scene.settings.detection_fraction = 1;
  compare::round_to_single(scene);
  return scene;
}

compare::VolumePenetration penetration(const Scene& scene, const compare::Snapshot& state) {
  return compare::VolumeAuditor(scene).audit(compare::to_double(state.positions));
}

std::pair<float, float> heights(const compare::Snapshot& state, std::size_t count) {
  const auto [low, high] = std::minmax_element(state.positions.begin(),
                                               state.positions.begin() + static_cast<std::ptrdiff_t>(count),
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  return {low->y, high->y};
}

}  // namespace

TEST_CASE("a sheet that falls on a volume comes to rest r above it, less what its weight presses", "[unit]") {
  const Scene scene = sheet_over_box(0.02);
  const auto simulation = start_cpu(scene, {});
  for (const compare::StepMetrics& row : simulation->advance(150)) CHECK(row.status == compare::step_clean);
  const compare::Snapshot state = simulation->snapshot();
  const auto [low, high] = heights(state, 64);
  // A vertex weighs 0.2 kg/m² times (0.1/7)² m², or twice as much if it has eight triangles. This weight compresses a
  // contact of 100 N/m by at most 8 µm.
  CHECK(low > 0.005f - 1e-5f);
  CHECK(high < 0.005f + 1e-5f);
  CHECK(penetration(scene, state).vertices_inside == 0);
}

namespace {

/// Adds a box with walls 5 cm thick around the void from (−0.1, 0, −0.1) to (0.1, 0.1, 0.1) m, of triangles only.
void add_hollow_box(Scene& scene) {
  add_box(scene, {-0.15, -0.05, -0.15}, {0.15, 0.15, 0.15});
  compare::Body& body = scene.bodies.back();
  const compare::Index first = body.first_vertex;
  for (int v = 0; v < 8; ++v) {
    const Vec3 x{v / 4 == 0 ? -0.1 : 0.1, v / 2 % 2 == 0 ? 0.0 : 0.1, v % 2 == 0 ? -0.1 : 0.1};
    scene.mesh.positions.push_back(x), scene.rest_positions.push_back(x), scene.velocities.emplace_back();
  }
  for (std::size_t t = 12; t > 0; --t) {
    const auto [a, b, c] = scene.mesh.triangles[scene.mesh.triangles.size() - 12];
    CHECK(a >= first);
    scene.mesh.triangles.push_back({a + 8, c + 8, b + 8});
  }
  body.vertex_count += 8, body.triangle_count += 12;
}

/// Adds a block of tetrahedra without its middle cell. This void has 0.2 × 0.2 × 0.2 m and its floor at y = 0.
void add_hollow_block(Scene& scene) {
  compare::Mesh mesh = ogc::tests::block_mesh(4, 0.2, {-0.3, -0.2, -0.3});
  const auto is_middle = [&](Index v) {
    const Vec3& x = mesh.positions[static_cast<std::size_t>(v)];
    return std::max({std::abs(x.x), std::abs(x.z), std::abs(x.y - 0.1)}) < 0.15;
  };
  std::erase_if(mesh.tetrahedra, [&](const compare::Tetrahedron& t) { return std::ranges::all_of(t, is_middle); });
  append_body(scene, {.name = "block", .fixed = true, .material = {}, .contact = compare::BodyContact::volume}, mesh);
}

}  // namespace

TEST_CASE("a cloth in the void of a volume falls on its floor and stays in the void, wherever that goes", "[unit]") {
  const auto [of_tetrahedra, is_driven] = GENERATE(std::pair{false, false}, std::pair{false, true},
                                                   std::pair{true, false});
  Scene scene = empty_scene();
  add_sheet(scene, 8, 0.1, 0.02, false).name = "sheet";
  if (of_tetrahedra)
    add_hollow_block(scene);
  else
    add_hollow_box(scene);
  const Vec3 velocity{0.1, 0.05, -0.2};
  if (is_driven) drive(scene, velocity);
  scene.settings.iterations = 20;
  scene.settings.detection_fraction = 1;
  compare::round_to_single(scene);
  REQUIRE(describe(validate(scene)) == "");
  const auto simulation = start_cpu(scene, {});
  CHECK(penetration(scene, simulation->snapshot()).vertices_inside == 0);
  const std::vector<compare::StepMetrics> rows = simulation->advance(150);
  for (const compare::StepMetrics& row : rows) CHECK(row.vertices_inside == 0);
  const compare::Snapshot state = simulation->snapshot();
  CHECK(penetration(scene, state).vertices_inside == 0);
  const double time = is_driven ? 150 * scene.settings.time_step : 0, r = scene.settings.contact_radius;
  for (std::size_t v = 0; v < 64; ++v) {
    const compare::Vec3f& x = state.positions[v];
    CHECK(std::abs(x.x - velocity.x * time) < 0.1);
    CHECK(std::abs(x.z - velocity.z * time) < 0.1);
    CHECK(x.y - velocity.y * time == Approx(r).margin(1e-4));
  }
}

TEST_CASE("who begins inside a volume comes out on the nearest side, and stays out", "[unit]") {
  Scene scene = sheet_over_box(-0.004);
  scene.settings.iterations = 1;  // one detection a step
  const auto simulation = start_cpu(scene, {});
  CHECK(penetration(scene, simulation->snapshot()).vertices_inside == 64);
  CHECK(penetration(scene, simulation->snapshot()).deepest == Approx(0.004).epsilon(1e-5));
  const std::vector<compare::StepMetrics> rows = simulation->advance(100);
  CHECK(rows.front().vertices_inside == 64);
  CHECK(rows.front().deepest == Approx(0.004).epsilon(1e-5));
  CHECK(rows.back().vertices_inside == 0);
  CHECK(penetration(scene, simulation->snapshot()).vertices_inside == 0);
  CHECK(heights(simulation->snapshot(), 64).first > 0);
}

TEST_CASE("a driven volume is at its targets, and carries along what lies on it", "[unit]") {
  Scene scene = sheet_over_box(0.0049);
  drive(scene, {0.2, 0, 0});
  const auto simulation = start_cpu(scene, {});
  for (const compare::StepMetrics& row : simulation->advance(60)) {
    CHECK(row.largest_lag == 0);
    CHECK(row.volume_contacts >= 64);
  }
  const compare::Snapshot state = simulation->snapshot();
  for (std::size_t v = 0; v < 64; ++v) CHECK(state.velocities[v].x == Approx(0.2).margin(0.01));
  const auto targets = prescribed_targets(scene, scene.motions[0], 60 * scene.settings.time_step);
  for (std::size_t k = 0; k < targets.size(); ++k) CHECK(state.positions[64 + k] == targets[k]);
}

TEST_CASE("without friction a driven volume slides away below what lies on it", "[unit]") {
  // Compares with the same sheet on a volume at rest. The velocities differ only by rounding errors of the contact
  // points on triangles.
  const auto velocities = [](bool is_driven) {
    Scene scene = sheet_over_box(0.0049, 0);
    if (is_driven) drive(scene, {0.2, 0, 0});
    const auto simulation = start_cpu(scene, {});
    simulation->advance(10);
    return simulation->snapshot().velocities;
  };
  const std::vector<compare::Vec3f> above_still = velocities(false), above_driven = velocities(true);
  for (std::size_t v = 0; v < 64; ++v) CHECK(above_driven[v].x == Approx(above_still[v].x).margin(1e-3));
}

TEST_CASE("two sheets on a volume that rises fast never pass through each other", "[property]") {
  Scene scene = empty_scene();
  add_sheet(scene, 8, 0.1, 0.006, false);
  add_sheet(scene, 7, 0.09, 0.012, false);
  add_box(scene, {-0.03, -0.1, -0.03}, {0.03, 0, 0.03});
  drive(scene, {0.1, 2, 0}, 5);
  scene.settings.iterations = 10;
  const auto simulation = start_cpu(scene, {});
  const compare::Topology topology = build_topology(scene);
  for (int k = 0; k < 20; ++k) {
    const compare::StepMetrics row = simulation->advance(1).at(0);
    REQUIRE(row.status == compare::step_clean);
    CHECK(row.largest_lag == 0);
    const compare::Snapshot state = simulation->snapshot();
    CHECK(compare::audit(topology, compare::to_double(state.positions), exclusions(scene)).count == 0);
  }
}

// γ_e K = 1,122 vertices must be cut to cause a detection, but the layers have only 98. The bounds of the layers allow
// 0.045 mm between two detections, and the box rises 5 mm per step.
TEST_CASE("layers that nearly touch are not left deep inside a volume that rises into them, whatever else is not cut",
          "[property]") {
  Scene scene = empty_scene();
  add_sheet(scene, 7, 0.06, 0.004, false);
  add_sheet(scene, 7, 0.06, 0.0041, false);
  add_sheet(scene, 32, 1, -1, false);
  add_box(scene, {-0.3, -0.1, -0.3}, {0.3, 0, 0.3});
  drive(scene, {0, 0.5, 0});
  scene.settings.iterations = 20;
  scene.settings.detection_fraction = 1;
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  const double radius = scene.settings.contact_radius;
  for (int k = 0; k < 20; ++k) {
    REQUIRE(simulation->advance(1).at(0).status == compare::step_clean);
    CHECK(penetration(scene, simulation->snapshot()).deepest < radius);
  }
}

TEST_CASE("rows of contacts with volumes grow, and a run with volumes has the same bits again and across a restore",
          "[property]") {
  Scene scene = sheet_over_box(-0.003);
  // nested boxes: a vertex is inside seven boxes at once
  for (int k = 0; k < 6; ++k) {
    const double by = 0.001 * k;
    add_box(scene, {-0.2 - by, -0.1 - by, -0.2}, {0.2 + by, 0.0005 * k, 0.2 + by});
  }
  drive(scene, {0.05, 0.01, 0});
  compare::round_to_single(scene);
  const auto whole = start_cpu(scene, {});
  const std::vector<compare::StepMetrics> rows = whole->advance(12);
  CHECK(rows[0].repeats > 0);
  CHECK(rows[0].volume_contacts > 64 * 4);
  const auto first = start_cpu(scene, {}), second = start_cpu(scene, {});
  first->advance(5);
  const compare::Snapshot state = first->snapshot();
  second->restore(state);
  CHECK(second->advance(7).front().repeats == 0);
  CHECK(same_bits(second->snapshot().positions, whole->snapshot().positions));
  CHECK(second->snapshot().capacities == whole->snapshot().capacities);
  compare::Snapshot wrong = state;
  wrong.capacities.back() = 0;
  CHECK_THROWS_AS(second->restore(wrong), std::invalid_argument);
}
