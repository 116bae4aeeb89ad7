// Tests bounds as planes: checks the planes of a detection exactly, and how far a step can move with them.
#include "fast/stages/planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "compare/oracle/audit.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/stages/detection.hpp"
#include "reference/geometry/plane.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"
#include "tests/fast/scenes.hpp"

namespace {

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

struct Held {
  compare::PlaneOut out;
  std::vector<float> nearest;
};

/// Returns the planes of a detection at `positions`.
Held detect(const compare::Topology& topology, const std::vector<compare::Vec3f>& positions,
            const std::vector<std::uint8_t>& is_fixed, float r, float r_q, int capacity = 0,
            const std::vector<compare::Vec3f>& displacement = {}) {
  CpuBackend backend;
  Detection<CpuBackend> detection(backend, topology, {}, capacity, compare::Bounds::planes, is_fixed);
  if (!displacement.empty()) detection.divide_planes_by(reinterpret_cast<const Vec*>(displacement.data()));
  const auto* x = reinterpret_cast<const Vec*>(positions.data());
  do {
    detection.detect(x, r, &r_q, 0.45f);
  } while (detection.grow());
  const std::size_t n = positions.size();
  const ContactView view = detection.view();
  return {{detection.download_planes(), {view.bound, view.bound + n}}, {view.d_min_vertex, view.d_min_vertex + n}};
}

/// Returns three crumpled layers, closer to each other than r.
tests::TestMesh layers(std::uint32_t seed) {
  tests::TestMesh surface;
  for (int k = 0; k < 3; ++k)
    surface.add(tests::jittered(tests::sheet(9, 1.0F, 0.4F * static_cast<float>(k)), 0.15F,
                                seed + static_cast<std::uint32_t>(k)));
  return surface;
}

std::vector<std::uint8_t> every_seventh(std::size_t count) {
  std::vector<std::uint8_t> fixed(count, 0);
  for (std::size_t v = 0; v < count; v += 7) fixed[v] = 1;
  return fixed;
}

bool are_equal(const compare::PlaneOut& a, const compare::PlaneOut& b) {
  if (a.bound != b.bound || a.planes.offsets != b.planes.offsets) return false;
  return std::ranges::equal(a.planes.items, b.planes.items,
                            [](const compare::VertexPlane& p, const compare::VertexPlane& q) {
                              return p.pair == q.pair && p.normal == q.normal && p.offset == q.offset;
                            });
}

/// Returns the pairs whose planes bound v. Each pair is given by its vertices, renumbered by `name` and sorted.
template <class Name>
std::vector<std::array<compare::Index, 4>> pairs_of(const compare::Topology& topology, const Held& held,
                                                    compare::Index v, Name name) {
  std::vector<std::array<compare::Index, 4>> pairs;
  for (const compare::VertexPlane& plane : held.out.planes.of(v)) {
    const auto first = static_cast<std::size_t>(plane.pair.first), second = static_cast<std::size_t>(plane.pair.second);
    std::array<compare::Index, 4> all{plane.pair.first};
    if (plane.pair.kind == compare::PrimitivePair::Kind::vertex_triangle)
      std::ranges::copy(topology.triangles[second], all.begin() + 1);
    else
      std::ranges::copy(topology.edges[second], std::ranges::copy(topology.edges[first], all.begin()).out);
    for (compare::Index& u : all) u = name(u);
    std::ranges::sort(all);
    pairs.push_back(all);
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// Adds a strip folded into a V. Its fold has three vertices at x = `apex`, its ends are at x = `ends` [m].
/// `is_upright`: the fold is along y instead of z.
void add_hook(compare::Scene& scene, double apex, double ends, bool is_upright) {
  const compare::Index first = add_sheet(scene, 3, 1, 0, false).first_vertex;
  compare::PrescribedMotion pull;
  for (compare::Index i = 0; i < 3; ++i)
    for (compare::Index j = 0; j < 3; ++j) {
      const compare::Index v = first + 3 * i + j;
      const double open = 0.08 * (i - 1), along = 0.012 * (j - 1);
      scene.mesh.positions[static_cast<std::size_t>(v)] = compare::Vec3{i == 1 ? apex : ends, is_upright ? along : open,
                                                                        is_upright ? open : along};
      if (i != 1) pull.vertices.push_back(v);
    }
  pull.velocity = {ends > apex ? 1.0 : -1.0, 0, 0};
  scene.motions.push_back(pull);
}

/// Returns the positions after `steps` steps; all steps must succeed.
std::vector<compare::Vec3f> positions_after(const compare::Scene& scene, int steps,
                                            std::vector<compare::StepMetrics>* rows = nullptr) {
  const auto simulation = start_cpu(scene, {});
  const auto all = simulation->advance(steps);
  REQUIRE(static_cast<int>(all.size()) == steps);
  REQUIRE(all.back().status == compare::step_clean);
  if (rows != nullptr) *rows = all;
  return simulation->snapshot().positions;
}

/// Returns a free sheet beside a fixed one, both upright, `apart` [m] from each other.
compare::Scene beside_a_wall(double apart) {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 4, 0.03, 0, false);
  add_sheet(scene, 2, 4, 0, true);
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    compare::Vec3& p = scene.mesh.positions[v];
    p = {p.x, p.z, v < 16 ? apart : 0};
  }
  scene.rest_positions = scene.mesh.positions;
  scene.settings.contact_radius = 0x1p-18;
  scene.settings.detection_radius_cap = 1024;
  scene.settings.bounds = compare::Bounds::planes;
  return scene;
}

}  // namespace

