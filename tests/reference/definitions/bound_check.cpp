// Tests bounds_above_exact: the reference's own bounds never exceed the exact ones, and lie just below them.
#include "reference/definitions/bound_check.hpp"

#include <algorithm>
#include <cmath>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
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

std::vector<float> stepped_up(std::vector<float> bounds, int steps) {
  for (float& b : bounds) {
    for (int k = 0; k < steps; ++k) b = std::nextafter(b, std::numeric_limits<float>::infinity());
  }
  return bounds;
}

}  // namespace

TEST_CASE(
    "bound_check: Eq. 21, no bound of the reference is above the exact one; two units in the last place more, and "
    "every bound is",
    "[property]") {
  std::size_t tight = 0, asked = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const auto in = question(specimen.surface, topology, specimen.radius, 2 * specimen.radius);
    const auto bounds = bounds_of(in, 0.45f);
    CHECK(reference::bounds_above_exact(in, 0.45f, bounds).empty());
    // Distance and product are each rounded down, by less than one unit in the last place. Their last places may differ
    // by a factor of two, so three steps up exceed the exact bound.
    const bool all_above = reference::bounds_above_exact(in, 0.45f, stepped_up(bounds, 3)).size() == bounds.size();
    CHECK(all_above);
    tight += reference::bounds_above_exact(in, 0.45f, stepped_up(bounds, 1)).size();
    asked += bounds.size();
  }
  CHECK(tight > asked / 4);
}

TEST_CASE("bound_check: a bound one percent too large is found, and only that one", "[unit]") {
  std::mt19937 random(41);
  const Surface surface = folded(8, 0.4f, random, 0.3f);
  const auto topology = surface.topology();
  const auto in = question(surface, topology, 0.5f, 1);
  auto bounds = bounds_of(in, 0.45f);
  bounds[17] *= 1.01f;
  CHECK(reference::bounds_above_exact(in, 0.45f, bounds) == std::vector<Index>{17});
  bounds[17] = std::numeric_limits<float>::quiet_NaN();
  CHECK(reference::bounds_above_exact(in, 0.45f, bounds) == std::vector<Index>{17});
  bounds.pop_back();
  CHECK_THROWS_AS(reference::bounds_above_exact(in, 0.45f, bounds), compare::InputError);
}

TEST_CASE("bound_check: Eq. 27, moves within the bounds never make an intersection", "[property]") {
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
        // The factor 0.999999 covers the rounding errors of the sums.
        const double step = 0.999999 * static_cast<double>(bounds[v]) / length;
        after[v] = {after[v].x + step * x, after[v].y + step * y, after[v].z + step * z};
      }
      CHECK(compare::audit(topology, after).count == 0);
      ++moved;
    }
  }
  CHECK(moved > 400);
}
