#include "reference/solvers/colouring.hpp"

#include <algorithm>

namespace ogc::reference {

using compare::Index;

std::vector<Index> colours_of(const compare::Scene& scene, const compare::RestStateOut& rest, const std::vector<Index>& groups) {
  std::vector<std::vector<Index>> near(groups.size());
  const auto meet = [&](const auto& vertices) {
    for (const Index a : vertices)
      for (const Index b : vertices)
        if (a != b) near[static_cast<std::size_t>(a)].push_back(b);
  };
  for (const compare::RestTriangle& t : rest.triangles) meet(t.corner);
  for (const compare::RestHinge& h : rest.hinges) meet(h.vertex);
  for (const compare::Spring& s : scene.springs) {
    meet(std::array{s.first, s.second});
    if (s.third >= 0) meet(std::array{s.first, s.second, s.third});
  }
  std::vector<Index> colour(groups.size(), -1);
  for (std::size_t v = 0; v < groups.size(); ++v) {
    if (groups[v] != -1) continue;
    const auto taken = [&](Index c) { return std::any_of(near[v].begin(), near[v].end(), [&](Index w) { return colour[static_cast<std::size_t>(w)] == c; }); };
    for (colour[v] = 0; taken(colour[v]);) ++colour[v];
  }
  return colour;
}

}  // namespace ogc::reference
