// Makes blocks of cells, each of six tetrahedra: unchanged, bent until they overlap, or crushed until tetrahedra turn
// inside out. Points are
// - near the surface and deep inside, and on medial axes,
// - on lines and planes of the cells, so that ways (straight paths to the boundary) lead along and through edges and
//   vertices,
// - where the body overlaps itself, and at its vertices (a vertex's own sheet does not count).
#include "compare/judge/stages/volumes/solid_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/volumes/volume_bodies.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {

namespace {

using namespace placement;
using namespace volume_bodies;

using Cells = std::array<int, 3>;

/// Returns a block of unit cells with a corner at the origin. Each cell has six tetrahedra about its diagonal.
VolumeBody block(const Cells& cells) {
  constexpr std::array<std::array<std::size_t, 3>, 6> ways{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  const std::array<Index, 3> step{(cells[1] + 1) * (cells[2] + 1), cells[2] + 1, 1};
  VolumeBody body;
  for (int i = 0; i <= cells[0]; ++i)
    for (int j = 0; j <= cells[1]; ++j)
      for (int k = 0; k <= cells[2]; ++k) {
        body.x.push_back({1.0 * i, 1.0 * j, 1.0 * k});
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        const Index a = i * step[0] + j * step[1] + k;
        for (std::size_t w = 0; w < ways.size(); ++w) {
          const Index b = a + step[ways[w][0]], c = b + step[ways[w][1]], d = c + step[ways[w][2]];
          body.tetrahedra.push_back(w < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
        }
      }
  body.triangles = boundary_triangles(body.tetrahedra);
  return body;
}

VolumeBody some_block(Random& random, int most) {
  return block({1 + random.below(most), 1 + random.below(most), 1 + random.below(most)});
}

void jitter(Random& random, VolumeBody& body, double size) {
  for (Vec3& p : body.x) p = sum(p, in_box(random, -size, size));
}

/// Moves the middle of the body to the origin and scales it to a size of about 1.
void centre(VolumeBody& body) {
  Vec3 low = body.x.front(), high = low;
  for (const Vec3& p : body.x) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = minus(high, low);
  const double scale = 2 / std::max({size.x, size.y, size.z});
  for (Vec3& p : body.x) p = scaled(minus(p, scaled(sum(low, high), 0.5)), scale);
}

/// Returns a bar bent into a helix of `turns` rotations, which rises by `pitch`. With more than one rotation its ends
/// overlap.
VolumeBody coil(Random& random, double turns, double pitch) {
  const int length = 6 + random.below(5);
  VolumeBody body = block({1, 1, length});
  const double angle = 6.283185307179586 * turns / length, inner_radius = random.between(1.2, 2);
  for (Vec3& p : body.x) {
    const double a = angle * p.z, r = inner_radius + p.x;
    p = {r * std::cos(a), p.y + pitch * p.z / length, r * std::sin(a)};
  }
  // The map from x, y, z to radius, pitch, angle keeps volumes positive.
  centre(body);
  return body;
}

VolumeBody some_coil(Random& random) { return coil(random, random.between(0.6, 2.2), random.between(-1.2, 1.2)); }

VolumeBody some_solid(Random& random) {
  VolumeBody body = random.one_in(2) ? some_block(random, 3) : some_coil(random);
  centre(body);
  if (random.one_in(2)) jitter(random, body, 0.03);
  return body;
}

/// Makes points above or below random feet on a body's surface. `height_of` chooses their heights.
template <class HeightOf>
CaseData beside(Random& random, VolumeBody body, HeightOf height_of) {
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = any_place(random, body);
    points.push_back(sum(place.foot, scaled(place.outward, height_of(random, place, radius))));
  }
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

/// Returns a random point in one of the tetrahedra.
Vec3 within(Random& random, const VolumeBody& body) {
  const Tetrahedron& t = body.tetrahedra[at(random.below(static_cast<int>(body.tetrahedra.size())))];
  std::array<double, 4> w{};
  double whole = 0;
  for (double& share : w) whole += share = random.between(0.01, 1);
  Vec3 x;
  for (std::size_t k = 0; k < 4; ++k) x = sum(x, scaled(body.x[at(t[k])], w[k] / whole));
  return x;
}

/// Makes points at random near and in a body.
CaseData solid(Random& random) {
  VolumeBody body = some_solid(random);
  jitter(random, body, 0.02);
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i)
    points.push_back(random.one_in(3) ? in_box(random, -1.2, 1.2) : within(random, body));
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

/// Puts cells at integers, and points at multiples of 1/2. So points lie on vertices, edges and triangles of the cells,
/// and their ways lead through such faces.
CaseData grid(Random& random) {
  VolumeBody body = some_block(random, 3);
  if (random.one_in(3)) body.append(some_block(random, 2), 1, on_lattice(random, 1));
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const auto half = [&] { return 0.5 * random.below(7); };
    const double x = half(), y = half();
    points.push_back({x, y, half()});
  }
  return placed(random, std::move(body), std::move(points), 0.25 * (1 + random.below(4)), false,
                std::ldexp(1.0, random.below(21) - 10));
}

/// Makes points whose ways (straight paths to the boundary) lead along lines of cells or through vertices of cells, or
/// pass these at the distance of a rung. The body is low along z, so that the shortest ways are parallel to z.
CaseData ray(Random& random) {
  const int height = 2 + random.below(3);
  VolumeBody body = block({3, 3, height});
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const double on_line = 1.0 + random.below(2), other = random.one_in(2) ? 1.0 + random.below(2) : 1 + random.unit();
    points.push_back(
        {on_line + random.rung(), other + (random.one_in(2) ? random.rung() : 0), height * random.between(0.05, 0.95)});
  }
  for (Vec3& p : body.x) p.z *= 0.3;
  for (Vec3& p : points) p.z *= 0.3;
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}

/// Makes a block without its middle cell, with points in the wall, in the void, and at both surfaces.
CaseData hollow(Random& random) {
  VolumeBody body = block({3, 3, 3});
  const auto middle = body.tetrahedra.begin() + 6 * 13;
  body.tetrahedra.erase(middle, middle + 6);
  body.triangles = boundary_triangles(body.tetrahedra);
  centre(body);
  jitter(random, body, random.one_in(2) ? 0.1 : 0);
  const double radius = some_radius(random);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = any_place(random, body);
    const Vec3 at_face = sum(place.foot, scaled(place.outward, random.sign() * radius * random.between(0, 1.1)));
    points.push_back(random.one_in(3) ? within(random, body) : random.one_in(3) ? in_box(random, -0.4, 0.4) : at_face);
  }
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

/// Makes points where the body overlaps itself.
CaseData sheets(Random& random) {
  VolumeBody body = coil(random, random.between(1.1, 2.8), random.between(-0.6, 0.6));
  Points points;
  for (int i = 0; i < points_a_volume; ++i) points.push_back(within(random, body));
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}

/// Moves vertices of tetrahedra through the opposite triangles, or into the planes of these, so that some tetrahedra
/// are not positive. In one of three cases moves only the interior vertices of a large block, so far that some sheets
/// may have no way.
VolumeBody crushed(Random& random) {
  if (random.one_in(3)) {
    VolumeBody body = block({3, 3, 3});
    for (Vec3& p : body.x)
      if (std::min({p.x, p.y, p.z}) > 0 && std::max({p.x, p.y, p.z}) < 3) p = sum(p, in_box(random, -1.4, 1.4));
    centre(body);
    return body;
  }
  VolumeBody body = some_solid(random);
  const int count = random.one_in(2) ? 1 + random.below(4) : 5 + random.below(15);
  for (int i = 0; i < count; ++i) {
    const Tetrahedron& t = body.tetrahedra[at(random.below(static_cast<int>(body.tetrahedra.size())))];
    const auto k = at(random.below(4));
    Vec3 middle;
    for (std::size_t m = 0; m < 4; ++m)
      if (m != k) middle = sum(middle, scaled(body.x[at(t[m])], 1.0 / 3));
    Vec3& p = body.x[at(t[k])];
    const double share = random.one_in(3) ? 1 + random.rung() : random.between(1, 2);
    p = sum(p, scaled(minus(middle, p), share));
  }
  return body;
}

bool is_legal(const VolumeBody& body) {
  return std::ranges::all_of(body.triangles, [&](const Triangle& t) {
    return has_area(body.x[at(t[0])], body.x[at(t[1])], body.x[at(t[2])]);
  });
}

CaseData inverted(Random& random) {
  VolumeBody body = crushed(random);
  while (!is_legal(body)) body = crushed(random);
  Points points;
  const double radius = some_radius(random);
  for (int i = 0; i < points_a_volume; ++i) {
    const Place place = any_place(random, body);
    points.push_back(random.one_in(3) ? sum(place.foot, scaled(place.outward, radius * random.between(-1.1, 1.1)))
                                      : within(random, body));
  }
  return placed(random, std::move(body), std::move(points), radius, true, some_scale(random));
}

/// Makes a tetrahedron with another one behind each of its four triangles. Most of these four are inside out. If all
/// four are inside out, no point of the first tetrahedron has a way (straight path to the boundary). Otherwise ways
/// lead through the tetrahedra that are not inside out.
CaseData lost(Random& random) {
  VolumeBody body;
  body.x = {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 2}};
  jitter(random, body, 0.2);
  const Tetrahedron first{0, 1, 2, 3};
  body.tetrahedra = {first};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [a, b, c] = opposite_face(first, k);
    const Vec3 middle = scaled(sum(sum(body.x[at(a)], body.x[at(b)]), body.x[at(c)]), 1.0 / 3);
    const double outward = random.one_in(5) ? random.between(0.2, 1) : -random.between(0.05, 0.9);
    body.x.push_back(sum(middle, scaled(minus(middle, body.x[k]), outward)));
    body.tetrahedra.push_back({a, b, c, static_cast<Index>(body.x.size()) - 1});
  }
  body.triangles = boundary_triangles(body.tetrahedra);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    Vec3 x;
    double whole = 0;
    std::array<double, 4> w{};
    for (double& share : w) whole += share = random.between(0.02, 1);
    for (std::size_t k = 0; k < 4; ++k) x = sum(x, scaled(body.x[k], w[k] / whole));
    points.push_back(x);
  }
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}

