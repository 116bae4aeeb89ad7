// Makes meshes for detection and bounds, in units of one edge length. Generators that aim at a degeneracy make regular
// meshes, in which every tie is exact. The jitter of these meshes is a rung from 0 to a tenth of an edge.
#include <array>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/mesh_builder.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// In a run with at least this many cases, nearly all cases come from generators whose meshes have thousands of
/// vertices. In such meshes a device needs a hundredth of the time per case.
constexpr std::uint64_t large_run = 1000000;

constexpr std::array<int, 6> small_sizes{0, 1, 2, 3, 5, 10};

/// Returns 0 in half of the cases, otherwise 10⁻¹ … 10⁻⁷ edge lengths. Single precision resolves 10⁻⁷ at coordinates of
/// one edge length.
double jitter_rung(Random& random) {
  return random.one_in(2) ? 0 : std::pow(10.0, random.is_fine() ? -5 - random.below(3) : -1 - random.below(7));
}

/// Returns h (1 + rung/2), a radius that just reaches or just misses what lies at height h. Returns 0 in some cases;
/// `finish` replaces 0 by a random radius.
double radius_at(Random& random, double h) {
  return !random.is_fine() && random.one_in(3) ? 0 : std::abs(h) * (1 + 0.5 * random.rung());
}

/// Returns strips of triangles and a few loose edges in a box, with about one vertex per unit of volume.
MeshBuilder soup_of(Random& random, int size) {
  MeshBuilder builder;
  const double side = std::cbrt(size + 1.0);
  while (static_cast<int>(builder.points.size()) < size) {
    const Index n = static_cast<Index>(builder.points.size());
    const Vec3 near = n > 0 && !random.one_in(3) ? builder.points.back() : in_box(random, 0, side);
    builder.add(sum(near, in_box(random, -0.7, 0.7)));
    if (n < 2 || random.one_in(5)) continue;
    if (random.one_in(8))
      builder.loose_edges.push_back({n - 1, n});
    else
      builder.triangles.push_back({n - 2, n - 1, n});
  }
  return builder;
}

CaseData soup(Random& random) {
  constexpr std::array<int, 8> sizes{10, 10, 50, 50, 50, 100, 100, 200};
  return finish(random, soup_of(random, random.pick(std::span<const int>(sizes))), {});
}

CaseData few(Random& random) {
  return finish(random, soup_of(random, random.pick(std::span<const int>(small_sizes))), {});
}

/// Makes two wavy sheets, one above the other, with every vertex displaced.
CaseData cloth(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-1.5, 0.3), wave = random.between(0, 0.5);
  for (int layer = 0; layer < 2; ++layer) {
    const Index first = static_cast<Index>(builder.points.size());
    builder.grid(2 + random.below(8), 2 + random.below(8), {random.unit(), random.unit(), layer * gap}, {1, 0, 0},
                 {0, 1, 0});
    for (std::size_t i = first; i < builder.points.size(); ++i) {
      Vec3& p = builder.points[i];
      p.z += wave * std::sin(1.3 * p.x) * std::cos(0.7 * p.y);
    }
  }
  return finish(random, builder, {random.between(0.05, 0.3), 0});
}

/// Makes three to five wavy sheets of 900 to 3,600 vertices each, which give deep trees and long lists.
CaseData large(Random& random) {
  MeshBuilder builder;
  const int layers = 3 + random.below(3), side = 30 + random.below(31);
  const double gap = random.magnitude(-1, 0.2);
  for (int layer = 0; layer < layers; ++layer)
    builder.grid(side - 1, side - 1, {random.unit(), random.unit(), layer * gap}, {1, 0, 0}, {0, 1, 0});
  for (Vec3& p : builder.points) p.z += 0.4 * std::sin(0.6 * p.x) * std::cos(0.4 * p.y);
  return finish(random, builder, {random.between(0.05, 0.3), random.between(0.2, 1)});
}

