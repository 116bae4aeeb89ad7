// Checks the audit of primitives with common vertices, which intersect if they meet outside of the face that the common
// vertices span. Two triangles that share an edge or a vertex, a triangle and a loose edge, and two loose edges are
// compared with brute force in rational numbers, in all orders.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>

#include "compare/oracle/audit.hpp"
#include "tests/catch.hpp"
#include "tests/compare/oracle/rational_intersection.hpp"
#include "tests/seeds.hpp"

using namespace ogc::compare;
using ogc::tests::Rational;
using ogc::tests::Row;

namespace {

using Simplex = std::vector<Index>;

/// Solves the linear equations `rows` for the unknowns in the bit set `set`; the other unknowns are 0. Returns the
/// solution if it is unique and non-negative, else an empty list. The last number of a row is the right-hand side of
/// its equation.
std::vector<Rational> basic_solution(const std::vector<Row>& rows, std::size_t columns, unsigned set) {
  std::vector<Row> chosen(rows.size());
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < columns; ++i)
    if ((set >> i & 1) != 0) place.push_back(i);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const std::size_t i : place) chosen[k].push_back(rows[k][i]);
    chosen[k].push_back(rows[k].back());
  }
  const std::size_t unknowns = place.size();
  for (std::size_t pivot = 0; pivot < unknowns; ++pivot) {
    std::size_t row = pivot;
    while (row < chosen.size() && chosen[row][pivot] == 0) ++row;
    if (row == chosen.size()) return {};
    std::swap(chosen[row], chosen[pivot]);
    for (std::size_t other = 0; other < chosen.size(); ++other) {
      if (other == pivot || chosen[other][pivot] == 0) continue;
      const Rational factor = chosen[other][pivot] / chosen[pivot][pivot];
      for (std::size_t k = pivot; k <= unknowns; ++k) chosen[other][k] -= factor * chosen[pivot][k];
    }
  }
  std::vector<Rational> solution(columns, 0);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Rational& right = chosen[i][unknowns];
    if (i >= unknowns && right != 0) return {};
    if (i >= unknowns) continue;
    const Rational value = right / chosen[i][i];
    if (value < 0) return {};
    solution[place[i]] = value;
  }
  return solution;
}

/// Returns whether two proper simplices share a point outside of the hull of their common vertices. At such a point, a
/// vertex that only `first` has gets a positive weight. If any solution has this property, a basic solution has it, so
/// only basic solutions are tried.
bool meet_beyond(const Simplex& first, const Simplex& second, const std::vector<Vec3>& x) {
  std::vector<Row> rows(5);
  const std::size_t columns = first.size() + second.size();
  for (std::size_t i = 0; i < columns; ++i) {
    const bool is_first = i < first.size();
    const Vec3& p = x[static_cast<std::size_t>(is_first ? first[i] : second[i - first.size()])];
    const int sign = is_first ? 1 : -1;
    const std::array<Rational, 5> column{is_first ? 1 : 0, is_first ? 0 : 1, sign * Rational(p.x), sign * Rational(p.y),
                                         sign * Rational(p.z)};
    for (std::size_t k = 0; k < 5; ++k) rows[k].push_back(column[k]);
  }
  for (std::size_t k = 0; k < 5; ++k) rows[k].push_back(k < 2 ? 1 : 0);
  for (unsigned set = 1; set < 1u << columns; ++set) {
    const std::vector<Rational> weight = basic_solution(rows, columns, set);
    for (std::size_t i = 0; i < first.size() && !weight.empty(); ++i)
      if (weight[i] > 0 && std::ranges::find(second, first[i]) == second.end()) return true;
  }
  return false;
}

bool is_proper(const Simplex& s, const std::vector<Vec3>& x) {
  const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(s[k])]; };
  const auto apart = [](const Vec3& a, const Vec3& b) { return std::array{b.x - a.x, b.y - a.y, b.z - a.z}; };
  const auto e = apart(at(0), at(1));
  if (s.size() == 2) return e != std::array{0., 0., 0.};
  const auto f = apart(at(0), at(2));
  return e[1] * f[2] != e[2] * f[1] || e[2] * f[0] != e[0] * f[2] || e[0] * f[1] != e[1] * f[0];
}

std::size_t audited(const Simplex& first, const Simplex& second, const std::vector<Vec3>& x) {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  for (const Simplex& s : {first, second})
    s.size() == 3 ? triangles.push_back({s[0], s[1], s[2]}) : edges.push_back({s[0], s[1]});
  return audit(build_topology(static_cast<Index>(x.size()), triangles, edges), x).count;
}

/// Checks the two simplices in every order of their corners, and in both orders of the simplices.
void check_in_all_orders(Simplex first, Simplex second, const std::vector<Vec3>& x, bool expected) {
  std::ranges::sort(first);
  do {
    std::ranges::sort(second);
    do {
      REQUIRE((audited(first, second, x) > 0) == expected);
      REQUIRE((audited(second, first, x) > 0) == expected);
    } while (std::ranges::next_permutation(second).found);
  } while (std::ranges::next_permutation(first).found);
}

}  // namespace

