// Cases of closest_points. Canonical frame of the ladders: the first edge on the x axis, so that the planes through its
// ends are coordinate planes, the second above it.
#include <array>

#include "compare/judge/generators.hpp"
#include "compare/judge/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData finish(const std::array<Vec3, 4>& points) {
  return ClosestPointsCase{{single(points[0]), single(points[1])}, {single(points[2]), single(points[3])}};
}

/// Swaps ends and edges at random, then places.
CaseData placed(Random& random, std::array<Vec3, 4> points) {
  if (random.one_in(2)) std::swap(points[0], points[1]);
  if (random.one_in(2)) std::swap(points[2], points[3]);
  if (random.one_in(2)) {
    std::swap(points[0], points[2]);
    std::swap(points[1], points[3]);
  }
  place(random, points);
  return finish(points);
}

double height(Random& random) { return random.one_in(3) ? random.rung() : random.sign() * random.magnitude(-3, 0); }

CaseData uniform(Random& random) { return finish(points_in_box(random)); }
CaseData bits(Random& random) { return finish(points_of_bits(random)); }
CaseData lattice(Random& random) { return finish(points_on_lattice(random, 2)); }

/// Two edges that cross (seen from above) at an angle of `sine`, anywhere in both interiors.
std::array<Vec3, 4> crossing(Random& random, double sine, double z) {
  const double length = random.magnitude(-1, 1), s = random.between(0.05, 0.95), t = random.between(0.05, 0.95);
  const double cosine = std::sqrt(1 - sine * sine);
  return {Vec3{-s, 0, 0}, Vec3{1 - s, 0, 0}, Vec3{-t * length * cosine, -t * length * sine, z},
          Vec3{(1 - t) * length * cosine, (1 - t) * length * sine, z}};
}

/// Angle → 0 with crossing interiors.
CaseData parallel(Random& random) { return placed(random, crossing(random, std::abs(random.rung()), height(random))); }

/// Angle → the threshold of the rule for nearly parallel edges, sine² = 10⁻⁶, from both sides.
CaseData threshold(Random& random) {
  return placed(random, crossing(random, 1e-3 * (1 + random.rung()), height(random)));
}

/// Parallel edges whose projections overlap by a rung, from far apart to one inside the other.
CaseData overlap(Random& random) {
  const double length = random.magnitude(-1, 1), shift = random.one_in(2) ? 1 : -length,
               tilt = random.one_in(2) ? 0 : random.rung();
  const double x = shift + random.rung(), y = random.one_in(2) ? 0 : random.between(-1, 1), z = height(random);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x, y, z}, Vec3{x + length, y, z + tilt * length}});
}

/// Parallel edges in general position.
CaseData exact_parallel(Random& random) {
  const double x = random.between(-2, 2), length = random.magnitude(-1, 1),
               y = random.one_in(2) ? 0 : random.between(-1, 1), z = height(random);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x, y, z}, Vec3{x + length, y, z}});
}

/// The closest point of the first edge tends to its end, that of the second to anywhere.
CaseData end(Random& random) {
  const double x = random.rung(), slope = random.one_in(2) ? 0 : random.between(-2, 2), z = height(random);
  const double low = random.one_in(3) ? random.rung() : -random.between(0.1, 1), high = random.between(0.1, 1);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x + slope * low, low, z}, Vec3{x + slope * high, high, z}});
}

/// One or both lengths → 0.
CaseData zero_length(Random& random) {
  const Vec3 a = on_lattice(random, 2);
  const Vec3 short_side{random.rung(), random.one_in(2) ? 0 : random.rung(), 0};
  const Vec3 p = random.one_in(3) ? Vec3{} : in_box(random, -1, 1),
             q = random.one_in(4) ? sum(p, {0, random.rung(), 0}) : in_box(random, -1, 1);
  std::array<Vec3, 4> points{Vec3{}, short_side, p, q};
  if (random.one_in(2))
    for (Vec3& x : points) x = sum(x, a);
  return placed(random, points);
}

/// Distance → 0: crossings, an end on an interior, a shared end, equal edges, edges on one line.
CaseData near(Random& random) {
  const double z = random.rung();
  switch (random.below(5)) {
    case 0: return placed(random, crossing(random, random.between(0.1, 1), z));
    case 1:
      return placed(random,
                    {Vec3{}, Vec3{1, 0, 0}, Vec3{random.unit(), 0, z}, Vec3{random.unit(), random.between(-1, 1), 1}});
    case 2: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 0, z}, in_box(random, -1, 1)});
    case 3: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 0, z}, Vec3{1, 0, z}});
    default: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{1 + z, 0, 0}, Vec3{2 + z, 0, 0}});
  }
}

/// Short edges far from the origin: the differences of their coordinates are few bits.
CaseData offset(Random& random) {
  const Vec3 far = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = sum(far, in_box(random, 0, 1));
  return finish(points);
}

/// Next to a boundary: one of the ladders towards ends, overlaps and the rule for nearly parallel edges, on its lower
/// rungs.
CaseData boundary(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 3> ladders{threshold, overlap, end};
  random.be_fine();
  return random.pick(std::span<CaseData (*const)(Random&)>(ladders))(random);
}

constexpr std::array<Generator, 13> table{{{"uniform", 12, true, uniform},
                                           {"bits", 12, false, bits},
                                           {"dust", 6, false, uniform},
                                           {"lattice", 20, false, lattice},
                                           {"ladder.parallel", 10, false, parallel},
                                           {"ladder.threshold", 8, false, threshold},
                                           {"ladder.overlap", 8, false, overlap},
                                           {"ladder.exact_parallel", 6, false, exact_parallel},
                                           {"ladder.end", 8, false, end},
                                           {"ladder.zero_length", 5, false, zero_length},
                                           {"ladder.near", 6, false, near},
                                           {"ladder.offset", 5, false, offset},
                                           {"ladder.boundary", 120, false, boundary}}};

}  // namespace

std::span<const Generator> closest_points_generators() { return table; }

}  // namespace ogc::compare
