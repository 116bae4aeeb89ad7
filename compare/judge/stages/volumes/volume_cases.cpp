// Makes cases of volume_depth: closed surfaces, surfaces with rims and of several parts, and points near their faces.
// Ladders approach
// - a height of 0, d = r, and the medial axis,
// - the boundaries of blocks at ridges, valleys, rims and vertices of all kinds,
// - plates without thickness, parts that overlap, touch or contain each other, and voids.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/volumes/solid_cases.hpp"
#include "compare/judge/stages/volumes/volume_bodies.hpp"
#include "compare/judge/stages/volumes/volume_cases.hpp"

namespace ogc::compare {

namespace {

using namespace placement;
using namespace volume_bodies;

/// Returns a box of n × m × l cells about the origin, of this size; its quads are cut along one diagonal.
VolumeBody box(const std::array<int, 3>& cells, const Vec3& size) {
  VolumeBody body;
  std::map<std::array<int, 3>, Index> numbers;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [entry, is_new] = numbers.try_emplace(p, static_cast<Index>(body.x.size()));
    if (is_new)
      body.x.push_back({size.x * (p[0] - 0.5 * cells[0]) / cells[0], size.y * (p[1] - 0.5 * cells[1]) / cells[1],
                        size.z * (p[2] - 0.5 * cells[2]) / cells[2]});
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, 1})
      for (int i = 0; i < cells[u]; ++i)
        for (int j = 0; j < cells[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[axis] = side * cells[axis];
            p[u] = i + di;
            p[v] = j + dj;
            return vertex(p);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side == 1) {
            body.triangles.push_back({a, b, c});
            body.triangles.push_back({a, c, d});
          } else {
            body.triangles.push_back({a, c, b});
            body.triangles.push_back({a, d, c});
          }
        }
  }
  return body;
}

/// Returns a cube's surface with each vertex moved to a random radius, which gives ridges, valleys, saddles and
/// reentrant vertices.
VolumeBody star(Random& random, int cells, double roughness) {
  VolumeBody body = box({cells, cells, cells}, {2, 2, 2});
  for (Vec3& p : body.x) p = scaled(unit(p), 1 + roughness * random.between(-1, 1));
  return body;
}

/// Returns a torus of m × n quads; the surface near its hole has saddles.
VolumeBody torus(int m, int n) {
  VolumeBody body;
  constexpr double turn = 6.283185307179586;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = turn * i / m, b = turn * j / n, ring = 0.7 + 0.3 * std::cos(b);
      body.x.push_back({ring * std::cos(a), ring * std::sin(a), 0.3 * std::sin(b)});
    }
  const auto number = [&](int i, int j) { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      body.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      body.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return body;
}

VolumeBody tetrahedron(Random& random) {
  VolumeBody body;
  body.x = {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}};
  for (Vec3& p : body.x) p = sum(p, in_box(random, -0.4, 0.4));
  body.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return body;
}

VolumeBody some_body(Random& random) {
  switch (random.below(5)) {
    case 0: return box({1 + random.below(2), 1 + random.below(2), 1 + random.below(2)}, {1, 1, random.between(0.3, 1)});
    case 1: return star(random, 2, random.between(0, 0.3));
    case 2: return star(random, 2 + random.below(2), random.between(0.2, 0.6));
    case 3: return torus(5 + random.below(3), 4 + random.below(2));
    default: return tetrahedron(random);
  }
}

/// Removes one triangle, or two that share an edge.
void open(Random& random, VolumeBody& body) {
  const Index t = random.below(static_cast<int>(body.triangles.size()));
  const Index other = random.one_in(2) ? t : body.across(t, at(random.below(3)));
  if (body.triangles.size() < 5) return;
  body.triangles.erase(body.triangles.begin() + std::max(t, other));
  if (other != t) body.triangles.erase(body.triangles.begin() + std::min(t, other));
}

