// Tests which pairs a detection skips if only the exact answer is needed (DetectionExtent::exact).
#include "reference/geometry/separation.hpp"

#include <random>

#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/geometry/primitive_distances.hpp"
#include "reference/solvers/detection.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns two wavy sheets `gap` apart, scattered by `noise` [m], above a fixed sheet.
compare::Scene waves(double gap, double noise) {
  compare::Scene scene;
  scene.name = "waves";
  add_sheet(scene, 12, 0.1, 0, false);
  add_sheet(scene, 9, 0.1, gap, false);
  add_sheet(scene, 3, 0.3, -0.02, true);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> scatter(-noise, noise);
  for (compare::Vec3& p : scene.mesh.positions) {
    p.y += 0.006 * std::sin(90 * p.x) + scatter(engine);
    p.x += scatter(engine);
    p.z += scatter(engine);
  }
  return scene;
}

}  // namespace

TEST_CASE("a slab shows that primitives are apart, up to about their distance, and never farther", "[property]") {
  // The point (0.25, 0.25, 5) lies above a triangle in z = 0; the two edges cross 2 apart.
  const std::array<Vec3f, 4> point{Vec3f{0.25f, 0.25f, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      edges{Vec3f{-1, 0, 0}, {1, 0, 0}, {0, -1, 2}, {0, 3, 2}};
  CHECK(reference::surely_beyond_triangle(point, 4.9));
  CHECK_FALSE(reference::surely_beyond_triangle(point, 5));
  CHECK(reference::surely_beyond_edge(edges, 1.9));
  CHECK_FALSE(reference::surely_beyond_edge(edges, 2));
  const std::array<Vec3f, 4> touching{Vec3f{0, 0, 0}, {1, 0, 0}, {0.5f, -1, 0}, {0.5f, 1, 0}},
      collapsed{Vec3f{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  for (const double distance : {0.0, 1e-30}) {
    CHECK_FALSE(reference::surely_beyond_edge(touching, distance));
    CHECK_FALSE(reference::surely_beyond_edge(collapsed, distance));
    CHECK_FALSE(reference::surely_beyond_triangle(collapsed, distance));
  }
}

TEST_CASE("exact detections and distances alone answer as the judged detections do, on every mesh of the zoo",
          "[property]") {
  for (const Specimen& specimen : mesh_zoo()) {
    const compare::Topology topology = specimen.surface.topology();
    for (const float reach : {1.0f, 2.5f}) {
      INFO(specimen.name << ' ' << reach);
      const compare::DetectIn in = question(specimen.surface, topology, specimen.radius, reach * specimen.radius);
      const compare::DetectVertexFacetOut facets = reference::exact_vertex_facet(in),
                                          judged_facets = reference::detect_vertex_facet(in).exact;
      const compare::DetectEdgeEdgeOut edges = reference::exact_edge_edge(in),
                                       judged_edges = reference::detect_edge_edge(in).exact;
      CHECK((facets.contacts == judged_facets.contacts && edges.contacts == judged_edges.contacts));
      CHECK(
          (facets.d_min_vertex == judged_facets.d_min_vertex && facets.d_min_triangle == judged_facets.d_min_triangle));
      CHECK(edges.d_min_edge == judged_edges.d_min_edge);
      const reference::PrimitiveDistances alone = reference::primitive_distances(in);
      CHECK((alone.vertex == judged_facets.d_min_vertex && alone.triangle == judged_facets.d_min_triangle));
      CHECK(alone.edge == judged_edges.d_min_edge);
    }
  }
}

TEST_CASE("a sufficient query radius gives the contacts and the bounds of a larger one", "[property]") {
  for (const double gap : {3e-3, 8e-3})
    for (const double noise : {0.0, 3e-4}) {
      compare::Scene scene = waves(gap, noise);
      round_to_single(scene);
      const compare::Topology topology = build_topology(scene);
      const std::vector<compare::Index> groups = rigid_groups(scene);
      const auto r = static_cast<float>(scene.settings.contact_radius), most = 8 * r;
      std::vector<std::size_t> movable;
      for (std::size_t v = 0; v < 12 * 12 + 9 * 9; ++v) movable.push_back(v);
      const std::vector<compare::Vec3f> positions = compare::to_single(scene.mesh.positions);
      const float sufficient = reference::sufficient_query_radius(topology, groups, movable, positions, r, most);
      CHECK(sufficient >= r);
      CHECK(sufficient < 0.5f * most);
      const reference::Detected here = reference::detect(scene, topology, groups, positions, sufficient);
      const reference::Detected all = reference::detect(scene, topology, groups, positions, most);
      CHECK(here.sets.edge_edge.empty() == (gap > 5e-3));
      CHECK((here.sets.vertex_facet == all.sets.vertex_facet && here.sets.edge_edge == all.sets.edge_edge));
      for (const std::size_t v : movable) CHECK(here.bound[v] == all.bound[v]);
    }
}