/// Makes points that are vertices of the body or near them; most bodies overlap themselves.
CaseData own(Random& random) {
  VolumeBody body = random.one_in(4) ? some_solid(random)
                                     : coil(random, random.between(0.9, 2.5), random.between(-1, 1));
  if (random.one_in(2)) jitter(random, body, 0.02);
  std::set<Index> outer_vertices;
  for (const Triangle& t : body.triangles) outer_vertices.insert(t.begin(), t.end());
  const std::vector<Index> all(outer_vertices.begin(), outer_vertices.end());
  Points points;
  std::vector<Index> asking;
  for (int i = 0; i < points_a_volume; ++i) {
    const Index v = random.pick(std::span(all));
    const bool is_own = !random.one_in(4);
    asking.push_back(is_own ? v : -1);
    points.push_back(is_own ? body.x[at(v)] : sum(body.x[at(v)], in_box(random, -0.1, 0.1)));
  }
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random),
                std::move(asking));
}

/// Approaches d = 0 from both sides, and d = r.
CaseData surface(Random& random) {
  return beside(random, some_solid(random), [](Random& r, const Place& place, double radius) {
    return r.one_in(2) ? place.edge * r.rung() : radius * (1 + r.rung());
  });
}

/// Approaches the medial axis of a block.
CaseData medial(Random& random) {
  VolumeBody body = some_block(random, 2);
  centre(body);
  Points points;
  for (int i = 0; i < points_a_volume; ++i) {
    const double depth = random.between(0.05, 0.5), other = random.between(-0.4, 0.4);
    points.push_back({1 - depth, 1 - depth * (1 + random.rung()), random.one_in(2) ? other : depth - 1});
  }
  return placed(random, std::move(body), std::move(points), some_radius(random), true, some_scale(random));
}