/// Makes points at random near a body of one or two parts, with or without a rim.
CaseData uniform(Random& random) {
  VolumeBody body = some_body(random);
  if (random.one_in(3)) body.append(some_body(random), random.between(0.3, 1), in_box(random, -1, 1));
  for (Vec3& p : body.x) p = sum(p, in_box(random, -0.02, 0.02));
  if (random.one_in(4)) open(random, body);
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i)
    points.push_back(random.one_in(2) ? in_box(random, -1.5, 1.5)
                                      : sum(over_triangle(random, body).foot, in_box(random, -radius, radius)));
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

/// Returns a bipyramid of `count` vertices about the z axis. Three vertices give one triangle, fewer give no triangle.
VolumeBody of_vertices(int count) {
  VolumeBody body;
  const int ring = count < 5 ? count : count - 2;
  for (int k = 0; k < ring; ++k) {
    const double angle = 6.283185307179586 * k / ring;
    body.x.push_back({std::cos(angle), std::sin(angle), 0});
  }
  if (count == 3) body.triangles = {{0, 1, 2}};
  if (count < 5) return body;
  body.x.insert(body.x.end(), {Vec3{0, 0, 1}, Vec3{0, 0, -1}});
  for (int k = 0; k < ring; ++k) {
    const int next = (k + 1) % ring;
    body.triangles.push_back({k, next, ring});
    body.triangles.push_back({next, k, ring + 1});
  }
  return body;
}

CaseData few(Random& random) {
  constexpr std::array<int, 8> counts{0, 1, 2, 3, 5, 6, 10, 50};
  VolumeBody body = of_vertices(random.pick(std::span<const int>(counts)));
  for (Vec3& p : body.x) p = sum(p, in_box(random, -0.02, 0.02));
  Points points;
  for (int i = random.below(points_a_volume); i > 0; --i) points.push_back(in_box(random, -1.5, 1.5));
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}

bool has_area(const std::vector<Vec3f>& x, const Triangle& t) {
  const auto wide = [&](Index v) { return Vec3{x[at(v)].x, x[at(v)].y, x[at(v)].z}; };
  return volume_bodies::has_area(wide(t[0]), wide(t[1]), wide(t[2]));
}

/// Makes a tetrahedron of positive volume at any scale, with random bits over eight octaves as coordinates.
CaseData bits(Random& random) {
  const double scale = std::ldexp(1.0, random.below(25) - 12);
  const auto some = [&] {
    const auto one = [&] { return scale * random.sign() * random.pattern(0x1p-4f, 0x1p4f); };
    const double x = one(), y = one();
    return Vec3{x, y, one()};
  };
  VolumeBody body;
  body.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const auto is_legal = [&](const Triangle& t) {
    return volume_bodies::has_area(body.x[at(t[0])], body.x[at(t[1])], body.x[at(t[2])]);
  };
  do {
    body.x.clear();
    for (int k = 0; k < 4; ++k) body.x.push_back(some());
  } while (!std::ranges::all_of(body.triangles, is_legal));
  const Vec3 a = minus(body.x[1], body.x[0]), b = minus(body.x[2], body.x[0]), c = minus(body.x[3], body.x[0]);
  if (inner(outer(a, b), c) > 0)
    for (Triangle& t : body.triangles) std::swap(t[1], t[2]);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) points.push_back(some());
  return placed(random, std::move(body), std::move(points), scale * random.pattern(0x1p-6f, 0x1p3f), false, 1);
}

/// Makes boxes and points of small integers, where every tie is exact.
CaseData lattice(Random& random) {
  VolumeBody body = box({1 + random.below(2), 1 + random.below(2), 1 + random.below(2)},
                        {2, 2, random.one_in(2) ? 2.0 : 1.0});
  if (random.one_in(3)) body.append(box({1, 1, 1}, {1, 1, 1}), 1, on_lattice(random, 1));
  Points points;
  for (int i = 0; i < points_a_volume; ++i) points.push_back(on_lattice(random, 2));
  return placed(random, std::move(body), std::move(points), 0.5 * (1 + random.below(3)), false,
                std::ldexp(1.0, random.below(21) - 10));
}

/// Makes points above or below the surface. `place_of` chooses the foot of each point, `height_of` its height above the
/// foot.
template <class PlaceOf, class HeightOf>
CaseData beside(Random& random, VolumeBody body, PlaceOf place_of, HeightOf height_of) {
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = place_of(random, body);
    points.push_back(sum(place.foot, scaled(place.outward, height_of(random, place, radius))));
  }
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

