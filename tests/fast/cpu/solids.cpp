// Tests whole runs of solids against closed forms: free fall, rest, a stretched bar, a block on a block.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include <tbb/global_control.h>

#include "compare/oracle/audit.hpp"
#include "compare/problem/validate.hpp"
#include "fast/contestant.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/kernels/kinds/tetrahedron.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;
using ogc::tests::block_mesh;

namespace {

/// Adds a block of n³ vertices, `spacing` apart, whose lowest corner is `corner`.
compare::Body& add_block(compare::Scene& scene, compare::Index n, double spacing, const compare::Vec3& corner,
                         const compare::Material& material = {}) {
  append_body(scene, {.name = "block" + std::to_string(scene.bodies.size()), .material = material},
              block_mesh(n, spacing, corner));
  return scene.bodies.back();
}

bool same_bits(const std::vector<compare::Vec3f>& a, const std::vector<compare::Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(compare::Vec3f)) == 0;
}

/// Returns a damped block that falls askew onto a fixed one, and, if `with_sheet`, a sheet between them.
compare::Scene drop_scene(bool with_sheet) {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.solid_damping = 1e-3;
  add_block(scene, 4, 0.02, {-0.03, 0.02, -0.03}, material);
  for (compare::Index v = 0; v < 64; ++v) {
    compare::Vec3& x = scene.mesh.positions[static_cast<std::size_t>(v)];
    x.y += 0.1 * x.x + 0.05 * x.z;
  }
  add_block(scene, 4, 0.03, {-0.045, -0.09, -0.045}).fixed = true;
  if (with_sheet)
    append_body(scene, {.name = "sheet", .material = {}}, [] {
      compare::Scene sheet = empty_scene();
      add_sheet(sheet, 8, 0.08, 0.008, false);
      return sheet.mesh;
    }());
  scene.settings.contact_radius = 4e-3;
  compare::round_to_single(scene);
  return scene;
}

}  // namespace

TEST_CASE("a block far from everything falls as -g h^2 n(n+1)/2, and keeps its shape", "[property]") {
  compare::Scene scene = empty_scene();
  scene.settings.contact_radius = 0.02;
  add_block(scene, 4, 0.05, {0, 1, 0});
  const auto simulation = start_cpu(scene, {});
  const double g = 9.81f, h = static_cast<double>(static_cast<float>(scene.settings.time_step));
  for (int n = 1; n <= 20; ++n) {
    const auto row = simulation->advance(1).back();
    REQUIRE(row.status == compare::step_clean);
    CHECK(row.inverted_tetrahedra == 0);
    const compare::Snapshot now = simulation->snapshot();
    for (std::size_t v = 0; v < now.positions.size(); ++v) {
      const compare::Vec3& rest = scene.mesh.positions[v];
      // Coordinates of 1 m are rounded once per step and once per sweep.
      CHECK(double{now.positions[v].y} == Approx(rest.y - g * h * h * n * (n + 1) / 2).margin(n * 1e-6));
      CHECK(double{now.positions[v].x} == Approx(rest.x).margin(n * 1e-6));
    }
  }
}

TEST_CASE("a vertex inside a block has no bound, and all others have one", "[unit]") {
  compare::Scene scene = empty_scene();
  add_block(scene, 3, 0.1, {});
  const auto simulation = start_cpu(scene, {});
  simulation->advance(1);
  const std::vector<float> bounds = simulation->snapshot().bounds;
  for (std::size_t v = 0; v < bounds.size(); ++v) CHECK((bounds[v] == std::numeric_limits<float>::max()) == (v == 13));
}