TEST_CASE("planes: a search limited by the last detection's pairs finds the same regions with fewer pairs",
          "[property]") {
  std::mt19937 random(20261129);
  std::uniform_real_distribution<float> step(-0.1F, 0.1F);
  for (const std::uint32_t seed : {1U, 2U}) {
    const tests::TestMesh surface = layers(seed);
    const compare::Topology topology = surface.topology();
    const auto is_fixed = every_seventh(surface.positions.size());
    std::vector<compare::Vec3f> positions = surface.positions;
    CpuBackend backend;
    // In the second case the lists grow, after which a search goes up to r_q again.
    Detection<CpuBackend> kept(backend, topology, {}, seed == 1 ? 1 << 16 : 1, compare::Bounds::planes, is_fixed);
    for (int detection = 0; detection < 6; ++detection) {
      // One motion is larger than r_q, so that other pairs become the nearest ones; the others are small.
      for (compare::Vec3f& x : positions)
        x.x += (detection == 3 ? 20 : 1) * step(random), x.y += step(random), x.z += step(random);
      const float r = 0.3F, r_q = detection == 4 ? 0.6F : 1.5F;
      do {
        kept.detect(reinterpret_cast<const Vec*>(positions.data()), r, &r_q, 0.45F);
      } while (kept.grow());
      const Held fresh = detect(topology, positions, is_fixed, r, r_q, 1 << 16);
      const ContactView view = kept.view();
      const std::size_t n = positions.size();
      CHECK(are_equal({kept.download_planes(), {view.bound, view.bound + n}}, fresh.out));
      CHECK(std::equal(view.d_min_vertex, view.d_min_vertex + n, fresh.nearest.begin()));
      Detection<CpuBackend> whole(backend, topology, {}, 1 << 16, compare::Bounds::planes, is_fixed);
      whole.detect(reinterpret_cast<const Vec*>(positions.data()), r, &r_q, 0.45F);
      CHECK(*kept.view().vertex_facet_count == *whole.view().vertex_facet_count);
      CHECK(*kept.view().edge_edge_count == *whole.view().edge_edge_count);
      if (detection == 1 || detection == 2) CHECK(*kept.lists().noted_count < 0.8 * *whole.lists().noted_count);
    }
  }
}