/// Makes a soup (strips and loose edges) on small integers. It has ties, and triangles that touch, intersect, are
/// coplanar or collapsed.
CaseData lattice(Random& random) {
  MeshBuilder builder = soup_of(random, 3 + random.below(18));
  for (Vec3& p : builder.points) p = on_lattice(random, 1);
  return finish(random, builder, {0, random.one_in(2) ? 0 : 0.5 * (1 + random.below(4))});
}

/// Makes a soup (strips and loose edges) with random bits for coordinates and radii. It has needles, and edges of 10⁻⁶
/// beside edges of 10⁶.
CaseData bits(Random& random) {
  MeshBuilder builder = soup_of(random, 3 + random.below(8));
  MeshCase mesh;
  mesh.topology = std::make_shared<Topology>(
      build_topology(static_cast<Index>(builder.points.size()), builder.triangles, builder.loose_edges));
  mesh.rigid_groups.assign(builder.points.size(), -1);
  const auto number = [&] { return static_cast<float>(random.sign()) * random.pattern(); };
  for (std::size_t i = 0; i < builder.points.size(); ++i) {
    const float x = number(), y = number();
    mesh.positions.push_back({x, y, number()});
  }
  mesh.contact_radius = random.pattern();
  mesh.query_radius = random.one_in(4) ? mesh.contact_radius
                                       : mesh.contact_radius * static_cast<float>(random.between(1, 4));
  return mesh;
}

/// Makes two flat parallel sheets: vertex above vertex, shifted by half a cell, or rotated or sheared in their plane.
CaseData sheets(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-2, 0);
  const double shift = random.one_in(2) ? 0 : 0.5;
  builder.grid(1 + random.below(5), 1 + random.below(5), {}, {1, 0, 0}, {0, 1, 0});
  builder.grid(1 + random.below(5), 1 + random.below(5), {shift, shift, gap},
               random.one_in(3) ? Vec3{0.8, 0.6, 0} : Vec3{1, 0, 0},
               random.one_in(3) ? Vec3{-0.6, 0.8, 0} : Vec3{0, 1, 0});
  return finish(random, builder, {jitter_rung(random), radius_at(random, gap)});
}

/// Folds a sheet back onto itself. Near the fold, faces without a common vertex are close, and blocks end.
CaseData fold(Random& random) {
  MeshBuilder builder;
  const int half = 1 + random.below(4);
  const double open = random.one_in(3) ? 0 : random.magnitude(-3, -0.3);
  builder.grid(2 * half, 1 + random.below(4), {}, {1, 0, 0}, {0, 1, 0});
  for (Vec3& p : builder.points) {
    if (p.x <= half) continue;
    p.z = (p.x - half) * open;
    p.x = 2 * half - p.x;
  }
  return finish(random, builder, {jitter_rung(random), 0});
}

/// Returns copies of a mesh above each other, vertex exactly above vertex.
MeshBuilder stack_of(Random& random, double gap) {
  MeshBuilder builder;
  if (random.one_in(2))
    builder.fan(3 + random.below(6), {}, true, random.one_in(2) ? 0 : random.between(-1, 1));
  else
    builder.grid(1 + random.below(3), 1 + random.below(3), {}, {1, 0, 0}, {0, 1, 0});
  builder.repeat({0, 0, gap});
  if (random.one_in(2)) builder.repeat({0, 0, 2 * gap});
  return builder;
}

CaseData stack(Random& random) {
  const double gap = random.magnitude(-1.5, 0);
  const MeshBuilder builder = stack_of(random, gap);
  return finish(random, builder, {jitter_rung(random), radius_at(random, gap)});
}

/// Puts vertices and a small triangle above the hub, the spokes and the faces of a fan of up to 50 triangles.
CaseData fan(Random& random) {
  MeshBuilder builder;
  const int count = random.one_in(3) ? 50 : 3 + random.below(10);
  const double height = random.magnitude(-2, 0), tilt = random.one_in(2) ? 0 : random.between(-1, 1);
  builder.fan(count, {}, random.one_in(2), tilt);
  const Index a = builder.add({random.rung(), random.rung(), height}), b = builder.add({0.5, 0, height - 0.5 * tilt});
  const Index c = builder.add({0.5, 0.5, height + 0.5});
  builder.triangles.push_back({a, b, c});
  return finish(random, builder, {jitter_rung(random), radius_at(random, height)});
}

