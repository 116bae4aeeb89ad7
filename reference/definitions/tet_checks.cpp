// The map to space is locally injective inside tetrahedra and through triangles because all volumes are positive. At an
// inner edge it is locally injective if the tetrahedra cover a circle around the edge exactly once. At an inner vertex
// the tetrahedra must also be connected through triangles; then their directions cover the sphere without branching.
#include "reference/definitions/tet_checks.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "compare/problem/error.hpp"
#include "reference/definitions/tet_walk.hpp"

namespace ogc::reference {
namespace {

using compare::at;

[[noreturn]] void refuse(const std::string& what) { throw compare::InputError("tetrahedra: " + what); }

/// Returns the triangle opposite to corner k of a positive tetrahedron; its normal is outward.
compare::Triangle side_of(const Tetrahedron& t, std::size_t k) {
  constexpr std::array<std::array<std::size_t, 3>, 4> sides{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return {t[sides[k][0]], t[sides[k][1]], t[sides[k][2]]};
}

bool even(const compare::Triangle& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

bool holds(const Tetrahedron& t, Index v) { return std::find(t.begin(), t.end(), v) != t.end(); }

/// Maps the sorted vertices of a triangle to its tetrahedra. The number 4 i + k is tetrahedron i, whose corner k is
/// opposite to the triangle.
using Sides = std::map<compare::Triangle, std::vector<Index>>;

Sides sides_of(std::span<const Tetrahedron> tetrahedra) {
  Sides sides;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      compare::Triangle key = side_of(tetrahedra[i], k);
      std::sort(key.begin(), key.end());
      sides[key].push_back(static_cast<Index>(4 * i + k));
    }
  }
  return sides;
}

std::string list(std::span<const Index> numbers) {
  std::string text;
  for (const Index i : numbers) text += (text.empty() ? "" : ", ") + std::to_string(i);
  return text;
}

void check_sides(const Sides& sides, std::span<const Tetrahedron> tetrahedra) {
  for (const auto& [key, owners] : sides) {
    const std::string name = "the triangle of vertices " + list(key);
    if (owners.size() > 2)
      refuse(name + " belongs to " + std::to_string(owners.size()) + " tetrahedra; two are the most");
    if (owners.size() < 2) continue;
    const auto side = [&](Index owner) { return side_of(tetrahedra[at(owner / 4)], at(owner % 4)); };
    if (even(side(owners[0])) == even(side(owners[1])))
      refuse("tetrahedra " + std::to_string(owners[0] / 4) + " and " + std::to_string(owners[1] / 4) +
             " lie on the same side of " + name + "; the body is folded there");
  }
}

/// Returns the sign of the angle from c to d around the edge from `a` to `b`.
int turn_about(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return CGAL::sign(dot(cross(b - a, c - a), d - a));
}

/// Compares half-planes that begin at the line ab. Returns whether the half-plane through u lies between the
/// half-planes through c (included) and through d (excluded). The angle between these two must be less than 180°.
bool between_half_planes(const std::array<RationalPoint, 4>& abcd, const RationalPoint& u) {
  const auto& [a, b, c, d] = abcd;
  const int after = turn_about(a, b, c, u);
  if (after == 0) return dot(cross(b - a, c - a), cross(b - a, u - a)) > 0;
  return after > 0 && turn_about(a, b, u, d) > 0;
}

/// Returns how many tetrahedra around edge ab cover the half-plane that begins at ab and contains the third corner of
/// the first tetrahedron.
int turns_around(std::span<const Vec3f> positions, const std::vector<Tetrahedron>& around) {
  const RationalPoint u = corners_of(positions, around.front())[2];
  return static_cast<int>(std::count_if(around.begin(), around.end(), [&](const Tetrahedron& t) {
    return between_half_planes(corners_of(positions, t), u);
  }));
}

/// Returns the tetrahedron with corners i and j first and with the same orientation.
Tetrahedron with_first(const Tetrahedron& t, std::size_t i, std::size_t j) {
  std::array<std::size_t, 4> order{i, j, 0, 0};
  std::size_t free = 2;
  for (std::size_t k = 0; k < 4; ++k)
    if (k != i && k != j) order[free++] = k;
  int swaps = 0;
  for (std::size_t p = 0; p < 4; ++p)
    for (std::size_t q = p + 1; q < 4; ++q) swaps += order[p] > order[q];
  if (swaps % 2 == 1) std::swap(order[2], order[3]);
  return {t[order[0]], t[order[1]], t[order[2]], t[order[3]]};
}

/// Calls visit(i, j) for the corners i and j of every edge, with t[i] < t[j].
template <class Visit>
void for_each_edge(const Tetrahedron& t, Visit visit) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (t[i] < t[j]) visit(i, j);
}

void check_edges(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra,
                 std::span<const BoundaryTriangle> boundary) {
  std::map<compare::Edge, std::vector<Tetrahedron>> around;
  for (const Tetrahedron& t : tetrahedra)
    for_each_edge(t, [&](std::size_t i, std::size_t j) { around[{t[i], t[j]}].push_back(with_first(t, i, j)); });
  for (const BoundaryTriangle& side : boundary) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(side.vertices[k], side.vertices[(k + 1) % 3]);
      around.erase({low, high});
    }
  }
  for (const auto& [edge, ring] : around) {
    const int turns = turns_around(positions, ring);
    if (turns != 1)
      refuse("those around the inner edge of vertices " + list(edge) + " wind " + std::to_string(turns) +
             " times around it; once is right");
  }
}

