// Compares bounds with Eq. 21, 23 and 25, which are computed by the definitions over all pairs and rounded down.
#include "reference/geometry/bound.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("bound: γ_p times the smallest distance of the vertex, its edges and its triangles, rounded down",
          "[property]") {
  std::mt19937 random(7);
  Surface surface = soup(20, 25, random);
  surface.loose_edges = {{0, 1}, {2, 3}};
  const auto topology = surface.topology();
  std::uniform_real_distribution<float> distance(0.1f, 1);
  const auto draw = [&](std::size_t n) {
    std::vector<float> values(n);
    std::generate(values.begin(), values.end(), [&] { return distance(random); });
    return values;
  };
  const auto of_vertex = draw(20), of_edge = draw(topology.edges.size()), of_triangle = draw(topology.triangles.size());
  const float gamma = 0.45f;
  const auto bound = reference::bound({&topology, of_vertex, of_edge, of_triangle, gamma}).exact.bound;
  REQUIRE(bound.size() == 20);
  for (Index v = 0; v < 20; ++v) {
    float smallest = of_vertex[static_cast<std::size_t>(v)];
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      if (topology.edges[e][0] == v || topology.edges[e][1] == v) smallest = std::min(smallest, of_edge[e]);
    }
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      const auto& corners = topology.triangles[t];
      if (std::find(corners.begin(), corners.end(), v) != corners.end()) smallest = std::min(smallest, of_triangle[t]);
    }
    const float b = bound[static_cast<std::size_t>(v)];
    const double exact = static_cast<double>(gamma) * smallest;
    CHECK(static_cast<double>(b) <= exact);
    CHECK(static_cast<double>(std::nextafter(b, 9.0f)) > exact);
  }
}
