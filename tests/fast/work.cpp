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
  CHECK(one.colours == 4);  // two for segments, two for vertices
  CHECK(two.flop == 2 * one.flop);
  CHECK(two.bytes == 2 * one.bytes);
  // Each further vertex adds a segment with two ends. Flop and bytes per vertex are about those of the paper's yarn.
  CHECK((longer.flop - one.flop) / 100 == Approx(54 + 2 * 51 + 336));
  CHECK((longer.bytes - one.bytes) / 100 == Approx(280).epsilon(0.1));
  CHECK(one.flop - held.flop == Approx(2 * 54 + 3 * 51 + 336));
}