/// Puts the corners of a triangle above a vertex, an edge and the interior of a patch. The first two corners lie on
/// boundaries of the patch's blocks or one rung from them.
CaseData above(Random& random) {
  MeshBuilder builder;
  const double height = random.magnitude(-2, 0);
  builder.grid(2, 2, {-1, -1, 0}, {1, 0, 0}, {0, 1, 0});
  if (random.one_in(2)) builder.points[4].z = random.one_in(2) ? random.rung() : random.between(-1, 1);
  const double ridge = builder.points[4].z;
  const Index a = builder.add({random.rung(), random.rung(), ridge + height}),
              b = builder.add({0.5, random.rung(), 0.5 * ridge + height});
  const Index c = builder.add({random.between(-1, 1), random.between(-1, 1), ridge + height + random.unit()});
  builder.triangles.push_back({a, b, c});
  return finish(random, builder, {jitter_rung(random), radius_at(random, height)});
}

/// Makes several triangles on one edge (non-manifold), with vertices and edges around it.
CaseData book(Random& random) {
  MeshBuilder builder;
  const int pages = 1 + random.below(6);
  const Index a = builder.add({0, 0, 0}), b = builder.add({0, 0, 1});
  for (int k = 0; k < pages; ++k) {
    const double angle = random.one_in(3) ? 1.5707963267948966 * random.below(4) : random.between(0, 6.283185307179586);
    builder.triangles.push_back({a, b,
                                 builder.add({std::round(1e9 * std::cos(angle)) * 1e-9,
                                              std::round(1e9 * std::sin(angle)) * 1e-9, random.unit()})});
  }
  for (int k = 0; k < 3; ++k) {
    const Index n = builder.add(
        {random.rung(), random.one_in(2) ? random.rung() : random.between(-1, 1), random.between(-0.5, 1.5)});
    builder.add(sum(builder.points[n], in_box(random, -0.5, 0.5)));
    builder.add(sum(builder.points[n], in_box(random, -0.5, 0.5)));
    builder.triangles.push_back({n, n + 1, n + 2});
  }
  return finish(random, builder, {jitter_rung(random), 0});
}

/// Makes polylines of loose edges that lie side by side, cross at a small angle, or end on each other.
CaseData strands(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-2, 0);
  const int count = 2 + random.below(3);
  for (int k = 0; k < count; ++k) {
    const double sine = random.one_in(3) ? 0 : random.one_in(2) ? random.rung() : random.between(-1, 1);
    const double shift = random.one_in(2) ? 0.5 * random.below(3) : random.between(-1, 1);
    builder.strand(1 + random.below(6), {shift, -sine * random.below(3), k * gap},
                   {random.one_in(4) ? 0.0 : 1.0, sine, random.one_in(4) ? 0.5 : 0.0});
  }
  if (random.one_in(3)) builder.grid(2, 1, {0, 0, -gap}, {1, 0, 0}, {0, 1, 0});
  // A strand whose step is 0 has edges of length 0.
  return finish(random, builder, {jitter_rung(random), radius_at(random, gap)});
}

