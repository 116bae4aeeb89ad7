#include "compare/judge/renumbered.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "compare/judge/questions.hpp"
#include "compare/judge/random.hpp"

namespace ogc::compare {

namespace {

/// Old numbers to new ones.
std::vector<Index> shuffled(Random& random, std::size_t count) {
  std::vector<Index> to(count);
  std::iota(to.begin(), to.end(), 0);
  for (std::size_t i = count; i > 1; --i) std::swap(to[i - 1], to[random.bits() % i]);
  return to;
}

class Renumbering {
 public:
  Renumbering(Random& random, const Topology& from)
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
    topology_ = std::make_shared<Topology>(build_topology(from.vertex_count, triangles, loose));
    for (const Edge& e : from.edges) edge_.push_back(find_edge(*topology_, renamed(e)[0], renamed(e)[1]));
  }

  const std::shared_ptr<const Topology>& topology() const { return topology_; }
  /// One entry for each vertex, edge or triangle, in the new order.
  template <class T>
  std::vector<T> by_vertex(const std::vector<T>& old) const {
    return renumbered(old, vertex_);
  }
  template <class T>
  std::vector<T> by_edge(const std::vector<T>& old) const {
    return renumbered(old, edge_);
  }
  template <class T>
  std::vector<T> by_triangle(const std::vector<T>& old) const {
    return renumbered(old, triangle_);
  }
  Index vertex(Index v) const { return vertex_[static_cast<std::size_t>(v)]; }
  Face face(const Face& f) const {
    const std::vector<Index>& to = f.kind == FaceKind::vertex ? vertex_ : f.kind == FaceKind::edge ? edge_ : triangle_;
    return {f.kind, to[static_cast<std::size_t>(f.index)]};
  }

 private:
  Edge renamed(const Edge& e) const {
    return {std::min(vertex(e[0]), vertex(e[1])), std::max(vertex(e[0]), vertex(e[1]))};
  }
  template <class T>
  static std::vector<T> renumbered(const std::vector<T>& old, const std::vector<Index>& to) {
    std::vector<T> all(old.size());
    for (std::size_t i = 0; i < old.size() && i < to.size(); ++i) all[static_cast<std::size_t>(to[i])] = old[i];
    return all;
  }

  std::vector<Index> vertex_, triangle_, edge_;
  std::shared_ptr<const Topology> topology_;
};

TestCase renumbered(const TestCase& test, const Renumbering& to) {
  TestCase other = test;
  if (auto* mesh = std::get_if<MeshCase>(&other.data)) {
    mesh->topology = to.topology();
    mesh->rigid_groups = to.by_vertex(mesh->rigid_groups);
    mesh->positions = to.by_vertex(mesh->positions);
    auto pairs = pairs_of(mesh->partners);
    for (auto& [a, b] : pairs) a = to.vertex(a), b = to.vertex(b);
    mesh->partners = partner_rows(mesh->positions.size(), pairs);
  } else {
    auto& bound = std::get<BoundCase>(other.data);
    bound.topology = to.topology();
    bound.d_min_vertex = to.by_vertex(bound.d_min_vertex);
    bound.d_min_edge = to.by_edge(bound.d_min_edge);
    bound.d_min_triangle = to.by_triangle(bound.d_min_triangle);
  }
  return other;
}

bool is_same(const DetectVertexFacetOut& a, const DetectVertexFacetOut& b, const Renumbering& to) {
  std::set<std::pair<Index, Face>> expected, found;
  for (const VertexFacetContact& c : a.contacts) expected.insert({to.vertex(c.vertex), to.face(c.face)});
  for (const VertexFacetContact& c : b.contacts) found.insert({c.vertex, c.face});
  return expected == found;
}

bool is_same(const DetectEdgeEdgeOut& a, const DetectEdgeEdgeOut& b, const Renumbering& to) {
  std::set<std::pair<Face, Face>> expected, found;
  for (const EdgeEdgeContact& c : a.contacts) expected.insert(std::minmax(to.face(c.first), to.face(c.second)));
  for (const EdgeEdgeContact& c : b.contacts) found.insert({c.first, c.second});
  return expected == found;
}

bool is_same(Stage stage, const TestCase& a, const TestCase& b, const Renumbering& to, const Contestant& contestant) {
  const auto by = [&](const auto& detect) {
    return is_same(detect(detect_question(a)), detect(detect_question(b)), to);
  };
  if (stage == Stage::detect_vertex_facet) return by(contestant.detect_vertex_facet);
  if (stage == Stage::detect_edge_edge) return by(contestant.detect_edge_edge);
  return to.by_vertex(contestant.bound(bound_question(a)).bound) == contestant.bound(bound_question(b)).bound;
}

}  // namespace

bool is_free_of_order(Stage stage) {
  return stage == Stage::detect_vertex_facet || stage == Stage::detect_edge_edge || stage == Stage::bound;
}

std::vector<bool> same_when_renumbered(Stage stage, std::span<const TestCase> cases, const Contestant& contestant) {
  std::vector<bool> same;
  for (const TestCase& test : cases) {
    Random random("determinism", "renumbered", test.name.seed, test.name.index);
    const auto* mesh = std::get_if<MeshCase>(&test.data);
    const Renumbering to(random, mesh ? *mesh->topology : *std::get<BoundCase>(test.data).topology);
    same.push_back(is_same(stage, test, renumbered(test, to), to, contestant));
  }
  return same;
}

}  // namespace ogc::compare
