#include "fast/stages/surface.hpp"

#include <algorithm>
#include <set>

#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

Seeds seeds_of(const compare::Topology& topology) {
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) facets.push_back(facet_of(topology, t));
  const std::vector<int> groups(static_cast<std::size_t>(topology.vertex_count), -1);
  return find_seeds(topology, groups, nullptr, facets);
}

}  // namespace

// A seed is a neighbour in the mesh whose distance limits a search from its beginning. A seed that is not near gives a
// larger limit, which only costs time.
TEST_CASE("searches begin at the nearest pairs of the mesh, opposite to edge, facet and vertex", "[property]") {
  for (const bool reversed : {false, true}) {
    tests::TestMesh mesh = tests::sheet(6, 1, 0);
    const auto last = static_cast<compare::Index>(mesh.positions.size()) - 1;
    if (reversed) {
      std::reverse(mesh.positions.begin(), mesh.positions.end());
      for (compare::Triangle& t : mesh.triangles) t = {last - t[0], last - t[2], last - t[1]};
    }
    const compare::Topology topology = mesh.topology();
    const Seeds seeds = seeds_of(topology);
    const auto set = [](const auto& items) { return std::set<int>(std::begin(items), std::end(items)); };
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const std::set<int> found = set(seeds.edges[e].vertex), ends = set(topology.edges[e]);
      std::set<int> opposite;
      for (const int v : topology.edge_opposite[e]) {
        std::set<int> neighbours = set(topology.vertex_neighbours[static_cast<std::size_t>(v)]);
        for (const int end : ends) neighbours.erase(end);
        if (!neighbours.empty()) opposite.insert(v);  // v forms an edge that does not touch e
      }
      REQUIRE(found.size() == 2);
      REQUIRE(*found.begin() >= 0);
      REQUIRE(std::includes(found.begin(), found.end(), opposite.begin(), opposite.end()));
    }
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::set<int> opposite = set(topology.edge_opposite[static_cast<std::size_t>(topology.triangle_edges[t][k])]);
        for (const int corner : topology.triangles[t]) opposite.erase(corner);
        REQUIRE(seeds.facets[t].vertex[k] == (opposite.empty() ? -1 : *opposite.begin()));
      }
    }
    for (std::size_t v = 0; v < seeds.vertices.size(); ++v) {
      std::set<int> opposite;  // edges of triangles at v that have another triangle
      for (const int t : topology.vertex_triangles[v]) {
        for (const int e : topology.triangle_edges[static_cast<std::size_t>(t)]) {
          const compare::Edge& ends = topology.edges[static_cast<std::size_t>(e)];
          const bool has_v = ends[0] == static_cast<int>(v) || ends[1] == static_cast<int>(v);
          if (!has_v && topology.edge_triangles[static_cast<std::size_t>(e)].size() == 2) opposite.insert(e);
        }
      }
      std::set<int> found = set(seeds.vertices[v].edge);
      found.erase(-1);
      REQUIRE(found.size() == std::min<std::size_t>(2, opposite.size()));
      REQUIRE(std::includes(opposite.begin(), opposite.end(), found.begin(), found.end()));
    }
  }
}