double any_height(Random& random, const Place&, double radius) {
  return random.sign() * radius * random.between(0, 1.1);
}

/// Approaches a height of 0 above a triangle, an edge and a vertex.
CaseData surface(Random& random) {
  return beside(random, some_body(random), any_place,
                [](Random& r, const Place& place, double) { return place.edge * r.rung(); });
}
/// Makes points above ridges and valleys.
CaseData edge(Random& random) { return beside(random, some_body(random), over_edge, any_height); }
/// Makes points above convex, saddle and reentrant vertices.
CaseData vertex(Random& random) { return beside(random, star(random, 2, 0.5), over_vertex, any_height); }
/// Approaches d = r.
CaseData radius(Random& random) {
  return beside(random, some_body(random), any_place,
                [](Random& r, const Place&, double whole) { return whole * (1 + r.rung()); });
}
/// Makes points near rims.
CaseData rim(Random& random) {
  VolumeBody body = some_body(random);
  open(random, body);
  return beside(random, std::move(body), any_place, any_height);
}
/// Makes plates down to almost no thickness, with points on both sides and in the middle.
CaseData plate(Random& random) {
  const double thickness = random.magnitude(-4, -0.5);
  return beside(random, box({2, 2, 1}, {1, 1, thickness}), any_place,
                [thickness](Random& r, const Place&, double whole) {
                  return r.one_in(2) ? -thickness * (0.5 + r.rung()) : r.sign() * whole * r.between(0, 1.1);
                });
}
/// Approaches the medial axis of a box, where two or more faces are equally near.
CaseData medial(Random& random) {
  VolumeBody body = box({1, 1, 1}, {1, 1, 1});
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const double depth = random.between(0.05, 0.5), other = random.between(-0.4, 0.4);
    points.push_back({0.5 - depth, 0.5 - depth * (1 + random.rung()), random.one_in(2) ? other : depth - 0.5});
  }
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}
/// Makes parts that overlap, touch or contain each other, with points at faces of each.
CaseData parts(Random& random) {
  VolumeBody body = some_body(random);
  const int more = 1 + random.below(3);
  for (int i = 0; i < more; ++i)
    body.append(some_body(random), random.one_in(3) ? random.between(0.2, 0.5) : random.between(0.5, 1),
                random.one_in(3) ? Vec3{} : in_box(random, -1, 1));
  return beside(random, std::move(body), any_place, any_height);
}
/// Makes a body with a void of the same shape, behind a wall that may be very thin. The void may contain another body,
/// with or without a void of its own. Another part may overlap all of these. Points are in the void, near all faces,
/// and near the middle of the wall, where both surfaces of the wall are equally near.
CaseData cavity(Random& random) {
  const auto hollow = [&](const VolumeBody& solid, double share) {
    VolumeBody body = solid;
    body.append_void(solid, share, 0);
    return body;
  };
  const VolumeBody whole = star(random, 2 + random.below(2), random.between(0, 0.3)), island = star(random, 2, 0.1);
  const double wall = random.magnitude(-3, -0.2), share = 1 - wall;
  VolumeBody body = hollow(whole, share);
  if (random.one_in(3)) body.append(random.one_in(2) ? hollow(island, 0.5) : island, 0.3 * share, {});
  if (random.one_in(4)) body.append(some_body(random), random.between(0.3, 1), in_box(random, -1, 1));
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = any_place(random, body);
    const double height = random.one_in(2) ? any_height(random, place, radius) : -wall * (0.5 + random.rung());
    points.push_back(random.one_in(4) ? scaled(in_box(random, -1, 1), 0.6 * share)
                                      : sum(place.foot, scaled(place.outward, height)));
  }
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}
/// Puts points many radii deep in fine meshes, where a search up to r finds nothing.
CaseData deep(Random& random) {
  VolumeBody body = star(random, 3 + random.below(3), random.between(0, 0.1));
  Points points;
  for (int i = 0; i < points_a_volume; ++i) points.push_back(scaled(in_box(random, -1, 1), 0.55));
  return placed(random, std::move(body), std::move(points), random.magnitude(-3, -1), true, some_scale(random));
}
/// Scales cases by 2^±18, within legal limits of r.
CaseData units(Random& random) {
  VolumeBody body = some_body(random);
  const double small = 0x1p-18, large = 0x1p18, radius = random.between(0.3, 1.2);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = any_place(random, body);
    points.push_back(sum(place.foot, scaled(place.outward, radius * (random.one_in(2) ? 1 + random.rung()
                                                                                      : random.between(-1.1, 1.1)))));
  }
  const bool is_small = random.one_in(2);
  return placed(random, std::move(body), std::move(points), radius, !is_small, is_small ? small : large);
}
/// Takes cases with rungs of at most 10⁻⁵, next to positions where answers change.
CaseData boundary(Random& random) {
  random.be_fine();
  switch (random.below(4)) {
    case 0: return surface(random);
    case 1: return radius(random);
    case 2: return medial(random);
    default: return edge(random);
  }
}

