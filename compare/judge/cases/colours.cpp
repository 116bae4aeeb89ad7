#include "compare/judge/cases/colours.hpp"

#include <set>

#include "compare/problem/rods.hpp"

namespace ogc::compare {

namespace {

/// Returns, for each vertex, those that share a stencil with it by the topology, the tetrahedra and the springs.
std::vector<std::set<Index>> conflicts(const Scene& scene, const Topology& topology) {
  std::vector<std::set<Index>> near(static_cast<std::size_t>(topology.vertex_count));
  const auto join = [&](Index a, Index b) {
    near[static_cast<std::size_t>(a)].insert(b);
    near[static_cast<std::size_t>(b)].insert(a);
  };
  for (const Edge& e : topology.edges) join(e[0], e[1]);
  for (const Hinge& hinge : topology.hinges) join(hinge.opposite[0], hinge.opposite[1]);
  for (const Tetrahedron& t : scene.mesh.tetrahedra)
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t l = 0; l < k; ++l) join(t[k], t[l]);
  for (const Spring& spring : scene.springs) {
    join(spring.first, spring.second);
    if (spring.third < 0) continue;
    join(spring.first, spring.third);
    join(spring.second, spring.third);
  }
  return near;
}

}  // namespace

std::vector<Index> random_segment_colours(Random& random, const Scene& scene) {
  const std::vector<Index> numbers = rod_segments(scene), held = segment_groups(scene, numbers);
  std::vector<std::vector<std::size_t>> at(scene.mesh.positions.size());
  for (std::size_t e = 0; e < numbers.size(); ++e)
    for (const Index v : scene.mesh.loose_edges[static_cast<std::size_t>(numbers[e])])
      at[static_cast<std::size_t>(v)].push_back(e);
  std::vector<std::set<std::size_t>> near(numbers.size());
  for (const auto& here : at)
    if (here.size() == 2) near[here[0]].insert(here[1]), near[here[1]].insert(here[0]);
  std::vector<Index> colour(numbers.size(), -1);
  const bool chain = random.one_in(8), backwards = random.one_in(2);
  Index next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t e = backwards ? numbers.size() - 1 - i : i;
    if (held[e] >= 0) continue;
    std::set<Index> taken;
    for (const std::size_t f : near[e]) taken.insert(colour[f]);
    Index c = chain ? next++ : 0;
    while (taken.contains(c)) ++c;
    colour[e] = c;
  }
  return colour;
}

std::vector<Index> random_colours(Random& random, const Scene& scene, const Topology& topology) {
  const auto near = conflicts(scene, topology);
  const std::vector<Index> groups = rigid_groups(scene);
  std::vector<Index> order(near.size()), colour(near.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  const bool chain = random.one_in(8);
  Index next = 0;
  for (const Index v : order) {
    const auto i = static_cast<std::size_t>(v);
    if (groups[i] >= 0) continue;
    std::set<Index> taken;
    for (const Index u : near[i]) taken.insert(colour[static_cast<std::size_t>(u)]);
    Index c = chain ? next++ : 0;
    while (taken.contains(c)) ++c;
    colour[i] = c;
  }
  return colour;
}

}  // namespace ogc::compare
