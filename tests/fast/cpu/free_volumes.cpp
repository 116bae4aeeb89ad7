// Tests free volumes in the resident simulation (§3.9): bodies of tetrahedra push out each other, surfaces, and parts
// of themselves.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <tbb/global_control.h>

#include "compare/oracle/volume_audit.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/stages/volume_parts.hpp"
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

constexpr Index side = 4;                        ///< vertices of a block along each axis
constexpr std::size_t in_block = 64;             ///< vertices of a block
constexpr double spacing = 0.02, radius = 5e-3;  ///< [m]

bool same_bits(const std::vector<compare::Vec3f>& a, const std::vector<compare::Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(compare::Vec3f)) == 0;
}

compare::Material rubber(double friction = 0.5) {
  compare::Material material;
  material.solid_damping = 1e-3;
  material.friction = friction;
  return material;
}

/// Returns a material so soft and light that 60 iterations spread a block's weight through it.
compare::Material foam(double friction = 0.5) {
  compare::Material material = rubber(friction);
  material.solid_density = 100;
  material.solid_mu = material.solid_lambda = 1000;
  material.contact_stiffness = 8;
  return material;
}

/// Adds a free block of 4³ vertices as a volume.
void add_block(Scene& scene, const Vec3& corner, const compare::Material& material) {
  append_body(scene,
              {.name = "block" + std::to_string(scene.bodies.size()),
               .material = material,
               .contact = compare::BodyContact::volume},
              tests::block_mesh(side, spacing, corner));
}

/// Prescribes a velocity [m/s] for those vertices of a body at whose positions `is` returns true.
template <class Is>
void drive(Scene& scene, std::size_t body, const Vec3& velocity, Is is) {
  compare::PrescribedMotion motion;
  motion.name = "motion" + std::to_string(body);
  for (Index v = 0; v < scene.bodies[body].vertex_count; ++v) {
    const Index vertex = scene.bodies[body].first_vertex + v;
    if (is(scene.mesh.positions[static_cast<std::size_t>(vertex)])) motion.vertices.push_back(vertex);
  }
  motion.velocity = velocity;
  scene.motions.push_back(motion);
}

bool is_at_ground(const Vec3& x) { return x.y < 1e-6; }

/// Returns two blocks. The first is held at its lowest vertices. The second is shifted sideways and begins 4 mm inside
/// the first.
Scene block_in_block() {
  Scene scene = empty_scene();
  add_block(scene, {0, 0, 0}, foam());
  add_block(scene, {0.006, 3 * spacing - 0.004, 0.007}, foam());
  drive(scene, 0, {}, is_at_ground);
  scene.settings.contact_radius = radius;
  scene.settings.time_step = 5e-3;
  scene.settings.iterations = 60;
  compare::round_to_single(scene);
  return scene;
}

compare::VolumePenetration penetration(const Scene& scene, const compare::Snapshot& state) {
  return compare::VolumeAuditor(scene).audit(compare::to_double(state.positions));
}

Vec3 mean(const std::vector<compare::Vec3f>& of, std::size_t block) {
  Vec3 sum;
  for (std::size_t v = block * in_block; v < (block + 1) * in_block; ++v)
    sum = {sum.x + of[v].x / in_block, sum.y + of[v].y / in_block, sum.z + of[v].z / in_block};
  return sum;
}

}  // namespace

TEST_CASE("a block that begins inside another comes out on the nearest side, and stays out under its weight",
          "[property]") {
  const Scene scene = block_in_block();
  const auto simulation = start_cpu(scene, {});
  const compare::VolumePenetration before = penetration(scene, simulation->snapshot());
  CHECK(before.vertices_inside > 8);
  CHECK(before.deepest == Approx(0.004).epsilon(1e-4));
  const std::vector<compare::StepMetrics> first = simulation->advance(1);
  CHECK(first[0].vertices_inside == static_cast<std::int64_t>(before.vertices_inside));
  CHECK(first[0].deepest == Approx(0.004).epsilon(1e-4));
  simulation->advance(9);
  for (const compare::StepMetrics& row : simulation->advance(190)) {
    CHECK(row.status == compare::step_clean);
    CHECK(row.vertices_inside == 0);
    CHECK(row.depth_unresolved == 0);
    CHECK(row.inverted_tetrahedra == 0);
    CHECK(row.vertices_cut == 0);
    CHECK(row.volume_contacts > 0);
  }
  const compare::Snapshot end = simulation->snapshot();
  CHECK(penetration(scene, end).vertices_inside == 0);
  CHECK(mean(end.positions, 1).y > 3 * spacing + 1.5 * spacing);  // it lies on the other block, not beside it
  // vertices of volumes have no bound
  for (const float bound : end.bounds) CHECK(bound == std::numeric_limits<float>::max());
}