/// Checks that the tetrahedra at an inner vertex are connected through triangles at that vertex.
void check_vertex(Index vertex, std::span<const Tetrahedron> tetrahedra, std::span<const Index> around) {
  std::vector<Index> waiting(around.begin() + 1, around.end()), reached{around[0]};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const auto neighbour = [&](Index t) {
      const auto& known = tetrahedra[at(reached[i])];
      return std::count_if(known.begin(), known.end(), [&](Index v) { return holds(tetrahedra[at(t)], v); }) == 3;
    };
    const auto first = std::stable_partition(waiting.begin(), waiting.end(), [&](Index t) { return !neighbour(t); });
    reached.insert(reached.end(), first, waiting.end());
    waiting.erase(first, waiting.end());
  }
  if (!waiting.empty())
    refuse("tetrahedra " + std::to_string(around[0]) + " and " + std::to_string(waiting[0]) +
           " hang together by the inner vertex " + std::to_string(vertex) +
           " alone; give each part a vertex of its own");
}

std::vector<BoundaryTriangle> boundary_of(const Sides& sides, std::span<const Tetrahedron> tetrahedra) {
  std::vector<Index> alone;
  for (const auto& [key, owners] : sides)
    if (owners.size() == 1) alone.push_back(owners[0]);
  std::sort(alone.begin(), alone.end());
  std::vector<BoundaryTriangle> boundary;
  for (const Index owner : alone) boundary.push_back({side_of(tetrahedra[at(owner / 4)], at(owner % 4)), owner / 4});
  return boundary;
}

}  // namespace

std::vector<BoundaryTriangle> checked_boundary(std::span<const Vec3f> positions,
                                               std::span<const Tetrahedron> tetrahedra,
                                               std::span<const std::vector<Index>> tetrahedra_of) {
  const Sides sides = sides_of(tetrahedra);
  check_sides(sides, tetrahedra);
  std::vector<BoundaryTriangle> boundary = boundary_of(sides, tetrahedra);
  check_edges(positions, tetrahedra, boundary);
  std::vector<bool> outer(positions.size(), false);
  for (const BoundaryTriangle& side : boundary)
    for (const Index v : side.vertices) outer[at(v)] = true;
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (!outer[v] && !tetrahedra_of[v].empty()) check_vertex(static_cast<Index>(v), tetrahedra, tetrahedra_of[v]);
  return boundary;
}

void check_shape(std::span<const Vec3f> positions, std::span<const Tetrahedron> tetrahedra) {
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    for (const Index v : tetrahedra[i])
      if (v < 0 || at(v) >= positions.size())
        refuse("tetrahedron " + std::to_string(i) + " names vertex " + std::to_string(v) + ", and there are " +
               std::to_string(positions.size()));
    const auto c = corners_of(positions, tetrahedra[i]);
    const Rational volume = weights(c, c[0])[0];
    if (volume <= 0)
      refuse("tetrahedron " + std::to_string(i) + (volume == 0 ? " is flat" : " is inverted") +
             "; shortest paths are defined for positive tetrahedra only: take a state, or an order of its vertices, in "
             "which all are positive");
  }
}

}  // namespace ogc::reference