/// Makes a solid near other parts, or overlapping them. These parts are made of triangles or of tetrahedra.
CaseData mixed(Random& random) {
  VolumeBody body = some_solid(random);
  VolumeBody shell = block({1, 1, 1});
  centre(shell);
  shell.tetrahedra.clear();
  body.append(shell, random.between(0.3, 1), in_box(random, -1, 1));
  if (random.one_in(2)) body.append(some_solid(random), random.between(0.3, 1), in_box(random, -1, 1));
  return beside(random, std::move(body),
                [](Random& r, const Place&, double radius) { return r.sign() * radius * r.between(0, 1.1); });
}

// Plug-ins do not get these cases, because compare/plugin/geometry.h has no tetrahedra.
constexpr Stage volumes = Stage::volume_depth;
constexpr std::array<Generator, 11> table{{{"solid", 12, true, solid, 0, volumes},
                                           {"solid.grid", 8, false, grid, 0, volumes},
                                           {"ladder.ray", 8, false, ray, 0, volumes},
                                           {"ladder.hollow", 6, false, hollow, 0, volumes},
                                           {"ladder.sheets", 8, false, sheets, 0, volumes},
                                           {"ladder.inverted", 8, false, inverted, 0, volumes},
                                           {"ladder.lost", 6, false, lost, 0, volumes},
                                           {"ladder.own", 8, false, own, 0, volumes},
                                           {"ladder.solid_surface", 8, false, surface, 0, volumes},
                                           {"ladder.solid_medial", 6, false, medial, 0, volumes},
                                           {"ladder.solids", 6, false, mixed, 0, volumes}}};

}  // namespace