TEST_CASE("what a free block is pressed by presses back: without other forces both blocks fly apart alike",
          "[property]") {
  Scene scene = block_in_block();
  scene.motions.clear();
  scene.gravity = {};
  scene.settings.iterations = 300;
  const auto simulation = start_cpu(scene, {});
  simulation->advance(10);
  const std::vector<compare::Vec3f> velocity = simulation->snapshot().velocities;
  const Vec3 low = mean(velocity, 0), high = mean(velocity, 1);
  CHECK(high.y > 0.05);
  // The masses are equal. 300 sweeps leave less than 10⁻³ of the force.
  CHECK(low.y == Approx(-high.y).epsilon(1e-3));
  CHECK(low.x == Approx(-high.x).margin(1e-3 * high.y));
  CHECK(low.z == Approx(-high.z).margin(1e-3 * high.y));
}

TEST_CASE("a free block goes along with a driven one that friction holds it on, and stays behind without friction",
          "[property]") {
  const auto travelled = [](double friction) {
    Scene scene = empty_scene();
    append_body(scene, {.name = "belt", .material = foam(friction), .contact = compare::BodyContact::volume},
                tests::block_mesh(side, 0.05));
    add_block(scene, {0.03, 0.1535, 0.04}, foam(friction));
    drive(scene, 0, {0.05, 0, 0}, [](const Vec3& x) { return x.y < 0.151; });
    scene.settings.contact_radius = radius;
    scene.settings.time_step = 5e-3;
    scene.settings.iterations = 60;
    compare::round_to_single(scene);
    const auto simulation = start_cpu(scene, {});
    for (const compare::StepMetrics& row : simulation->advance(80)) {
      CHECK(row.status == compare::step_clean);
      CHECK(row.largest_lag == 0);
      CHECK(row.vertices_inside == 0);
    }
    return mean(simulation->snapshot().positions, 1).x - 0.03 - 1.5 * spacing;
  };
  // The driven block moves for 0.4 s at 0.05 m/s. The free block first slides for v/(μ g) = 6 ms until it has this
  // speed. In this time it falls behind by half the driven block's distance.
  CHECK(travelled(0.8) == Approx(0.05 * 0.4).epsilon(0.05));
  CHECK(std::abs(travelled(0)) < 1e-4);
}

TEST_CASE("a prescribed surface pushes a free volume along", "[property]") {
  Scene scene = empty_scene();
  add_sheet(scene, 9, 0.2, 0.1, false);
  drive(scene, 0, {0, -0.2, 0}, [](const Vec3&) { return true; });
  append_body(scene, {.name = "block", .material = rubber(), .contact = compare::BodyContact::volume},
              tests::block_mesh(side, spacing, {-0.03, 0.03, -0.03}));
  scene.gravity = {};
  scene.settings.contact_radius = radius;
  scene.settings.iterations = 20;
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  for (const compare::StepMetrics& row : simulation->advance(30)) {
    CHECK(row.status == compare::step_clean);
    CHECK(row.largest_lag == 0);
  }
  // The sheet began 1 cm above the block and has moved down by 6 cm.
  const compare::Snapshot end = simulation->snapshot();
  float highest = -1;
  for (std::size_t v = 81; v < end.positions.size(); ++v) highest = std::max(highest, end.positions[v].y);
  CHECK(highest < 0.04f);
  CHECK(penetration(scene, end).vertices_inside == 0);
}