TEST_CASE("planes: each pair within r_q has a plane or is covered by balls, exactly", "[property]") {
  std::size_t separated = 0;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const tests::TestMesh surface = layers(seed);
    const compare::Topology topology = surface.topology();
    const auto is_fixed = every_seventh(surface.positions.size());
    for (const float r_q : {0.3F, 1.2F}) {
      const Held held = detect(topology, surface.positions, is_fixed, 0.3F, r_q);
      const compare::PlaneIn in{&topology, {}, surface.positions, is_fixed, r_q, 0.45F};
      const compare::PlaneGuarantee truth = reference::plane_guarantee(in, held.out);
      CHECK(truth.kept());
      separated += truth.separated;
      for (compare::Index v = 0; v < topology.vertex_count; ++v)
        CHECK(held.out.planes.of(v).size() <= (is_fixed[static_cast<std::size_t>(v)] != 0 ? 0 : most_planes));
    }
  }
  CHECK(separated > 1000);
}

TEST_CASE("planes: divided by approach they hold every pair apart, exactly, and each side has its share",
          "[property]") {
  const tests::TestMesh surface = layers(7);
  const compare::Topology topology = surface.topology();
  const auto is_fixed = every_seventh(surface.positions.size());
  std::mt19937 engine(15);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<compare::Vec3f> displacement;
  for (const std::uint8_t fixed : is_fixed)
    displacement.push_back(fixed != 0 ? compare::Vec3f{} : compare::Vec3f{unit(engine), unit(engine), unit(engine)});
  const compare::PlaneIn in{&topology, {}, surface.positions, is_fixed, 1.2F, 0.45F, displacement};
  const Held divided = detect(topology, surface.positions, is_fixed, 0.3F, 1.2F, 0, displacement),
             halved = detect(topology, surface.positions, is_fixed, 0.3F, 1.2F);
  CHECK(reference::plane_guarantee(in, divided.out).kept());
  const compare::PlaneFreedom free = reference::plane_freedom(in, divided.out);
  CHECK(free.missing == 0);
  CHECK(free.narrowing <= compare::plane_narrowing_tolerance);
  CHECK(free.division <= compare::plane_division_tolerance);
  CHECK(reference::plane_freedom(in, halved.out).division > 1e5);
  CHECK(divided.out.bound == halved.out.bound);
}

TEST_CASE("planes: no vertex has a smaller ball than without planes, and some have larger ones", "[property]") {
  const tests::TestMesh surface = layers(4);
  const compare::Topology topology = surface.topology();
  const std::vector<std::uint8_t> none(surface.positions.size(), 0);
  const Held held = detect(topology, surface.positions, none, 0.3F, 1.2F);
  int smaller = 0, larger = 0;
  for (std::size_t v = 0; v < none.size(); ++v) {
    const float ball = round_down(static_cast<double>(0.45F) * held.nearest[v]);
    smaller += held.out.bound[v] < ball;
    larger += held.out.bound[v] > ball;
  }
  CHECK(smaller == 0);
  CHECK(larger > 100);
}

TEST_CASE("planes: nothing bounds a vertex inside a solid, and it bounds nothing", "[unit]") {
  // a vertex beside the middle of a triangle, nearer to the triangle than anything else
  const std::vector<compare::Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3F, 0.3F, 0.01F}};
  compare::Topology topology = compare::build_topology(4, std::vector<compare::Triangle>{{0, 1, 2}});
  const std::vector<std::uint8_t> none(4, 0);
  CHECK(detect(topology, positions, none, 0.1F, 0.1F).out.planes.of(3).size() == 1);
  topology.off_surface = {0, 0, 0, 1};
  const Held held = detect(topology, positions, none, 0.1F, 0.1F);
  CHECK(held.out.planes.items.empty());
  CHECK(held.out.bound[3] == largest_float);
  CHECK(held.out.bound[0] == round_down(static_cast<double>(0.45F) * static_cast<double>(0.1F)));
}

TEST_CASE("planes: lists that start with room for one contact, and one thread, give the same bits", "[property]") {
  const tests::TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  const auto is_fixed = every_seventh(surface.positions.size());
  const Held held = detect(topology, surface.positions, is_fixed, 0.3F, 1.2F);
  CHECK(are_equal(held.out, detect(topology, surface.positions, is_fixed, 0.3F, 1.2F, 1).out));
}

