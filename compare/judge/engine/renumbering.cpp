#include "compare/judge/engine/renumbering.hpp"

#include <numeric>
#include <utility>

namespace ogc::compare {

namespace {

/// Returns a random map from old indices to new ones.
std::vector<Index> shuffled(Random& random, std::size_t count) {
  std::vector<Index> to(count);
  std::iota(to.begin(), to.end(), 0);
  for (std::size_t i = count; i > 1; --i) std::swap(to[i - 1], to[random.bits() % i]);
  return to;
}

}  // namespace

Renumbering::Renumbering(Random& random, const Topology& from)
    : vertex_(shuffled(random, static_cast<std::size_t>(from.vertex_count))),
      triangle_(shuffled(random, from.triangles.size())) {
  std::vector<Triangle> triangles(from.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto first = static_cast<std::size_t>(random.below(3));
    for (std::size_t k = 0; k < 3; ++k)
      triangles[static_cast<std::size_t>(triangle_[t])][k] = vertex(from.triangles[t][(first + k) % 3]);
  }
  std::vector<Edge> loose;
  for (std::size_t e = 0; e < from.edges.size(); ++e)
    if (from.edge_triangles[e].empty()) loose.push_back(renamed(from.edges[e]));
  auto topology = std::make_shared<Topology>(build_topology(from.vertex_count, triangles, loose));
  topology->off_surface.resize(from.off_surface.size());
  for (std::size_t v = 0; v < from.off_surface.size(); ++v)
    topology->off_surface[static_cast<std::size_t>(vertex(static_cast<Index>(v)))] = from.off_surface[v];
  topology_ = topology;
  for (const Edge& e : from.edges) edge_.push_back(find_edge(*topology_, renamed(e)[0], renamed(e)[1]));
}

}  // namespace ogc::compare
