// Compares work counted by hand with work counted during a run.
#include "fast/contestant.hpp"

#include <string>

#include "compare/problem/scene.hpp"
#include "tests/catch.hpp"

using namespace ogc;

namespace {

/// Returns two free triangles as two bodies, at the heights 0 and `height` [m].
compare::Scene two_triangles(double height, double contact_radius) {
  compare::Scene scene;
  for (const double y : {0.0, height}) {
    compare::Mesh mesh;
    mesh.positions = {{0, y, 0}, {1, y, 0}, {0, y, 1}};
    mesh.triangles = {{0, 1, 2}};
    compare::Body body;
    body.name = y == 0 ? "low" : "high";
    append_body(scene, body, mesh);
  }
  scene.settings.contact_radius = contact_radius;
  return scene;
}

fast::SearchWork work_of(const compare::Scene& scene) {
  const std::vector<compare::Vec3f> positions = compare::to_single(scene.mesh.positions);
  return fast::search_work(scene, positions, static_cast<float>(scene.settings.contact_radius));
}

/// Returns a free triangle and others to which springs hold it by its first vertex.
compare::Scene star_of_springs(int springs, int lanes) {
  compare::Scene scene;
  for (int i = 0; i <= springs; ++i) {
    compare::Mesh mesh;
    mesh.positions = {{0, 0.1 * i, 0}, {1, 0.1 * i, 0}, {0, 0.1 * i, 1}};
    mesh.triangles = {{0, 1, 2}};
    compare::Body body;
    body.name = "triangle" + std::to_string(i);
    append_body(scene, body, mesh);
    if (i > 0) scene.springs.push_back({.first = 0, .second = 3 * i, .stiffness = 1, .rest_length = 1});
  }
  scene.settings.lanes = lanes;
  return scene;
}

/// Returns `rows` free strips of squares, each `columns` long and cut by one diagonal, as bodies.
compare::Scene strips(int rows, int columns) {
  compare::Scene scene;
  for (int row = 0; row < rows; ++row) {
    compare::Mesh mesh;
    for (int i = 0; i <= columns; ++i)
      for (const double z : {0.0, 1.0}) mesh.positions.push_back({static_cast<double>(i), 2.0 * row, z});
    for (compare::Index i = 0; i < 2 * columns; i += 2) {
      mesh.triangles.push_back({i, i + 1, i + 2});
      mesh.triangles.push_back({i + 2, i + 1, i + 3});
    }
    compare::Body body;
    body.name = "strip" + std::to_string(row);
    append_body(scene, body, mesh);
  }
  return scene;
}

}  // namespace

TEST_CASE("searches of two triangles within each other's radius open, are offered and measure what one counts by hand",
          "[unit]") {
  // Trees have four children per node. Edges: six edges are in two leaves under a root, and a search tests only edges
  // with a larger index. Six searches open the root and the second leaf, three searches also the first leaf: 6 + 6 + 3
  // nodes, 15 candidates. Vertices: six searches open the root and the leaf of both facets: 12 nodes, 12 candidates.
  // Pairs that share a vertex have no distance; 3 · 3 pairs of edges and 3 + 3 pairs of vertex and facet have one.
  const fast::SearchWork work = work_of(two_triangles(0.1, 10));
  CHECK(work.nodes == 15 + 12);
  CHECK(work.candidates == 15 + 12);
  CHECK(work.distances == 9 + 6);
  CHECK(work.flop > work.distances);
  CHECK(work.bytes > work.nodes * 4 * 6 * sizeof(float));
}

TEST_CASE("what lies beyond the radius costs no distance", "[property]") {
  const fast::SearchWork near = work_of(two_triangles(0.1, 0.2)), far = work_of(two_triangles(0.1, 0.05));
  CHECK(far.distances == 0);
  CHECK(near.distances > 0);
  CHECK(far.nodes <= near.nodes);
  CHECK(far.candidates <= near.candidates);
}

TEST_CASE("positions of another mesh are refused", "[unit]") {
  const compare::Scene scene = two_triangles(0.1, 0.2);
  CHECK_THROWS_AS(fast::search_work(scene, std::vector<compare::Vec3f>(5), 0.2F), std::invalid_argument);
}