TEST_CASE("planes: a sheet that falls past a wall a few micrometres away falls freely", "[property]") {
  const double apart = 4e-6, h = 0.01;
  compare::Scene scene = beside_a_wall(apart);
  const int steps = 20;
  const double fall = 9.81 * h * h * steps * (steps + 1) / 2;
  std::vector<compare::StepMetrics> rows;
  const auto free = positions_after(scene, steps, &rows);
  // Each step rounds a position below 2 m to 2⁻²⁴ m, and its velocity keeps this error.
  for (std::size_t v = 0; v < 16; ++v)
    CHECK(std::abs(free[v].y - (scene.mesh.positions[v].y - fall)) < steps * (steps + 1) * 0x1p-24);
  // With balls, each of the 16 rounds and 10 iterations of a step lets the sheet fall by at most γ_p times its distance
  // from the wall.
  scene.settings.bounds = compare::Bounds::ball;
  const auto stuck = positions_after(scene, steps);
  for (std::size_t v = 0; v < 16; ++v)
    CHECK(scene.mesh.positions[v].y - stuck[v].y < steps * 26 * 0.45 * (apart + 1e-6));
}

TEST_CASE("planes: a cloth pulled out between two plates leaves, and passes neither", "[property]") {
  compare::Scene scene = empty_scene();
  compare::Material smooth;
  smooth.friction = 0;
  add_sheet(scene, 6, 0.1, 0, false, smooth);
  add_sheet(scene, 6, 0.3, 0.004, true, smooth);
  add_sheet(scene, 6, 0.3, -0.004, true, smooth);
  for (std::size_t v = 0; v < 30; ++v) scene.velocities[v] = {0, v % 2 == 0 ? 2.0 : -2.0, 0};
  compare::PrescribedMotion pull;
  for (compare::Index v = 30; v < 36; ++v) pull.vertices.push_back(v);
  pull.velocity = {0.5, 0, 0};
  scene.motions.push_back(pull);
  scene.settings.bounds = compare::Bounds::planes;
  const compare::Topology topology = compare::build_topology(scene);
  const auto simulation = start_cpu(scene, {});
  for (int k = 0; k < 60; ++k) {
    const auto rows = simulation->advance(1);
    REQUIRE(rows.back().status == compare::step_clean);
    CHECK(rows.back().largest_lag == 0);
    const compare::Snapshot state = simulation->snapshot();
    CHECK(compare::audit(topology, compare::to_double(state.positions), compare::exclusions(scene)).count == 0);
    CHECK(reference::broken_planes(state.planes, state.positions) == 0);
  }
  // After 0.3 m the cloth has left the plates, whose edges are 0.15 m from the middle.
  const auto end = simulation->snapshot().positions;
  CHECK(std::ranges::all_of(end.begin(), end.begin() + 36, [](const compare::Vec3f& p) { return p.x > 0.15f; }));
}

TEST_CASE("planes: two hooked corners stay hooked, however far they are pulled", "[property]") {
  compare::Scene scene = empty_scene();
  scene.gravity = {0, 0, 0};
  add_hook(scene, 0.02, -0.1, false);
  add_hook(scene, -0.02, 0.1, true);
  scene.rest_positions = scene.mesh.positions;
  scene.settings.bounds = GENERATE(compare::Bounds::planes, compare::Bounds::dat);
  const compare::Topology topology = compare::build_topology(scene);
  const auto simulation = start_cpu(scene, {});
  std::int64_t contacts = 0;
  for (int k = 0; k < 40; ++k) {
    const auto rows = simulation->advance(1);
    REQUIRE(rows.back().status == compare::step_clean);
    contacts = rows.back().vertex_facet_contacts + rows.back().edge_edge_contacts;
    const compare::Snapshot state = simulation->snapshot();
    CHECK(compare::audit(topology, compare::to_double(state.positions), compare::exclusions(scene)).count == 0);
    CHECK(reference::broken_planes(state.planes, state.positions) == 0);
  }
  // The folds are still hooked: vertex 4, the middle of the first fold, has a larger x than vertex 13, the middle of
  // the second fold. The strips' ends have been pulled from |x| = 0.1 m to more than 0.2 m, but lag behind their
  // prescribed motion.
  const auto end = simulation->snapshot().positions;
  CHECK(contacts > 0);
  CHECK(end[4].x > end[13].x);
  CHECK(end[0].x < -0.2f);
  CHECK(end[9].x > 0.2f);
}

