// Makes cases of stage block: the meshes of the detections' generators, with questions about faces near each other. In
// regular meshes nearly every point in a question lies on the boundary of a block or one rung from it.
#include <algorithm>
#include <array>
#include <limits>

#include "compare/judge/cases/block_questions.hpp"
#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

namespace {

constexpr int questions_a_mesh = 48, questions_a_field = 2000;
constexpr std::size_t neighbours = 8;

double squared_distance(const Vec3f& a, const Vec3f& b) {
  const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
  return x * x + y * y + z * z;
}

/// Checks whether two edges may be nearly parallel. The limit is 0.1 % too large, so that rounding hides no such pair.
bool might_be_parallel(const std::vector<Vec3f>& x, const Edge& e, const Edge& f) {
  const auto along = [&](const Edge& edge) {
    const Vec3f &a = x[at(edge[0])], &b = x[at(edge[1])];
    return std::array{double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
  };
  const auto squared = [](const std::array<double, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  const auto u = along(e), v = along(f);
  const double both = squared(u) * squared(v);
  return both > 0 &&
         squared({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}) < 1.001e-6 * both;
}

class Asker {
 public:
  Asker(Random& random, const Topology& topology, const std::vector<Vec3f>& positions)
      : random_(random), topology_(topology), positions_(positions) {}

  /// Draws two faces and appends a question about them. Appends nothing if they do not make one, for example if one
  /// face contains the other.
  void ask(std::vector<BlockQuestion>& questions) {
    const Index corner = random_.below(topology_.vertex_count), v = near(corner);
    const Face a = face_at(corner);
    if (random_.one_in(3))
      ask_edge(questions, edge_at(v), a);
    else if (!std::ranges::count(vertices(a), v))
      questions.push_back({BlockQuestion::Kind::vertex_in_surface, v, a});
  }

 private:
  std::vector<Index> vertices(const Face& a) const {
    if (a.kind == FaceKind::vertex) return {a.index};
    if (a.kind == FaceKind::edge) return {topology_.edges[at(a.index)].begin(), topology_.edges[at(a.index)].end()};
    return {topology_.triangles[at(a.index)].begin(), topology_.triangles[at(a.index)].end()};
  }

  /// Returns one of the nearest vertices. Fine cases get the nearest one; one of eight other cases gets any vertex.
  Index near(Index v) {
    if (!random_.is_fine() && random_.one_in(8)) return random_.below(topology_.vertex_count);
    if (random_.is_fine()) return nearest(v);
    std::vector<std::pair<double, Index>> others;
    for (Index w = 0; w < topology_.vertex_count; ++w)
      if (w != v) others.emplace_back(squared_distance(positions_[at(v)], positions_[at(w)]), w);
    if (others.empty()) return v;
    const std::size_t kept = std::min(others.size(), neighbours);
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(kept), others.end());
    return others[at(random_.below(static_cast<int>(kept)))].second;
  }

  /// Returns the nearest other vertex, the lowest-numbered one if several are equally near; v if there is no other.
  Index nearest(Index v) const {
    Index best = v;
    double least = std::numeric_limits<double>::infinity();
    for (Index w = 0; w < topology_.vertex_count; ++w) {
      const double d = w == v ? least : squared_distance(positions_[at(v)], positions_[at(w)]);
      if (d < least) best = w, least = d;
    }
    return best;
  }

  Index edge_at(Index v) {
    const auto around = topology_.vertex_edges[at(v)];
    return around.empty() ? -1 : random_.pick(around);
  }

  /// Returns the vertex itself, or an edge or a triangle that contains it.
  Face face_at(Index v) {
    const int kind = random_.below(3);
    const auto around = topology_.vertex_triangles[at(v)];
    if (kind == 2 && !around.empty()) return {FaceKind::triangle, random_.pick(around)};
    const Index e = kind == 1 ? edge_at(v) : -1;
    return e >= 0 ? Face{FaceKind::edge, e} : Face{FaceKind::vertex, v};
  }

  void ask_edge(std::vector<BlockQuestion>& questions, Index e, const Face& a) const {
    if (e < 0 || a.kind == FaceKind::triangle) return;
    const Edge& of = topology_.edges[at(e)];
    const auto shared = [&](Index v) { return v == of[0] || v == of[1]; };
    if (std::ranges::any_of(vertices(a), shared)) return;
    if (a.kind == FaceKind::edge && might_be_parallel(positions_, of, topology_.edges[at(a.index)])) return;
    questions.push_back({BlockQuestion::Kind::edge_in_edges, e, a});
  }

  Random& random_;
  const Topology& topology_;
  const std::vector<Vec3f>& positions_;
};

/// Makes the mesh of generator `family` of vertex–facet detection, and adds questions about its blocks.
template <const auto& family, int count = questions_a_mesh>
CaseData about(Random& random) {
  MeshCase mesh = case_of<MeshCase>(find_generator(Stage::detect_vertex_facet, family).make(random));
  BlockCase block{std::move(mesh.topology), std::move(mesh.positions), {}};
  block.questions = block_questions(random, *block.topology, block.positions, count);
  return block;
}

constexpr std::string_view soup = "soup", cloth = "cloth", few = "few", bits = "bits", lattice = "lattice",
                           sheets = "ladder.sheets", fold = "ladder.fold", stack = "ladder.stack", fan = "ladder.fan",
                           above = "ladder.above", book = "ladder.book", strands = "ladder.strands",
                           boundary = "ladder.boundary", field = "ladder.field";

constexpr std::array<Generator, 15> table{{{soup, 16, true, about<soup>},
                                           {cloth, 16, true, about<cloth>},
                                           {few, 2, true, about<few>},
                                           {bits, 12, false, about<bits>},
                                           {"dust", 8, false, about<soup>},
                                           {lattice, 16, false, about<lattice>},
                                           {sheets, 8, false, about<sheets>},
                                           {fold, 8, false, about<fold>},
                                           {stack, 8, false, about<stack>},
                                           {fan, 7, false, about<fan>},
                                           {above, 7, false, about<above>},
                                           {book, 6, false, about<book>},
                                           {strands, 6, false, about<strands>},
                                           {boundary, 900, false, about<boundary>},
                                           {field, 15000, false, about<field, questions_a_field>, 1000000}}};

}  // namespace

std::vector<BlockQuestion> block_questions(Random& random, const Topology& topology,
                                           const std::vector<Vec3f>& positions, int count) {
  std::vector<BlockQuestion> questions;
  if (topology.vertex_count == 0) return questions;
  Asker asker(random, topology, positions);
  for (int tries = 0; tries < 2 * count && static_cast<int>(questions.size()) < count; ++tries) asker.ask(questions);
  return questions;
}

std::span<const Generator> block_generators() { return table; }

}  // namespace ogc::compare
