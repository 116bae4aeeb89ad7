// Cases of closest_face. Canonical frame of the ladders: a = 0, b on the x axis, c in the xy plane, so that the planes
// which separate the features of a and of the edge ab are coordinate planes and the point can approach them by any
// power of ten.
#include <array>

#include "compare/judge/generators.hpp"
#include "compare/judge/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData finish(const std::array<Vec3, 4>& points) {
  return ClosestFaceCase{single(points[0]), {single(points[1]), single(points[2]), single(points[3])}};
}

/// Relabels the corners, then places.
CaseData placed(Random& random, const Vec3& p, std::array<Vec3, 3> corners) {
  const int first = random.below(3);
  const bool turned = random.one_in(2);
  std::array<Vec3, 4> points{p, corners[first], corners[(first + (turned ? 2 : 1)) % 3],
                             corners[(first + (turned ? 1 : 2)) % 3]};
  place(random, points);
  return finish(points);
}

std::array<Vec3, 3> canonical(Random& random) {
  const double length = random.between(0.2, 1.5);
  return {Vec3{}, Vec3{length, 0, 0}, Vec3{random.between(-0.7, 1.7) * length, random.between(0.1, 1.5), 0}};
}

CaseData uniform(Random& random) { return finish(points_in_box(random)); }
CaseData bits(Random& random) { return finish(points_of_bits(random)); }
CaseData lattice(Random& random) { return finish(points_on_lattice(random, 3)); }

/// Between the blocks of corner a and of edge ab.
CaseData corner_plane(Random& random) {
  return placed(random, {random.rung(), -random.magnitude(-3, 0), random.sign() * random.magnitude(-3, 0)},
                canonical(random));
}

/// Between the edge ab and the interior.
CaseData edge_plane(Random& random) {
  const auto corners = canonical(random);
  return placed(random, {random.between(0, 1) * corners[1].x, random.rung(), random.sign() * random.magnitude(-4, 0)},
                corners);
}

/// Near the corner a on both planes at once.
CaseData corner_edge(Random& random) {
  return placed(random, {random.rung(), random.rung(), random.one_in(2) ? random.rung() : random.between(-1, 1)},
                canonical(random));
}

/// d → 0 over the interior, an edge and a corner.
CaseData near(Random& random) {
  const auto corners = canonical(random);
  const double s = random.one_in(3) ? 0 : random.unit(), t = random.one_in(3) ? 0 : random.unit() * (1 - s);
  return placed(random, {s * corners[1].x + t * corners[2].x, t * corners[2].y, random.rung()}, corners);
}

/// One height tends to 0: c falls on the line of ab, inside or outside the edge.
CaseData needle(Random& random) {
  auto corners = canonical(random);
  corners[2].y = random.rung();
  const double y = random.one_in(2) ? random.rung() : random.between(-1, 1),
               z = random.one_in(2) ? random.rung() : random.between(-1, 1);
  return placed(random, {random.between(-0.3, 1.3) * corners[1].x, y, z}, corners);
}

/// One side tends to 0.
CaseData sliver(Random& random) {
  auto corners = canonical(random);
  corners[2] = sum(corners[random.below(2)], {random.rung(), random.rung(), 0});
  return placed(random,
                {random.between(-0.3, 1.3) * corners[1].x, random.one_in(2) ? random.rung() : random.between(-1, 1),
                 random.between(-1, 1)},
                corners);
}

/// Close to the short side of a triangle that is 10⁰ … 10⁶ times as long: there the weight of the far corner is least
/// certain.
CaseData base(Random& random) {
  const double side = random.magnitude(-3, 0), height = side * random.magnitude(0, 6);
  const Vec3 p{side * random.rung(), random.between(-0.2, 1.2) * side, side * random.rung()};
  return placed(random, p, {Vec3{}, Vec3{0, side, 0}, Vec3{height, random.between(-1, 1) * height, 0}});
}

/// Zero area, exactly: corners on a line of lattice points, two equal, or all equal.
CaseData zero_area(Random& random) {
  const Vec3 a = on_lattice(random, 2), direction = on_lattice(random, 1);
  const int kind = random.below(4);
  const double s = kind == 3 ? 0 : random.below(5), t = kind == 2 || kind == 3 ? s : random.below(5) - 2;
  const Vec3 p = random.one_in(2) ? on_lattice(random, 3) : in_box(random, -3, 3);
  std::array<Vec3, 4> points{p, a, sum(a, scaled(direction, s)), sum(a, scaled(direction, t))};
  permute(random, points);
  return finish(points);
}

/// A small triangle far from the origin: the differences of its coordinates are few bits.
CaseData offset(Random& random) {
  const Vec3 far = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = sum(far, in_box(random, 0, 1));
  return finish(points);
}

/// Next to a boundary: one of the ladders towards the planes, on its lower rungs.
CaseData boundary(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 3> ladders{corner_plane, edge_plane, corner_edge};
  random.be_fine();
  return random.pick(std::span<CaseData (*const)(Random&)>(ladders))(random);
}

constexpr std::array<Generator, 14> table{{{"uniform", 12, true, uniform},
                                           {"bits", 12, false, bits},
                                           {"dust", 6, false, uniform},
                                           {"lattice", 20, false, lattice},
                                           {"ladder.corner_plane", 8, false, corner_plane},
                                           {"ladder.edge_plane", 8, false, edge_plane},
                                           {"ladder.corner_edge", 8, false, corner_edge},
                                           {"ladder.near", 8, false, near},
                                           {"ladder.needle", 8, false, needle},
                                           {"ladder.sliver", 6, false, sliver},
                                           {"ladder.base", 6, false, base},
                                           {"ladder.zero_area", 5, false, zero_area},
                                           {"ladder.offset", 5, false, offset},
                                           {"ladder.boundary", 90, false, boundary}}};

}  // namespace

std::span<const Generator> closest_face_generators() { return table; }

}  // namespace ogc::compare
