#include "compare/judge/cases/colours.hpp"

#include <algorithm>
#include <numeric>

#include "compare/problem/rods.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

namespace {

/// Gives each free item, in this order, the least colour that none of its neighbours has. With `chain`, each item gets
/// a colour of its own.
std::vector<Index> greedy(const std::vector<Index>& order, const std::vector<Index>& groups, const Neighbours& near,
                          bool chain) {
  std::vector<Index> colour(groups.size(), -1);
  Index next = 0;
  for (const Index own : order) {
    const auto i = static_cast<std::size_t>(own);
    if (groups[i] >= 0) continue;
    std::set<Index> taken;
    for (const Index other : near[i]) taken.insert(colour[static_cast<std::size_t>(other)]);
    Index c = chain ? next++ : 0;
    while (taken.contains(c)) ++c;
    colour[i] = c;
  }
  return colour;
}

std::vector<Index> numbers_below(std::size_t count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

Neighbours element_neighbours(const Scene& scene, const Topology& topology) {
  Neighbours near(static_cast<std::size_t>(topology.vertex_count));
  const auto join = [&](const auto& vertices) {
    for (const Index a : vertices)
      for (const Index b : vertices)
        if (a >= 0 && b >= 0 && a != b) near[static_cast<std::size_t>(a)].insert(b);
  };
  for_each_of<ElementKinds>([&]<class Kind, std::size_t>() { Kind::each_possible(scene, topology, join); });
  return near;
}

Neighbours segment_neighbours(const Scene& scene) {
  const std::vector<Index> numbers = rod_segments(scene);
  std::vector<std::vector<Index>> at(scene.mesh.positions.size());
  for (std::size_t e = 0; e < numbers.size(); ++e)
    for (const Index v : scene.mesh.loose_edges[static_cast<std::size_t>(numbers[e])])
      at[static_cast<std::size_t>(v)].push_back(static_cast<Index>(e));
  Neighbours near(numbers.size());
  for (const auto& here : at)
    for (std::size_t k = 0; k < 2 && here.size() == 2; ++k) near[static_cast<std::size_t>(here[k])].insert(here[1 - k]);
  return near;
}

std::vector<Index> random_segment_colours(Random& random, const Scene& scene) {
  const std::vector<Index> held = segment_groups(scene, rod_segments(scene));
  const bool chain = random.one_in(8), backwards = random.one_in(2);
  std::vector<Index> order = numbers_below(held.size());
  if (backwards) std::ranges::reverse(order);
  return greedy(order, held, segment_neighbours(scene), chain);
}

std::vector<Index> random_colours(Random& random, const Scene& scene, const Topology& topology) {
  std::vector<Index> order = numbers_below(static_cast<std::size_t>(topology.vertex_count));
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return greedy(order, rigid_groups(scene), element_neighbours(scene, topology), random.one_in(8));
}

}  // namespace ogc::compare