/// Makes rods with right angles, reversals and straight parts, exactly or up to a rung. Several segments lie within the
/// radius, so closest points change from one segment to the next at common vertices.
CaseData bends(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-1.5, 0);
  for (int k = 1 + random.below(3); k > 0; --k) {
    Vec3 at{0.5 * random.below(3), 0.5 * random.below(3), k * gap}, step{1, 0, 0};
    Index last = builder.add(at);
    for (int i = 2 + random.below(7); i > 0; --i) {
      const int turn = random.below(5);
      if (turn == 1) step = {-step.y, step.x, step.z};
      if (turn == 2) step = {step.z, step.x, step.y};
      if (turn == 3) step = {step.x + step.y, step.y - step.x, step.z};
      const Vec3 tilt = random.one_in(2) ? Vec3{} : Vec3{0, random.rung(), random.rung()};
      at = sum(at, sum(step, tilt));
      const Index next = builder.add(at);
      builder.loose_edges.push_back({last, next});
      last = next;
    }
  }
  return finish(random, builder,
                {jitter_rung(random), random.one_in(2) ? random.between(0.8, 4) : radius_at(random, gap)});
}

/// Makes a flat sheet whose radius exceeds its cells, so that each edge has parallel neighbours within r.
CaseData flat(Random& random) {
  MeshBuilder builder;
  const Vec3 column{random.pick(std::span<const double>(std::array{-0.5, 0.0, 0.5})), 1, 0};
  builder.grid(1 + random.below(5), 1 + random.below(5), {}, {1, 0, 0}, column);
  return finish(random, builder, {jitter_rung(random), random.between(0.8, 2.5)});
}

/// Adds neighbours of the edge ab: a triangle on it, and at each end a loose edge, a triangle or nothing. New vertices
/// lie above or below the edge, in its plane, or one rung from the plane.
void hang(Random& random, MeshBuilder& builder, Index a, Index b) {
  constexpr std::array<double, 4> ways{-1, 0, 0, 1};
  const auto arm = [&](Index at) {
    const Vec3 step{0.5 * (random.below(3) - 1), random.pick(std::span<const double>(ways)),
                    random.one_in(3) ? random.rung() : random.pick(std::span<const double>(ways))};
    return builder.add(sum(builder.points[static_cast<std::size_t>(at)], step));
  };
  if (random.one_in(2)) builder.triangles.push_back({a, b, arm(a)});
  for (const Index end : {a, b}) {
    const int kind = random.below(4);
    if (kind == 0) builder.loose_edges.push_back({end, arm(end)});
    if (kind == 1) builder.triangles.push_back({end, arm(end), arm(end)});
  }
}

/// Returns edges one above the other, parallel or tilted by a rung. Their ends are aligned, a rung apart or at random
/// places. `hang` adds neighbours to each edge. The overlap of two edges has two ends; the blocks of neighbours may
/// exclude both, one or none.
MeshBuilder pile_of(Random& random, double gap) {
  MeshBuilder builder;
  for (int k = 0, count = 2 + random.below(3); k < count; ++k) {
    const double start = random.one_in(2) ? 0.5 * random.below(3) : random.one_in(2) ? random.rung() : random.unit();
    const double length = random.sign() * (random.one_in(2) ? 1 : random.between(0.2, 2));
    const Vec3 tilt = random.one_in(2) ? Vec3{} : Vec3{0, random.rung(), random.rung()};
    const Index a = builder.add({start, 0, k * gap}), b = builder.add(sum({start + length, 0, k * gap}, tilt));
    builder.loose_edges.push_back({a, b});
    hang(random, builder, a, b);
  }
  return builder;
}

/// Puts piles in a row along x, the direction of their edges. So y and z stay small, and tilts are not rounded away.
CaseData parallel(Random& random) {
  constexpr double spacing = 10;
  MeshBuilder builder;
  const double gap = random.magnitude(-2, 0);
  for (int i = 2 + random.below(8); i > 0; --i) builder.append(pile_of(random, gap), {i * spacing, 0, 0});
  return finish(random, builder, {random.one_in(2) ? 0 : jitter_rung(random), gap * random.between(0.9, 3)});
}