TEST_CASE("planes: renumbered vertices have the planes of the same pairs, and the same balls but for rounding",
          "[property]") {
  const tests::TestMesh surface = layers(6);
  const auto is_fixed = every_seventh(surface.positions.size());
  const auto n = static_cast<compare::Index>(surface.positions.size());
  tests::TestMesh other{surface.positions, surface.triangles, {}};
  std::vector<std::uint8_t> is_fixed_there(is_fixed);
  const auto there = [n](compare::Index v) { return n - 1 - v; };
  for (compare::Index v = 0; v < n; ++v) {
    other.positions[static_cast<std::size_t>(there(v))] = surface.positions[static_cast<std::size_t>(v)];
    is_fixed_there[static_cast<std::size_t>(there(v))] = is_fixed[static_cast<std::size_t>(v)];
  }
  std::ranges::reverse(other.triangles);
  for (compare::Triangle& t : other.triangles) t = {there(t[1]), there(t[2]), there(t[0])};
  const compare::Topology topology = surface.topology(), other_topology = other.topology();
  const Held a = detect(topology, surface.positions, is_fixed, 0.3F, 0.5F),
             b = detect(other_topology, other.positions, is_fixed_there, 0.3F, 0.5F);
  std::size_t planes = 0;
  for (compare::Index v = 0; v < n; ++v) {
    const float ball = a.out.bound[static_cast<std::size_t>(v)], same = b.out.bound[static_cast<std::size_t>(there(v))];
    // Distances are below 1. Their rounding depends on the order of corners and edges.
    CHECK(std::abs(ball - same) <= 8 * 0x1p-24F);
    const auto pairs = pairs_of(topology, a, v, there);
    CHECK(pairs == pairs_of(other_topology, b, there(v), [](compare::Index u) { return u; }));
    planes += pairs.size();
  }
  CHECK(planes > 500);
}

// Planes of the previous step must not change a result: each step is taken by a new simulation.
TEST_CASE("planes: a simulation that is replaced by a new one after each step comes to the same bits", "[property]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 8, 0.06, 0.003, false);
  add_sheet(scene, 6, 0.1, 0, true);
  for (std::size_t v = 0; v < 64; ++v) scene.velocities[v] = {0.5, -1, 0};
  scene.settings.bounds = GENERATE(compare::Bounds::planes, compare::Bounds::dat);
  const auto whole = positions_after(scene, 20);
  compare::Snapshot state = start_cpu(scene, {})->snapshot();
  for (int k = 0; k < 20; ++k) {
    const auto next = start_cpu(scene, {}, 1);
    next->restore(state);
    next->advance(1);
    state = next->snapshot();
  }
  CHECK(state.positions == whole);
}

TEST_CASE("bounds=off: nothing is cut, and sheets pass through each other", "[unit]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 4, 0.03, 0.02, false);  // without contacts at the start
  add_sheet(scene, 4, 0.3, 0, true);
  for (std::size_t v = 0; v < 16; ++v) scene.velocities[v] = {0, -100, 0};
  scene.settings.bounds = compare::Bounds::off;
  std::vector<compare::StepMetrics> rows;
  const auto end = positions_after(scene, 1, &rows);
  CHECK(rows.back().vertices_cut == 0);
  CHECK(rows.back().discrete_detections == 1);
  CHECK(end[0].y < -0.5f);
}

TEST_CASE("contacts listed with a margin act below the radius alone", "[property]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 6, 0.1, 0.006, false);
  add_sheet(scene, 6, 0.3, 0, true);
  scene.gravity = {0, 0, 0};
  scene.settings.contact_margin = 0.5;
  std::vector<compare::StepMetrics> rows;
  const auto end = positions_after(scene, 2, &rows);
  CHECK(rows.back().vertex_facet_contacts > 0);
  CHECK(rows.back().contact_energy == 0);
  for (std::size_t v = 0; v < 36; ++v) CHECK(end[v].y == 0.006f);
}
