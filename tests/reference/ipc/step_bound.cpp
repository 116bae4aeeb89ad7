// Tests the bound of a step by both rules of ipc_ccd. The rule for all pairs must take account of the active pairs and
// of all pairs that come near.
#include "reference/ipc/step_bound.hpp"

#include <algorithm>
#include <cmath>

#include "reference/ipc/intersections.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;
using compare::ContactSides;
using compare::Index;

namespace {

/// Returns a number in [−1, 1) that depends only on the case, the vertex and the axis.
double draw(int number, std::size_t vertex, std::size_t axis) {
  const double x = std::sin(12.9898 * (number + 1) + 78.233 * static_cast<double>(vertex + 1) +
                            37.719 * static_cast<double>(axis + 1)) *
                   43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

/// Returns all pairs without a common vertex, without using boxes or distances.
std::vector<PrimitivePair> every_pair(const compare::Topology& topology, std::size_t vertex_count) {
  std::vector<PrimitivePair> pairs;
  const auto vertices = static_cast<Index>(vertex_count), edges = static_cast<Index>(topology.edges.size());
  const auto add = [&](const PrimitivePair& pair) {
    auto v = vertices_of(topology, pair);
    std::sort(v.begin(), v.end());
    if (std::adjacent_find(v.begin(), v.end()) == v.end()) pairs.push_back(pair);
  };
  for (Index v = 0; v < vertices; ++v)
    for (Index t = 0; t < static_cast<Index>(topology.triangles.size()); ++t) add({ContactSides::point_triangle, v, t});
  for (Index e = 0; e < edges; ++e)
    for (Index f = e + 1; f < edges; ++f) add({ContactSides::edge_edge, e, f});
  return pairs;
}

/// Returns x + share p.
State moved(const State& x, double share, const State& p) {
  State to = x;
  for (std::size_t v = 0; v < x.size(); ++v) to[v] = x[v] + share * p[v];
  return to;
}

bool holds(const std::vector<PrimitivePair>& pairs, const std::vector<PrimitivePair>& some) {
  return std::all_of(some.begin(), some.end(), [&](const PrimitivePair& pair) {
    return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
  });
}

}  // namespace

TEST_CASE(
    "IPC: CCD of all pairs misses no active pair and none that comes within the barrier's distance on the way, and its "
    "step is never the longer one",
    "[property]") {
  compare::Scene scene;
  add_sheet(scene, 4, 0.06, 0, false);
  add_sheet(scene, 4, 0.07, 1.2e-3, false);
  round_to_single(scene);
  const compare::Topology topology = build_topology(scene);
  const compare::Exclusions groups = exclusions(scene);
  const std::vector<float> rest(topology.edges.size(), 4e-4F);
  const PairMesh mesh{topology, groups, rest};
  const BarrierShape shape{1e-3, 0};
  const std::vector<PrimitivePair> all = every_pair(topology, scene.mesh.positions.size());
  int shortened = 0, missed_by_active = 0;
  for (int number = 0; number < 60; ++number) {
    State x = widened(compare::to_single(scene.mesh.positions)), p(x.size());
    const double speed = number % 3 == 0 ? 2e-4 : number % 3 == 1 ? 2e-3 : 2e-2;
    for (std::size_t v = 0; v < x.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis)
        x[v][axis] += 4e-4 * draw(number, v, axis), p[v][axis] = speed * draw(-number - 2, v, axis);
    const std::vector<PrimitivePair> active = barriers_at(mesh, shape, near_pairs(mesh, x, x, shape.reach()), x).active;
    REQUIRE(!active.empty());
    const StepBound partial = step_bound(mesh, active, x, p, shape.thickness);
    const std::vector<PrimitivePair> near = near_pairs(mesh, x, moved(x, partial.share, p), shape.reach());
    const StepBound full = step_bound(mesh, near, x, p, shape.thickness, partial.share);
    CHECK(full.share <= partial.share);
    CHECK(holds(near, active));
    for (int sample = 1; sample <= 8; ++sample) {
      const double share = sample / 8.0 * full.share;
      const BarrierSet met = barriers_at(mesh, shape, all, moved(x, share, p));
      CHECK(met.touching.empty());
      CHECK(holds(near, met.active));
      CHECK(intersections(mesh, moved(x, share, p)).empty());
    }
    shortened += partial.share < 1;
    missed_by_active += full.share < partial.share;
  }
  CHECK(shortened > 10);
  CHECK(missed_by_active > 10);
}