/// Makes sheets of several rigid groups, of one group, or of none.
CaseData groups(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-1.5, 0);
  for (int k = 0; k < 3; ++k) {
    const Index first = static_cast<Index>(builder.points.size());
    builder.grid(1 + random.below(3), 1 + random.below(3), {0.25 * k, 0, k * gap}, {1, 0, 0}, {0, 1, 0});
    builder.group(first, random.below(4) - 1);
  }
  if (random.one_in(2))
    builder.groups[static_cast<std::size_t>(random.below(static_cast<int>(builder.points.size())))] = random.below(3) -
                                                                                                      1;
  return finish(random, builder, {random.one_in(2) ? 0.1 : jitter_rung(random), radius_at(random, gap)});
}

/// Makes two or three sheets whose borders are stitched, vertex to vertex or vertex to edge. Seams may have holes.
/// Excludes only the stitched pairs of vertices; pairs one row away from the seam, for example, are not excluded.
CaseData seams(Random& random) {
  MeshBuilder builder;
  const double gap = random.magnitude(-2, 0);
  const int columns = 1 + random.below(4), sheets = 2 + random.below(2);
  const bool beside = random.one_in(2), shifted = random.one_in(2);  // sheets side by side, or one on top of the other
  std::vector<Index> first;
  for (int k = 0; k < sheets; ++k) {
    first.push_back(static_cast<Index>(builder.points.size()));
    const double shift = shifted ? 0.5 * k : 0;
    const Vec3 origin = beside ? Vec3{shift, k * (2 + gap), 0} : Vec3{shift, 0, k * gap};
    builder.grid(columns, 2, origin, {1, 0, 0}, {0, 1, 0});
  }
  for (int k = 0; k + 1 < sheets; ++k) {
    const Index own = first[static_cast<std::size_t>(k)] + (beside ? 2 * (columns + 1) : 0),
                other = first[static_cast<std::size_t>(k) + 1];
    for (int i = 0; i <= columns; ++i) {
      if (random.one_in(6)) continue;  // leaves a hole in the seam
      builder.excluded.push_back({own + i, other + i});
      if (shifted && i > 0) builder.excluded.push_back({own + i, other + i - 1});
    }
  }
  return finish(random, builder, {random.one_in(2) ? 0.1 : jitter_rung(random), radius_at(random, gap)});
}

/// Makes a fine case of a stack or of sheets: the relative difference of radius and gap is at most 10⁻⁵, and jitter is
/// at most 10⁻⁵. In a stack nearly every vertex and edge has this gap.
CaseData boundary(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 4> ladders{stack, stack, stack, sheets};
  random.be_fine();
  return random.pick(std::span<CaseData (*const)(Random&)>(ladders))(random);
}

/// Makes 64 stacks side by side in one mesh, because a device takes as long for twenty vertices as for a thousand. The
/// gap in each stack is one rung from the radius. The stacks are on a lattice near the origin, so that single precision
/// resolves rungs of 10⁻⁵ and some smaller ones.
CaseData field(Random& random) {
  constexpr int side = 4;
  constexpr double spacing = 5;  // a stack is at most 3 wide, and r is below 1.5
  random.be_fine();
  MeshBuilder builder;
  const double gap = random.magnitude(-1.5, 0);
  const auto place = [](int i) { return spacing * (i - 0.5 * (side - 1)); };
  for (int i = 0; i < side * side * side; ++i)
    builder.append(stack_of(random, gap * (1 + 0.5 * random.rung())),
                   {place(i % side), place(i / side % side), place(i / (side * side))});
  return finish(random, builder, {jitter_rung(random), radius_at(random, gap)});
}

/// Makes triangles with a short edge or nearly no height. Each has a point near its short edge, where single precision
/// determines the smallest distance least accurately.
CaseData needles(Random& random) {
  MeshBuilder builder;
  for (int i = 4 + random.below(8); i > 0; --i) {
    const double side = random.magnitude(-3, 0), height = side * random.magnitude(0, 6), lean = random.between(-1, 1),
                 along = random.between(-0.2, 1.2);
    std::array<Vec3, 4> points{Vec3{side * random.rung(), along * side, side * random.rung()}, Vec3{}, Vec3{0, side, 0},
                               Vec3{height, lean * height, 0}};
    rotate(random, points);
    Index first = 0;
    for (const Vec3& point : points) first = builder.add(scaled(point, 1 / std::max(1.0, height))) - 3;
    builder.triangles.push_back({first + 1, first + 2, first + 3});
  }
  return finish(random, builder, {0, 0});
}