TEST_CASE("two triangles on an edge, a vertex, and beside a loose edge, as they were tried: the answers are known",
          "[unit]") {
  struct Known {
    std::vector<Vec3> x;
    Simplex first, second;
    bool meets;
  };
  const Vec3 o{0, 0, 0};
  const std::vector<Known> cases{// Both triangles lie in one plane and cross, and no corner of one lies in the other.
                                 {{{0, 0.2, 0}, {2, 0.2, 0}, {0.5, 0.2, 2}, {1.5, 0.2, 2}}, {0, 1, 2}, {0, 1, 3}, true},
                                 // Pairs with a common edge:
                                 // - folded flat, with a corner of one triangle in the other;
                                 // - folded flat onto the same place;
                                 // - folded nearly flat.
                                 {{o, {2, 0, 0}, {1, 0, 2}, {0.9, 0, 1}}, {0, 1, 2}, {0, 1, 3}, true},
                                 {{o, {2, 0, 0}, {1, 0, 2}, {1, 0, 2}}, {0, 1, 2}, {0, 1, 3}, true},
                                 {{o, {2, 0, 0}, {1, 0, 2}, {0.9, 1e-7, 1}}, {0, 1, 2}, {0, 1, 3}, false},
                                 // A pair in one plane, with the triangles on opposite sides of the common edge.
                                 {{o, {2, 0, 0}, {1, 0, 2}, {0.9, 0, -1}}, {0, 1, 2}, {0, 1, 3}, false},
                                 // Pairs of triangles with one common vertex:
                                 // - one triangle cuts the other;
                                 // - the triangles overlap in their plane;
                                 // - an edge of one lies on the other;
                                 // - the triangles have no other common point.
                                 {{o, {2, -1, 0}, {2, 1, 0}, {1, 0, -1}, {3, 0, 1.5}}, {0, 1, 2}, {0, 3, 4}, true},
                                 {{o, {2, 0, 0}, {0, 0, 2}, {2, 0, 0.5}, {0.5, 0, 2}}, {0, 1, 2}, {0, 3, 4}, true},
                                 {{o, {2, 0, 0}, {0, 0, 2}, {1, 0, 0}, {0, 0, -2}}, {0, 1, 2}, {0, 3, 4}, true},
                                 {{o, {2, -1, 0}, {2, 1, 0}, {-1, 0, -1}, {-1, 0, 1}}, {0, 1, 2}, {0, 3, 4}, false},
                                 // A triangle and a loose edge with one common vertex:
                                 // - the loose edge crosses the opposite edge in the triangle's plane;
                                 // - it ends on the opposite edge;
                                 // - it lies slightly beside the plane.
                                 {{o, {2, -1, 0}, {2, 1, 0}, {3, 0, 0}}, {0, 1, 2}, {0, 3}, true},
                                 {{o, {2, -1, 0}, {2, 1, 0}, {2, 0, 0}}, {0, 1, 2}, {0, 3}, true},
                                 {{o, {2, -1, 0}, {2, 1, 0}, {3, 0, 0x1p-60}}, {0, 1, 2}, {0, 3}, false},
                                 // Two loose edges with a common vertex: folded onto each other; in line.
                                 {{o, {2, 0, 0}, {1, 0, 0}}, {0, 1}, {0, 2}, true},
                                 {{o, {2, 0, 0}, {-1, 0, 0}}, {0, 1}, {0, 2}, false}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    INFO("case " << i);
    check_in_all_orders(cases[i].first, cases[i].second, cases[i].x, cases[i].meets);
  }
}

TEST_CASE("triangles that cross beside a common edge are listed as their edges, once", "[unit]") {
  const std::vector<Vec3> x{{0, 0.2, 0}, {2, 0.2, 0}, {0.5, 0.2, 2}, {1.5, 0.2, 2}};
  const Topology topology = build_topology(4, std::array{Triangle{0, 1, 2}, Triangle{0, 1, 3}});
  const AuditResult result = audit(topology, x);
  REQUIRE(result.count == 1);
  CHECK(describe(result.intersections[0], topology) == "edge (vertices 0, 3) meets edge (vertices 1, 2)");
  CHECK(audit(topology, x, std::vector<Index>(4, 0)).count == 0);
  const Exclusions sewn{{}, partner_rows(4, std::vector<std::array<Index, 2>>{{2, 3}})};
  CHECK(audit(topology, x, sewn).count == 0);
}

TEST_CASE("adjacent primitives meet where rational numbers say so, on lattices where nearly all is degenerate",
          "[property]") {
  const std::vector<std::pair<Simplex, Simplex>> kinds{
      {{0, 1, 2}, {0, 1, 3}}, {{0, 1, 2}, {0, 3, 4}}, {{0, 1, 2}, {0, 3}}, {{0, 1}, {0, 2}}};
  for (const std::uint64_t seed : {std::uint64_t{51}, ogc::tests::daily_seed("adjacent primitives")}) {
    INFO("seed " << seed);
    std::mt19937_64 draw(seed);
    std::array<std::size_t, 2> seen{};
    for (int round = 0; round < 600; ++round)
      for (const auto& [first, second] : kinds) {
        std::vector<Vec3> x;
        const std::uint64_t flat = draw() % 3;  // 0: all vertices are in a plane, so most cases are degenerate
        while (x.size() < 5) x.push_back({double(draw() % 4), double(draw() % 4), flat == 0 ? 0. : double(draw() % 3)});
        if (!is_proper(first, x) || !is_proper(second, x)) continue;
        const bool expected = meet_beyond(first, second, x);
        ++seen[expected ? 1 : 0];
        INFO("round " << round);
        check_in_all_orders(first, second, x, expected);
      }
    CHECK(std::ranges::min(seen) > 300);
  }
}