TEST_CASE("a bar whose ends are stretched takes the closed-form length and width in between", "[property]") {
  // The bar is stretched by a, and its width by b. Without lateral force ∂ψ/∂b = 0, with ψ = μ/2 (a² + 2b² − 3) − μ (J
  // − 1) + (λ + μ)/2 (J − 1)² and J = ab². Hence J − 1 = μ (a − 1)/((λ + μ) a).
  compare::Scene scene = empty_scene();
  scene.gravity = {};
  const double a = 1.3, mu = 1e4, lambda = 3e4, b = std::sqrt((1 + mu * (a - 1) / ((lambda + mu) * a)) / a);
  compare::Material material;
  material.solid_mu = mu, material.solid_lambda = lambda;
  add_block(scene, 4, 0.1, {}, material);
  compare::PrescribedMotion ends;
  ends.name = "ends";
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    const bool held = x.x < 0.05 || x.x > 0.25;
    if (held) ends.vertices.push_back(static_cast<compare::Index>(v));
    x = {a * x.x, (held ? b : 1) * x.y, (held ? b : 1) * x.z};
  }
  scene.motions = {ends};
  scene.settings.contact_radius = 0.02;
  scene.settings.time_step = 1;
  const auto simulation = start_cpu(scene, {});
  const auto rows = simulation->advance(60);
  REQUIRE(rows.back().status == compare::step_clean);
  const compare::Snapshot end = simulation->snapshot();
  for (std::size_t v = 0; v < end.positions.size(); ++v) {
    const compare::Vec3& rest = scene.rest_positions[v];
    CHECK(double{end.positions[v].x} == Approx(a * rest.x).margin(1e-5));
    CHECK(double{end.positions[v].y} == Approx(b * rest.y).margin(1e-5));
    CHECK(double{end.positions[v].z} == Approx(b * rest.z).margin(1e-5));
  }
  const double j = a * b * b,
               density = mu / 2 * (a * a + 2 * b * b - 3) - mu * (j - 1) + (lambda + mu) / 2 * (j - 1) * (j - 1);
  CHECK(rows.back().elastic_energy == Approx(density * 0.027).epsilon(1e-4));
}

TEST_CASE("a block that is pressed through itself comes back, and its inverted tetrahedra are counted", "[property]") {
  compare::Scene scene = empty_scene();
  scene.gravity = {};
  compare::Material material;
  material.solid_damping = 0.02;
  add_block(scene, 3, 0.1, {}, material);
  scene.mesh.positions[13] = {0.1, 0.35, 0.1};  // a vertex inside at rest, now outside: it has no bound
  scene.settings.contact_radius = 0.02;
  const auto simulation = start_cpu(scene, {});
  const auto first = simulation->advance(1).back();
  CHECK(first.inverted_tetrahedra > 0);
  const auto rows = simulation->advance(300);
  CHECK(rows.back().inverted_tetrahedra == 0);
  CHECK(rows.back().elastic_energy < 1e-3 * first.elastic_energy);
}

TEST_CASE("a block that lands on a block rests on it", "[property]") {
  const compare::Scene scene = drop_scene(false);
  REQUIRE(describe(validate(scene)).empty());
  const auto simulation = start_cpu(scene, {});
  const auto rows = simulation->advance(250);
  REQUIRE(rows.size() == 250);
  CHECK(rows.back().kinetic_energy < 1e-5);
  CHECK(rows.back().vertex_facet_contacts + rows.back().edge_edge_contacts > 0);
  const compare::Snapshot end = simulation->snapshot();
  float lowest = 1;
  for (std::size_t v = 0; v < 64; ++v) lowest = std::min(lowest, end.positions[v].y);
  CHECK(lowest > 0);
  CHECK(lowest < 4e-3f);
  CHECK(audit(build_topology(scene), compare::to_double(end.positions), exclusions(scene)).count == 0);
}

TEST_CASE("solids give the same bits run to run, with any number of threads, and from a snapshot", "[property]") {
  for (const bool with_sheet : {false, true}) {
    const compare::Scene scene = drop_scene(with_sheet);
    const auto whole = start_cpu(scene, {});
    whole->advance(20);
    const compare::Snapshot middle = whole->snapshot();
    whole->advance(20);
    const auto alone = [&] {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      const auto simulation = start_cpu(scene, {});
      simulation->advance(40);
      return simulation->snapshot();
    }();
    CHECK(same_bits(alone.positions, whole->snapshot().positions));
    const auto resumed = start_cpu(scene, {});
    resumed->restore(middle);
    resumed->advance(20);
    CHECK(same_bits(resumed->snapshot().positions, whole->snapshot().positions));
    CHECK(same_bits(resumed->snapshot().velocities, whole->snapshot().velocities));
  }
}

