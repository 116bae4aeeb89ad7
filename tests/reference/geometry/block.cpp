// Tests stage block against the conditions as printed in Eq. 8–10, 14 and 15, with closest points in double precision.
// Tests the boundaries of blocks, too.
#include "reference/geometry/block.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "reference/geometry/blocks.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::BlockQuestion;
using compare::Face;
using compare::FaceKind;
using Kind = compare::BlockQuestion::Kind;

namespace {

struct Point {
  double x, y, z;
};
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Keeps the smallest margin of a block's conditions, which must all be ≥ 0. `inside` returns nothing if rounding in
/// double may decide the sign of this margin.
class Printed {
 public:
  void need(double margin) { least_ = std::min(least_, margin); }
  std::optional<bool> inside() const {
    if (std::abs(least_) < 1e-7) return std::nullopt;
    return least_ > 0;
  }

 private:
  double least_ = INFINITY;
};

class Mesh {
 public:
  explicit Mesh(Surface surface) : surface_(std::move(surface)), topology_(surface_.topology()) {}

  compare::BlockTruth ask(const std::vector<BlockQuestion>& questions) const {
    return reference::block({&topology_, surface_.positions, questions});
  }

  /// Returns the questions of one kind about all faces.
  std::vector<BlockQuestion> questions(Kind kind) const {
    std::vector<BlockQuestion> all;
    const auto count = kind == Kind::edge_in_edges ? topology_.edges.size()
                                                   : static_cast<std::size_t>(topology_.vertex_count);
    const std::array<std::size_t, 3> faces{static_cast<std::size_t>(topology_.vertex_count), topology_.edges.size(),
                                           topology_.triangles.size()};
    for (std::size_t of = 0; of < count; ++of)
      for (std::size_t k = 0; k < (kind == Kind::edge_in_edges ? 2u : 3u); ++k)
        for (std::size_t i = 0; i < faces[k]; ++i) {
          const BlockQuestion question{kind, static_cast<Index>(of), {static_cast<FaceKind>(k), static_cast<Index>(i)}};
          if (apart(question)) all.push_back(question);
        }
    return all;
  }

  std::optional<bool> printed(const BlockQuestion& question) const {
    const auto x = question.kind == Kind::vertex_in_surface ? at(question.of)
                                                            : closest_point(question.of, question.face);
    Printed conditions;
    if (question.face.kind == FaceKind::vertex) {
      const Point v = at(question.face.index);
      for (const Index w : topology_.vertex_neighbours[static_cast<std::size_t>(question.face.index)])
        conditions.need(dot(x - v, v - at(w)));
    } else if (question.face.kind == FaceKind::edge) {
      between(x, question.face.index, conditions);
      if (question.kind == Kind::vertex_in_surface) beside(x, question.face.index, conditions);
    } else {
      within(x, question.face.index, conditions);
    }
    return conditions.inside();
  }

 private:
  Point at(Index v) const {
    const Vec3f& p = surface_.positions[static_cast<std::size_t>(v)];
    return {p.x, p.y, p.z};
  }
  std::array<Point, 2> ends(Index e) const {
    const auto& [a, b] = topology_.edges[static_cast<std::size_t>(e)];
    return {at(a), at(b)};
  }

  bool apart(const BlockQuestion& question) const {
    const reference::Complex mesh{topology_, surface_.positions};
    const auto mine = question.kind == Kind::edge_in_edges ? mesh.vertices({FaceKind::edge, question.of})
                                                           : mesh.vertices({FaceKind::vertex, question.of});
    const auto others = mesh.vertices(question.face);
    return std::none_of(mine.span().begin(), mine.span().end(), [&](Index v) {
      return std::find(others.span().begin(), others.span().end(), v) != others.span().end();
    });
  }

  static Point nearest(const std::array<Point, 2>& e, const Point& x) {
    const Point along = e[1] - e[0];
    return e[0] + std::clamp(dot(x - e[0], along) / dot(along, along), 0.0, 1.0) * along;
  }