TEST_CASE("the work of a sweep counts a segment once, and for each of its free ends", "[unit]") {
  const auto work_of_rods = [](int segments, int rods, bool is_held) {
    compare::Scene scene;
    for (int rod = 0; rod < rods; ++rod) {
      compare::Mesh mesh;
      for (compare::Index k = 0; k <= segments; ++k) {
        mesh.positions.push_back({1e-3 * k, 0.1 * rod, 0});
        if (k > 0) mesh.loose_edges.push_back({k - 1, k});
      }
      compare::Body body;
      body.name = "rod" + std::to_string(rod);
      body.material.rod = compare::RodMaterial{};
      append_body(scene, body, mesh);
    }
    if (is_held) scene.motions = {{.name = "held", .vertices = {0, 1}, .keyframes = {}}};
    return fast::sweep_work(scene);
  };
  const fast::SweepWork one = work_of_rods(100, 1, false), two = work_of_rods(100, 2, false),
                        longer = work_of_rods(200, 1, false), held = work_of_rods(100, 1, true);
  CHECK(one.vertices == 101);
  CHECK(one.launches == 4);   // two for segments, two for vertices
  CHECK(held.launches == 5);  // and one for the vertices of the motion
  CHECK(two.flop == 2 * one.flop);
  CHECK(two.bytes == 2 * one.bytes);
  // Each further vertex adds a segment with two ends. Flop and bytes per vertex are about those of the paper's yarn.
  CHECK((longer.flop - one.flop) / 100 == Approx(54 + 2 * 51 + 336));
  CHECK((longer.bytes - one.bytes) / 100 == Approx(280).epsilon(0.1));
  CHECK(one.flop - held.flop == Approx(2 * 54 + 3 * 51 + 336));
}

TEST_CASE("idle lanes: a vertex with W items costs as much as one with one item, and the next item a round more",
          "[property]") {
  for (const int lanes : {2, 4, 8, 16}) {
    const auto cost = [lanes](int springs) {
      return fast::sweep_work(star_of_springs(springs, lanes)).warp_instructions;
    };
    // Each spring also adds a triangle, whose cost is always the same.
    const double first = cost(2) - cost(1), full = cost(lanes) - cost(1), next = cost(lanes + 1) - cost(lanes);
    CHECK(full == Approx((lanes - 1) * first));
    CHECK(next - first > lanes * 74.0 / 64);  // the operations of a spring in all lanes of a team
  }
}

TEST_CASE("idle lanes add to the instructions of full lanes, and wider teams to those of narrow ones", "[property]") {
  compare::Scene scene = strips(3, 40);
  double narrower = 0;
  for (const int lanes : {2, 4, 8, 16}) {
    scene.settings.lanes = lanes;
    const fast::SweepWork work = fast::sweep_work(scene);
    CHECK(64 * work.warp_instructions >= work.flop);
    CHECK(work.warp_instructions > narrower);
    narrower = work.warp_instructions;
  }
}

TEST_CASE("neighbouring threads do the work after the sum only where a colour has waves of blocks", "[unit]") {
  compare::Scene scene = strips(20, 400);
  scene.settings.lanes = 8;
  const fast::SweepWork large = fast::sweep_work(scene, 1000), small = fast::sweep_work(scene, 1);
  // 54 operations of a vertex in two lanes, not in eight
  CHECK(large.warp_instructions - small.warp_instructions == Approx(large.vertices * 6 * 54.0 / 64));
  scene.settings.bounds = compare::Bounds::planes;
  CHECK(fast::sweep_work(scene, 1).warp_instructions == large.warp_instructions);
}

TEST_CASE("sectors are at least the bytes, and few more where every colour is a stream of its own", "[property]") {
  for (const compare::Scene& scene : {strips(1, 1), strips(3, 100), star_of_springs(20, 8)}) {
    const fast::SweepWork work = fast::sweep_work(scene);
    CHECK(work.sector_bytes >= work.bytes);
  }
  // A strip's colours are spread evenly, so each of its launches touches nearly all sectors of x, y, X_prev, b_v.
  const fast::SweepWork one = fast::sweep_work(strips(1, 200)), two = fast::sweep_work(strips(2, 200));
  CHECK(two.sector_bytes == Approx(2 * one.sector_bytes).epsilon(0.02));
  const double again = one.sector_bytes - one.bytes;
  CHECK(again > 0.5 * one.launches * one.vertices * sizeof(float));
  CHECK(again < one.launches * one.vertices * 6 * 16.0);
}
