#include "reference/solvers/colouring.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {

using compare::Index;

namespace {

Index root(std::vector<Index>& parent, Index v) {
  while (parent[static_cast<std::size_t>(v)] != v) {
    Index& up = parent[static_cast<std::size_t>(v)];
    v = up = parent[static_cast<std::size_t>(up)];
  }
  return v;
}

/// Returns for each vertex the lowest vertex index of its component. Two vertices are in one component if stencils
/// connect them.
std::vector<Index> components(const std::vector<std::vector<Index>>& near) {
  std::vector<Index> parent(near.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  for (std::size_t v = 0; v < near.size(); ++v)
    for (const Index w : near[v]) {
      const auto [low, high] = std::minmax({root(parent, static_cast<Index>(v)), root(parent, w)});
      parent[static_cast<std::size_t>(high)] = low;
    }
  for (std::size_t v = 0; v < near.size(); ++v) parent[v] = root(parent, static_cast<Index>(v));
  return parent;
}

/// Replaces each colour c by (c + k) mod n in the k-th component. Without this, facing vertices of identical cloths
/// would have the same colour (method.md §7.3).
void rotate(const std::vector<Index>& component, std::vector<Index>& colour) {
  const Index count = 1 + *std::ranges::max_element(colour);
  std::map<Index, Index> number;
  for (std::size_t v = 0; v < colour.size(); ++v) {
    if (colour[v] < 0) continue;
    const Index turn = number.try_emplace(component[v], static_cast<Index>(number.size())).first->second;
    colour[v] = (colour[v] + turn) % count;
  }
}

std::vector<Index> free_vertices(const std::vector<Index>& groups) {
  std::vector<Index> free;
  for (std::size_t v = 0; v < groups.size(); ++v)
    if (groups[v] == -1) free.push_back(static_cast<Index>(v));
  return free;
}

/// Shuffles the order with the seed. std::shuffle is not used, because its result differs between standard libraries.
void shuffle(std::vector<Index>& order, std::int64_t seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  for (std::size_t n = order.size(); n > 1; --n) std::swap(order[n - 1], order[random() % n]);
}

/// Returns for each free vertex the free vertices that share an element with it.
std::vector<std::vector<Index>> neighbours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                                              const std::vector<Index>& groups) {
  std::vector<std::vector<Index>> near(groups.size());
  const auto is_free = [&](Index v) { return v >= 0 && groups[static_cast<std::size_t>(v)] == -1; };
  const auto meet = [&](const auto& vertices) {
    for (const Index a : vertices)
      for (const Index b : vertices)
        if (a != b && is_free(a) && is_free(b)) near[static_cast<std::size_t>(a)].push_back(b);
  };
  for_each_kind([&]<class Kind, std::size_t>() {
    for (const auto& element : Kind::elements(scene, rest)) meet(Kind::vertices(element));
  });
  return near;
}

/// Gives each vertex in this order the lowest colour that no neighbour has.
std::vector<Index> greedy(const std::vector<Index>& order, const std::vector<std::vector<Index>>& near) {
  std::vector<Index> colour(near.size(), -1);
  for (const Index own : order) {
    const auto v = static_cast<std::size_t>(own);
    const auto taken = [&](Index c) {
      return std::any_of(near[v].begin(), near[v].end(),
                         [&](Index w) { return colour[static_cast<std::size_t>(w)] == c; });
    };
    for (colour[v] = 0; taken(colour[v]);) ++colour[v];
  }
  return colour;
}

}  // namespace

std::vector<Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest,
                              const std::vector<Index>& groups, Colouring rule) {
  std::vector<Index> order = free_vertices(groups), colour(groups.size(), -1);
  const std::vector<std::vector<Index>> near = neighbours_of(scene, rest, groups);
  switch (rule) {
    case Colouring::turned:
      colour = greedy(order, near);
      if (!colour.empty()) rotate(components(near), colour);
      return colour;
    case Colouring::greedy: return greedy(order, near);
    case Colouring::random: shuffle(order, scene.settings.seed); return greedy(order, near);
    case Colouring::vertex:
      for (std::size_t k = 0; k < order.size(); ++k) colour[static_cast<std::size_t>(order[k])] = static_cast<Index>(k);
      return colour;
    case Colouring::together:
      for (const Index v : order) colour[static_cast<std::size_t>(v)] = 0;
      return colour;
  }
  return colour;
}

}  // namespace ogc::reference