  /// Returns the closest point of an edge by alternating projections, which converge to the closest points of convex
  /// sets.
  Point closest_point(Index e, Face a) const {
    if (a.kind == FaceKind::vertex) return nearest(ends(e), at(a.index));
    Point x = ends(e)[0];
    for (int k = 0; k < 20000; ++k) {
      const Point next = nearest(ends(e), nearest(ends(a.index), x));
      const double step = dot(next - x, next - x);
      x = next;
      if (step == 0) break;
    }
    return x;
  }

  void between(const Point& x, Index e, Printed& conditions) const {
    const auto [a, b] = ends(e);
    conditions.need(dot(x - a, b - a));
    conditions.need(dot(x - b, a - b));
  }

  /// Adds Eq. 9: (x − p)·(p − w) ≥ 0, where p is the foot of w on the line of the edge.
  void beside(const Point& x, Index e, Printed& conditions) const {
    const auto [a, b] = ends(e);
    const Point along = b - a;
    for (const Index v : topology_.edge_opposite[static_cast<std::size_t>(e)]) {
      const Point w = at(v), p = a + (dot(w - a, along) / dot(along, along)) * along;
      conditions.need(dot(x - p, p - w));
    }
  }

  /// Adds the conditions of Eq. 10 on the barycentric coordinates of x's foot.
  void within(const Point& x, Index t, Printed& conditions) const {
    const auto& [i, j, k] = topology_.triangles[static_cast<std::size_t>(t)];
    const Point a = at(i), u = at(j) - a, v = at(k) - a, p = x - a;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
    const double s = (vv * dot(p, u) - uv * dot(p, v)) / det, r = (uu * dot(p, v) - uv * dot(p, u)) / det;
    conditions.need(s);
    conditions.need(r);
    conditions.need(1 - s - r);
  }

  Surface surface_;
  compare::Topology topology_;
};

struct Counts {
  int inside = 0, outside = 0, wrong = 0;
};

void compare_all(const Mesh& mesh, Kind kind, Counts& counts) {
  const std::vector<BlockQuestion> questions = mesh.questions(kind);
  const compare::BlockTruth truth = mesh.ask(questions);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const auto printed = mesh.printed(questions[i]);
    if (!printed) continue;
    ++(*printed ? counts.inside : counts.outside);
    counts.wrong += *printed != (truth.inside[i] != 0);
  }
}

/// Compares answers on random triangle soups and on folded sheets.
Counts compare_on_random_meshes(Kind kind) {
  std::mt19937 random(11);
  Counts counts;
  for (int k = 0; k < 3; ++k) {
    compare_all(Mesh(soup(9, 10, random)), kind, counts);
    compare_all(Mesh(folded(5, 0.3f, random, 0.2f)), kind, counts);
  }
  return counts;
}

/// Returns a flat patch of four triangles about vertex 0, and an edge from vertex 5 to vertex 6 above it.
Surface patch(const Vec3f& from, const Vec3f& to) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, from, to},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}},
          {{5, 6}},
          {}};
}

}  // namespace

TEST_CASE("block: a vertex lies in the blocks of a surface where Eq. 8, 9 and 10 say so", "[property]") {
  const Counts counts = compare_on_random_meshes(Kind::vertex_in_surface);
  CHECK(counts.inside > 100);
  CHECK(counts.outside > 1000);
  CHECK(counts.wrong == 0);
}

TEST_CASE("block: an edge's closest point lies in the blocks of the edges where Eq. 14 and 15 say so", "[property]") {
  const Counts counts = compare_on_random_meshes(Kind::edge_in_edges);
  CHECK(counts.inside > 100);
  CHECK(counts.outside > 1000);
  CHECK(counts.wrong == 0);
}