constexpr std::array<Generator, 22> table{{{"soup", 20, true, soup},
                                           {"cloth", 20, true, cloth},
                                           {"few", 3, true, few},
                                           {"large", 600, true, large, large_run},
                                           {"bits", 10, false, bits},
                                           {"dust", 8, false, soup},
                                           {"lattice", 15, false, lattice},
                                           {"ladder.sheets", 8, false, sheets},
                                           {"ladder.fold", 7, false, fold},
                                           {"ladder.stack", 7, false, stack},
                                           {"ladder.fan", 6, false, fan},
                                           {"ladder.above", 7, false, above},
                                           {"ladder.book", 4, false, book},
                                           {"ladder.strands", 4, false, strands},
                                           {"ladder.bends", 5, false, bends},
                                           {"ladder.parallel", 8, false, parallel},
                                           {"ladder.flat", 4, false, flat},
                                           {"ladder.groups", 4, false, groups},
                                           {"ladder.seams", 5, false, seams},
                                           {"ladder.needles", 5, false, needles},
                                           {"ladder.boundary", 450, false, boundary},
                                           {"ladder.field", 15000, false, field, large_run}}};

/// Returns one smallest distance: a random one, a tie, or 0.
float smallest(Random& random, int kind) {
  switch (kind) {
    case 0: return random.pattern();
    case 1: return static_cast<float>(random.unit());
    case 2: return std::ldexp(1.0f, random.below(3) - 10);
    default: return random.one_in(8) ? 0.0f : 0.005f;
  }
}

CaseData bound_case(Random& random, MeshCase mesh) {
  constexpr std::array<float, 5> relaxations{0.45f, 0.45f, 0.25f, 0.5f, 1.0f / 3};
  BoundCase c{mesh.topology,
              {},
              {},
              {},
              random.one_in(2) ? random.pick(std::span<const float>(relaxations))
                               : static_cast<float>(random.between(0.01, 0.5))};
  const int kind = random.below(4);
  const auto fill = [&](std::vector<float>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values.push_back(smallest(random, kind));
  };
  fill(c.d_min_vertex, static_cast<std::size_t>(mesh.topology->vertex_count));
  fill(c.d_min_edge, mesh.topology->edges.size());
  fill(c.d_min_triangle, mesh.topology->triangles.size());
  return c;
}

CaseData bound_soup(Random& random) { return bound_case(random, case_of<MeshCase>(soup(random))); }
CaseData bound_few(Random& random) { return bound_case(random, case_of<MeshCase>(few(random))); }
CaseData bound_cloth(Random& random) { return bound_case(random, case_of<MeshCase>(cloth(random))); }
CaseData bound_large(Random& random) { return bound_case(random, case_of<MeshCase>(large(random))); }
CaseData bound_fan(Random& random) { return bound_case(random, case_of<MeshCase>(fan(random))); }
CaseData bound_book(Random& random) { return bound_case(random, case_of<MeshCase>(book(random))); }
CaseData bound_strands(Random& random) { return bound_case(random, case_of<MeshCase>(strands(random))); }

constexpr std::array<Generator, 7> bound_table{{{"soup", 25, true, bound_soup},
                                                {"cloth", 25, true, bound_cloth},
                                                {"few", 5, false, bound_few},
                                                {"large", 2000, true, bound_large, large_run},
                                                {"ladder.fan", 20, false, bound_fan},
                                                {"ladder.book", 15, false, bound_book},
                                                {"ladder.strands", 10, false, bound_strands}}};

}  // namespace

std::span<const Generator> detect_generators() { return table; }
std::span<const Generator> bound_generators() { return bound_table; }

}  // namespace ogc::compare