constexpr std::array<Generator, 17> of_triangles{{{"uniform", 30, true, uniform},
                                                  {"few", 3, true, few},
                                                  {"bits", 8, false, bits},
                                                  {"dust", 6, false, uniform},
                                                  {"lattice", 12, false, lattice},
                                                  {"ladder.surface", 10, false, surface},
                                                  {"ladder.edge", 12, false, edge},
                                                  {"ladder.vertex", 12, false, vertex},
                                                  {"ladder.radius", 10, false, radius},
                                                  {"ladder.rim", 10, false, rim},
                                                  {"ladder.plate", 10, false, plate},
                                                  {"ladder.medial", 8, false, medial},
                                                  {"ladder.parts", 10, false, parts},
                                                  {"ladder.cavity", 8, false, cavity, 0, std::nullopt, true},
                                                  {"ladder.deep", 6, false, deep},
                                                  {"ladder.units", 8, false, units},
                                                  {"ladder.boundary", 260, false, boundary}}};

}  // namespace

std::span<const Generator> volume_depth_generators() {
  static const std::vector<Generator> table = [] {
    std::vector<Generator> all(of_triangles.begin(), of_triangles.end());
    const std::span<const Generator> of_tetrahedra = solid_depth_generators();
    all.insert(all.end(), of_tetrahedra.begin(), of_tetrahedra.end());
    return all;
  }();
  return table;
}

std::string volume_problem(const Topology& topology, const std::vector<Vec3f>& positions) {
  std::map<std::array<Index, 2>, int> directed;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const Triangle& corners = topology.triangles[t];
    if (!has_area(positions, corners)) return "triangle " + std::to_string(t) + " has no area";
    for (std::size_t k = 0; k < 3; ++k)
      if (++directed[{corners[k], corners[(k + 1) % 3]}] > 1)
        return "triangle " + std::to_string(t) + " runs through an edge in the sense of another one";
  }
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) return "edge " + std::to_string(e) + " belongs to no triangle";
  return {};
}

VolumeDepthCase volume_of_state(const MeshCase& state, Random& random) {
  VolumeDepthCase c;
  std::map<std::array<Index, 2>, int> directed;
  std::vector<Triangle> triangles;
  for (const Triangle& t : state.topology->triangles) {
    const auto used = [&](std::size_t k) { return directed.contains({t[k], t[(k + 1) % 3]}); };
    if (used(0) || used(1) || used(2) || !has_area(state.positions, t)) continue;
    for (std::size_t k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
    triangles.push_back(t);
  }
  c.topology = std::make_shared<const Topology>(build_topology(state.topology->vertex_count, triangles));
  c.positions = state.positions;
  c.contact_radius = state.contact_radius;
  for (int i = 0; i < points_a_volume && !state.positions.empty(); ++i) {
    const Vec3f& x = state.positions[at(random.below(static_cast<int>(state.positions.size())))];
    const Vec3 step = scaled(in_box(random, -1, 1), state.contact_radius * (random.one_in(2) ? 1 : random.rung()));
    c.points.push_back(single({x.x + step.x, x.y + step.y, x.z + step.z}));
  }
  return c;
}

}  // namespace ogc::compare