TEST_CASE(
    "block: straight above a vertex is in the vertex's closed block and in no open one; no relative change of the "
    "input turns that",
    "[unit]") {
  const Surface surface = patch({0, 0, 1}, {3, 4, 5});
  const compare::Topology topology = surface.topology();
  std::vector<BlockQuestion> questions{{Kind::vertex_in_surface, 5, {FaceKind::vertex, 0}}};
  for (const Index e : topology.vertex_edges[0]) questions.push_back({Kind::vertex_in_surface, 5, {FaceKind::edge, e}});
  for (Index t = 0; t < 4; ++t) questions.push_back({Kind::vertex_in_surface, 5, {FaceKind::triangle, t}});
  const compare::BlockTruth truth = Mesh(surface).ask(questions);
  CHECK(truth.inside[0] == 1);
  CHECK(std::count(truth.inside.begin(), truth.inside.end(), 1) == 1);
  CHECK(truth.grey[0] == 0);
}

TEST_CASE("block: a boundary is grey within rounding of it, and decided exactly", "[unit]") {
  // The edge from vertex 0 to vertex 1 is slanted. For x = 2 + δ, the margin of vertex 2 at the edge's end plane
  // through vertex 0 is (1 + δ) − 1, so the terms cancel.
  const auto about = [](float x) {
    const Surface surface{{{1, 1, 0}, {2, 2, 0}, {x, 0, 5}, {9, 9, 9}, {9, 8, 9}}, {}, {{0, 1}, {2, 3}, {3, 4}}, {}};
    return Mesh(surface).ask({{Kind::vertex_in_surface, 2, {FaceKind::vertex, 0}}});
  };
  CHECK(about(2).inside[0] == 1);
  CHECK(about(2).grey[0] == 1);
  CHECK(about(std::nextafter(2.0f, 3.0f)).inside[0] == 0);
  CHECK(about(std::nextafter(2.0f, 3.0f)).grey[0] == 1);
  CHECK(about(2.001f).inside[0] == 0);
  CHECK(about(2.001f).grey[0] == 0);
  CHECK(about(1.999f).inside[0] == 1);
  CHECK(about(1.999f).grey[0] == 0);
}

TEST_CASE("block: the point of an edge is that inside it or its nearer end", "[unit]") {
  // The point of edge 5–6 that is closest to vertex 0 lies, in the order of the four checks:
  //  - above vertex 0
  //  - above vertex 0, at an end of the edge
  //  - not above vertex 0, at an end of the edge
  //  - not above vertex 0, because the edge is slanted
  const auto inside = [](const Vec3f& from, const Vec3f& to, Face a) {
    return Mesh(patch(from, to)).ask({{Kind::edge_in_edges, 8, a}}).inside[0];
  };
  REQUIRE(patch({}, {1, 0, 1}).topology().edges[8] == compare::Edge{5, 6});
  const Face vertex{FaceKind::vertex, 0};
  CHECK(inside({-1, 0, 1}, {1, 0, 1}, vertex) == 1);
  CHECK(inside({0, 0, 1}, {1, 0, 1}, vertex) == 1);
  CHECK(inside({0.25f, 0, 1}, {1, 0, 1}, vertex) == 0);
  CHECK(inside({-1, 0, 0.5f}, {1, 0, 1}, vertex) == 0);
  // The point of edge 0 (from vertex 0 to vertex 1) that is closest to edge 5–6 is the middle of edge 0 in two cases,
  // and vertex 0 in the others.
  CHECK(inside({0.5f, -1, 1}, {0.5f, 1, 1}, {FaceKind::edge, 0}) == 1);
  CHECK(inside({0.5f, 1, 1}, {0.5f, 2, 1}, {FaceKind::edge, 0}) == 1);
  CHECK(inside({-0.5f, -1, 1}, {-0.5f, 1, 1}, {FaceKind::edge, 0}) == 0);
  CHECK(inside({0, -1, 1}, {0, 1, 1}, {FaceKind::edge, 0}) == 0);
}