TEST_CASE("a scene asks of its sum what it has: kinds, volumes, other models, another activation", "[unit]") {
  const auto asked = [](const compare::Scene& scene) {
    return asked_of_sum(build_rest_state(scene, build_topology(scene)), scene);
  };
  const unsigned sheet = Kinds::bit<TriangleKind> | Kinds::bit<HingeKind>;
  CHECK(asked(drop_scene(false)) == Kinds::bit<TetrahedronKind>);
  CHECK(asked(drop_scene(true)) == (Kinds::bit<TetrahedronKind> | sheet));
  compare::Scene with_volume = drop_scene(true);
  with_volume.bodies.back().contact = compare::BodyContact::volume;
  CHECK((asked(with_volume) & asks_volumes) != 0);
  compare::Scene bent = drop_scene(true);
  for (compare::Body& body : bent.bodies) body.material.bending = compare::BendingModel::isometric_quadratic;
  CHECK(asked(bent) == (Kinds::bit<TetrahedronKind> | sheet | asks_any_bending));
  compare::Scene other = drop_scene(false);
  other.settings.damping = compare::DampingForm::per_vertex;
  CHECK(asked(other) == (Kinds::bit<TetrahedronKind> | asks_any_model));
  other.settings.contact_activation = compare::ContactActivation::quadratic;
  CHECK(asked(other) == (Kinds::bit<TetrahedronKind> | asks_any_model | asks_any_activation));
}

TEST_CASE("the work of a sweep counts a tetrahedron once for each of its free corners", "[unit]") {
  compare::Scene scene = empty_scene();
  add_block(scene, 3, 0.1, {});
  const SweepWork one = sweep_work(scene);
  const auto stencils = static_cast<double>(4 * scene.mesh.tetrahedra.size());
  CHECK(one.bytes > stencils * sizeof(TetrahedronIncidence));
  CHECK(one.flop > 80 * stencils);
  add_block(scene, 3, 0.1, {1, 0, 0});
  const SweepWork two = sweep_work(scene);
  CHECK(two.vertices == 2 * one.vertices);
  CHECK(two.flop == 2 * one.flop);
  CHECK(two.bytes == 2 * one.bytes);
  // Damping of one block adds the work of its own stencils only. A fixed block needs no work.
  scene.bodies[1].material.solid_damping = 1e-3;
  const double damping = sweep_work(scene).flop - two.flop;
  CHECK(damping > 200 * stencils);
  scene.bodies[0].fixed = true;
  CHECK(sweep_work(scene).flop == one.flop + damping);
  // A prescribed vertex needs no work, because the sweep computes no forces on it.
  scene.bodies[0].fixed = false;
  scene.bodies[1].material.solid_damping = 0;
  scene.motions.resize(1);
  scene.motions[0].name = "held";
  scene.motions[0].vertices = {0};
  const double own = two.flop - sweep_work(scene).flop;
  const auto of_corner = std::ranges::count_if(
      scene.mesh.tetrahedra, [](const compare::Tetrahedron& t) { return std::ranges::count(t, 0) > 0; });
  CHECK(own > 80 * static_cast<double>(of_corner));
  CHECK(own < 90 * static_cast<double>(of_corner) + 100);
}

TEST_CASE("no two vertices of a tetrahedron share a colour, and a grid about one diagonal has four", "[unit]") {
  compare::Scene scene = empty_scene();
  add_block(scene, 6, 0.1, {});
  const RestState rest = build_rest_state(scene, build_topology(scene));
  const Colouring colouring = colour_vertices(rest);
  for (const compare::Tetrahedron& t : scene.mesh.tetrahedra) {
    std::set<int> colours;
    for (const compare::Index v : t) colours.insert(colouring.colour[static_cast<std::size_t>(v)]);
    CHECK(colours.size() == 4);
  }
  CHECK(colouring.count == 4);
}
