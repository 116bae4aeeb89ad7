// Tests Eq. 27 with the reference's bounds.
#include <cmath>

#include "compare/oracle/audit.hpp"
#include "compare/problem/scene.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

std::vector<float> bounds_of(const compare::DetectIn& in, float relaxation) {
  const auto facets = reference::detect_vertex_facet(in).exact;
  const auto edges = reference::detect_edge_edge(in).exact;
  return reference::bound({in.topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, relaxation})
      .exact.bound;
}

}  // namespace

TEST_CASE("Eq. 27: moves within the bounds never make an intersection", "[property]") {
  std::mt19937 random(42);
  std::normal_distribution<double> normal;
  int moved = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const auto before = compare::to_double(specimen.surface.positions);
    if (specimen.collapsed || compare::audit(topology, before).count > 0) continue;
    const auto in = question(specimen.surface, topology, specimen.radius, 2 * specimen.radius);
    const auto bounds = bounds_of(in, 0.49f);
    for (int k = 0; k < 4; ++k) {
      auto after = before;
      for (std::size_t v = 0; v < after.size(); ++v) {
        const double x = normal(random), y = normal(random), z = normal(random), length = std::hypot(x, y, z);
        // The step is a millionth shorter than the bound, which is far more than the rounding error of the sums.
        const double step = 0.999999 * static_cast<double>(bounds[v]) / length;
        after[v] = {after[v].x + step * x, after[v].y + step * y, after[v].z + step * z};
      }
      CHECK(compare::audit(topology, after).count == 0);
      ++moved;
    }
  }
  CHECK(moved > 400);
}