std::span<const Generator> solid_depth_generators() { return table; }

std::string solid_problem(const VolumeDepthCase& c) {
  for (const Tetrahedron& t : c.tetrahedra) {
    std::set<Index> corners(t.begin(), t.end());
    if (corners.size() != 4 || *corners.begin() < 0 || *corners.rbegin() >= c.topology->vertex_count)
      return "a tetrahedron needs four vertices of the volume";
  }
  const std::vector<TetrahedronFace> faces = sorted_faces(c.tetrahedra);
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].vertices != faces[i - 1].vertices) continue;
    if (faces[i].even == faces[i - 1].even || (i > 1 && faces[i - 2].vertices == faces[i].vertices))
      return "a triangle of tetrahedra has two of them on one side";
  }
  const auto in_order = [](std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
    return triangles;
  };
  const std::vector<Index> part = joined_components(*c.topology, c.tetrahedra);
  std::set<Index> solid;
  for (const Tetrahedron& t : c.tetrahedra) solid.insert(part[at(t[0])]);
  std::vector<Triangle> given;
  for (const Triangle& t : c.topology->triangles)
    if (solid.contains(part[at(t[0])])) given.push_back(t);
  if (in_order(given) != in_order(boundary_triangles(c.tetrahedra)))
    return "the triangles of a part of tetrahedra are not their boundary";
  if (!c.own.empty() && c.own.size() != c.points.size()) return "own vertices need one entry a point";
  for (std::size_t i = 0; i < c.own.size(); ++i) {
    if (c.own[i] == -1) continue;
    if (c.own[i] < 0 || c.own[i] >= c.topology->vertex_count || c.topology->vertex_triangles[at(c.own[i])].empty())
      return "an own vertex is none of the volume's surface";
    const Vec3f &x = c.points[i], &v = c.positions[at(c.own[i])];
    if (x.x != v.x || x.y != v.y || x.z != v.z) return "an own vertex is not where its point is";
  }
  return {};
}

}  // namespace ogc::compare
