// Makes all decisions on the exact generators of the cone of normals, then converts the generators to unit vectors.
#include "reference/definitions/gauss_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/definitions/normal_cone.hpp"

namespace ogc::reference {
namespace {

Unit minus(const Unit& a, const Unit& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double inner(const Unit& a, const Unit& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Unit outer(const Unit& a, const Unit& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Unit normalised(const Unit& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Returns a / ‖a‖. Divides by the largest component first, so that neither squares nor the conversion to double
/// overflow or underflow.
Unit unit(const ExactVector& a) {
  const auto size = [](const Exact& x) { return sign_of(x) < 0 ? -x : x; };
  const Exact largest = std::max({size(a.x), size(a.y), size(a.z)});
  const double scale = largest.to_double();
  return normalised({a.x.to_double() / scale, a.y.to_double() / scale, a.z.to_double() / scale});
}

int rank_of(const std::vector<ExactVector>& g) {
  if (g.empty()) return 0;
  const auto second = std::find_if(g.begin(), g.end(),
                                   [&](const ExactVector& a) { return !is_zero(cross(g.front(), a)); });
  if (second == g.end()) return 1;
  const ExactVector n = cross(g.front(), *second);
  return std::any_of(g.begin(), g.end(), [&](const ExactVector& a) { return !dot(n, a).is_zero(); }) ? 3 : 2;
}

Unit sum_of(const std::vector<Unit>& units) {
  Unit sum{};
  for (const Unit& u : units) sum = {sum[0] + u[0], sum[1] + u[1], sum[2] + u[2]};
  return normalised(sum);
}

/// Sorts by angle about the axis, from −π to π relative to `zero`, so that an arc about `zero` stays in one piece.
void sort_around(std::vector<Unit>& units, const Unit& axis, const Unit& zero) {
  const Unit right = outer(axis, zero);
  const auto angle = [&](const Unit& u) { return std::atan2(inner(u, right), inner(u, zero)); };
  std::sort(units.begin(), units.end(), [&](const Unit& a, const Unit& b) { return angle(a) < angle(b); });
}

/// Sorts the corners of an arc or of a full circle by angle.
void order_arc(GaussMap& map, bool circle) {
  map.closed = circle;
  const auto tilted = std::max_element(map.corners.begin() + 1, map.corners.end(), [&](const Unit& a, const Unit& b) {
    return std::abs(inner(map.corners.front(), a)) > std::abs(inner(map.corners.front(), b));
  });
  const Unit axis = normalised(outer(map.corners.front(), *tilted));
  sort_around(map.corners, axis, circle ? map.corners.front() : sum_of(map.corners));
}

void order_region(GaussMap& map, int lineality) {
  map.closed = lineality == 3;
  if (map.closed) return;
  const Unit centre = sum_of(map.corners);
  // The generators of a half-sphere (lineality 2) include its centre, which is not a corner.
  if (lineality == 2) std::erase_if(map.corners, [&](const Unit& u) { return inner(u, centre) > 0.5; });
  const Unit& first = map.corners.front();
  const double along = inner(first, centre);
  sort_around(map.corners, centre, normalised(minus(first, {along * centre[0], along * centre[1], along * centre[2]})));
}

/// Returns the signed area of the spherical triangle (van Oosterom and Strackee).
double triangle_area(const Unit& a, const Unit& b, const Unit& c) {
  return 2 * std::atan2(inner(a, outer(b, c)), 1 + inner(a, b) + inner(b, c) + inner(c, a));
}

/// Returns the neighbours of a vertex in order around it, from one end of the fan of its triangles to the other. Empty
/// if the triangles are not one fan. A closed fan repeats its first neighbour at the end.
std::vector<Index> spokes_in_order(const Complex& mesh, Index vertex) {
  const auto triangles = mesh.topology.vertex_triangles[static_cast<std::size_t>(vertex)];
  const auto rim = [&](Index t) {
    const auto c = mesh.triangle(t);
    const auto k = static_cast<std::size_t>(std::find(c.begin(), c.end(), vertex) - c.begin());
    return std::array<Index, 2>{c[(k + 1) % 3], c[(k + 2) % 3]};
  };
  const auto holds = [](const std::array<Index, 2>& ends, Index v) { return ends[0] == v || ends[1] == v; };
  std::vector<bool> used(triangles.size(), false);
  const auto next = [&](Index spoke) -> Index {
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto ends = rim(triangles[k]);
      if (used[k] || !holds(ends, spoke)) continue;
      used[k] = true;
      return ends[0] == spoke ? ends[1] : ends[0];
    }
    return -1;
  };
  if (triangles.empty()) return {};
  Index start = rim(triangles.front())[0];
  for (const Index t : triangles) {
    const Index v = rim(t)[0];  // if no other triangle has this spoke, the fan begins here
    const auto count = std::count_if(triangles.begin(), triangles.end(),
                                     [&](Index other) { return holds(rim(other), v); });
    if (count == 1) start = v;
  }
  std::vector<Index> spokes{start};
  for (Index v = next(start); v >= 0; v = v == start ? -1 : next(v)) spokes.push_back(v);
  const bool one_fan = std::all_of(used.begin(), used.end(), [](bool u) { return u; });
  std::vector<Index> inner_spokes(spokes.begin(), spokes.end() - 1);
  std::sort(inner_spokes.begin(), inner_spokes.end());
  const bool simple = std::adjacent_find(inner_spokes.begin(), inner_spokes.end()) == inner_spokes.end();
  return one_fan && simple ? spokes : std::vector<Index>{};
}

}  // namespace

VertexKind classify(const Complex& mesh, Index vertex) {
  const std::vector<ExactVector> directions = star_directions(mesh, vertex_face(vertex));
  if (NormalCone(directions).generators().empty()) return VertexKind::saddle;
  const ExactVector x = exact(mesh.at(vertex));
  for (const Index t : mesh.topology.vertex_triangles[static_cast<std::size_t>(vertex)]) {
    const auto [a, b, c] = mesh.triangle(t);
    const ExactVector n = cross(exact(mesh.at(b)) - exact(mesh.at(a)), exact(mesh.at(c)) - exact(mesh.at(a)));
    bool above = false, below = false;
    for (const ExactVector& d : directions) {
      above = above || sign_of(dot(n, d)) > 0;
      below = below || sign_of(dot(n, d)) < 0;
    }
    if (above && below) return VertexKind::mixed;
  }
  return VertexKind::convex;
}

bool is_hull_edge(const Complex& mesh, Index vertex, Index edge) {
  const NormalCone cone(star_directions(mesh, vertex_face(vertex)));
  const ExactVector d = exact(mesh.at(mesh.across(edge, vertex))) - exact(mesh.at(vertex));
  std::vector<ExactVector> touching;
  for (const ExactVector& n : cone.generators()) {
    if (dot(n, d).is_zero()) touching.push_back(n);
  }
  return rank_of(touching) >= 2;
}

GaussMap gauss_map(const Complex& mesh, Face face, bool edge_only) {
  const NormalCone cone(star_directions(mesh, face, edge_only));
  GaussMap map;
  map.dimension = rank_of(cone.generators()) - 1;
  for (const ExactVector& g : cone.generators()) map.corners.push_back(unit(g));
  if (map.dimension == 1) order_arc(map, cone.lineality() == 2);
  if (map.dimension == 2) order_region(map, cone.lineality());
  return map;
}

double solid_angle(const GaussMap& map) {
  if (map.dimension < 2) return 0;
  if (map.closed) return 4 * std::numbers::pi;
  const Unit centre = sum_of(map.corners.size() == 4 && std::abs(inner(map.corners[0], map.corners[2]) + 1) < 1e-12 &&
                                     std::abs(inner(map.corners[1], map.corners[3]) + 1) < 1e-12
                                 ? std::vector<Unit>{outer(map.corners[0], map.corners[1])}
                                 : map.corners);
  double area = 0;
  for (std::size_t k = 0; k < map.corners.size(); ++k)
    area += triangle_area(centre, map.corners[k], map.corners[(k + 1) % map.corners.size()]);
  return std::abs(area);
}

std::optional<Indicatrix> indicatrix(const Complex& mesh, Index vertex) {
  const std::vector<Index> spokes = spokes_in_order(mesh, vertex);
  if (spokes.empty() || (spokes.size() == 3 && spokes.front() == spokes.back())) return std::nullopt;
  const ExactVector x = exact(mesh.at(vertex));
  Indicatrix result;
  for (std::size_t k = 0; k + 1 < spokes.size(); ++k) {
    const ExactVector n = cross(exact(mesh.at(spokes[k])) - x, exact(mesh.at(spokes[k + 1])) - x);
    if (is_zero(n)) return std::nullopt;
    result.normals.push_back(unit(n));
  }
  result.closed = spokes.front() == spokes.back();
  for (std::size_t k = 1; result.closed && k + 1 < result.normals.size(); ++k) {
    result.area += triangle_area(result.normals[0], result.normals[k], result.normals[k + 1]);
  }
  return result;
}

}  // namespace ogc::reference