TEST_CASE("a sheet on a free volume comes to rest above it, and the volume bears it", "[property]") {
  Scene scene = empty_scene();
  add_sheet(scene, 24, 0.09, 0.07, false);
  add_block(scene, {-0.03, 0, -0.03}, rubber());
  drive(scene, 1, {}, is_at_ground);
  scene.settings.contact_radius = radius;
  scene.settings.iterations = 20;
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  bool grew = false;
  for (const compare::StepMetrics& row : simulation->advance(60)) {
    REQUIRE((row.status & ~compare::step_list_grew) == 0);
    grew = grew || row.repeats > 0;
    CHECK(row.vertices_inside == 0);
  }
  CHECK(grew);  // at least sixteen points press on one corner
  CHECK(penetration(scene, simulation->snapshot()).vertices_inside == 0);
}

TEST_CASE("free volumes: the same bits again, on any number of threads and across a restore", "[property]") {
  Scene scene = block_in_block();
  add_sheet(scene, 12, 0.09, 0.14, false);
  scene.velocities[140] = {0, -1, 0};
  const auto whole = start_cpu(scene, {});
  whole->advance(12);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = start_cpu(scene, {});
    alone->advance(12);
    CHECK(same_bits(alone->snapshot().positions, whole->snapshot().positions));
  }
  const auto first = start_cpu(scene, {}), second = start_cpu(scene, {});
  first->advance(5);
  const compare::Snapshot state = first->snapshot();
  second->restore(state);
  CHECK(second->advance(7).front().repeats == 0);
  CHECK(same_bits(second->snapshot().positions, whole->snapshot().positions));
  CHECK(same_bits(second->snapshot().velocities, whole->snapshot().velocities));
  CHECK(second->snapshot().capacities == whole->snapshot().capacities);
  for (const std::size_t of_corners : {std::size_t{0}, std::size_t{1}}) {
    compare::Snapshot wrong = state;
    wrong.capacities[wrong.capacities.size() - 1 - of_corners] = 0;
    CHECK_THROWS_AS(second->restore(wrong), std::invalid_argument);
  }
}

TEST_CASE("a volume's trees have one order, whatever the state with which a scene begins", "[unit]") {
  Scene scene = empty_scene();
  add_block(scene, {0, 0, 0}, rubber());
  const compare::Topology topology = compare::build_topology(scene);
  const PartOrder before = volume_parts(scene, topology).at(0);
  for (Vec3& x : scene.mesh.positions) x = {-3 * x.y, x.z, 2 * x.x};
  CHECK(volume_parts(scene, topology).at(0).facets == before.facets);
  CHECK(volume_parts(scene, topology).at(0).tetrahedra == before.tetrahedra);
  scene.rest_positions = scene.mesh.positions;  // of another shape at rest the order is another
  CHECK(volume_parts(scene, topology).at(0).facets != before.facets);
}

TEST_CASE("a body whose rest shape lies in itself is pushed out of itself", "[property]") {
  // A block in the shape of a U: 27 cells without the six upper cells in the middle. One arm leans into the other arm.
  compare::Mesh mesh = tests::block_mesh(side, spacing);
  std::vector<compare::Tetrahedron> kept;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::size_t cell = t / 6, i = cell / 9, j = cell / 3 % 3;
    if (i != 1 || j == 0) kept.push_back(mesh.tetrahedra[t]);
  }
  mesh.tetrahedra = kept;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::size_t i = v / 16, j = v / 4 % 4;
    Vec3& x = mesh.positions[v];
    if (i >= 2)
      x = {x.x - 0.008 * static_cast<double>(j), x.y - 0.003 * static_cast<double>(j),
           x.z + 0.002 * static_cast<double>(j)};
  }
  Scene scene = empty_scene();
  append_body(scene, {.name = "u", .material = rubber(), .contact = compare::BodyContact::volume}, mesh);
  scene.gravity = {};
  scene.settings.contact_radius = radius;
  scene.settings.iterations = 20;
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  const compare::VolumePenetration before = penetration(scene, simulation->snapshot());
  CHECK(before.vertices_inside >= 3);
  CHECK(before.edges_meeting > 0);
  const std::vector<compare::StepMetrics> rows = simulation->advance(100);
  CHECK(rows[0].vertices_inside == static_cast<std::int64_t>(before.vertices_inside));
  for (const compare::StepMetrics& row : rows) CHECK(row.status == compare::step_clean);
  CHECK(rows.back().vertices_inside == 0);
  const compare::VolumePenetration after = penetration(scene, simulation->snapshot());
  CHECK(after.vertices_inside == 0);
  CHECK(after.edges_meeting == 0);
}
