// Makes cases of stage truncate: vertices that moved, with balls or regions of half-spaces. The proposed position is
// the position before truncation. Ladders approach the bound, a half-space, points on several planes, proposed
// positions far outside, and regions thinner than the spacing of numbers.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// Returns a vertex that moved from `previous` by `step`.
CaseData moved(const Vec3& previous, const Vec3& step, float bound) {
  const Vec3f from = single(previous);
  return TruncateCase{from, single(sum({from.x, from.y, from.z}, step)), bound};
}

double length(const Vec3& a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

CaseData truncate_uniform(Random& random) {
  const Vec3 step = scaled(in_box(random, -1, 1), random.magnitude(-4, 0));
  return moved(in_box(random, -1, 1), step, static_cast<float>(length(step) * random.between(0.05, 2)));
}

CaseData truncate_bits(Random& random) {
  const auto coordinate = [&] { return static_cast<float>(random.sign()) * random.pattern(); };
  const Vec3f a{coordinate(), coordinate(), coordinate()}, b{coordinate(), coordinate(), coordinate()};
  return TruncateCase{a, b, random.pattern()};
}

/// Makes steps of rational length, so that ‖x − x_prev‖ is b exactly or differs by one bit.
CaseData truncate_lattice(Random& random) {
  constexpr std::array<Vec3, 6> steps{{{3, 4, 0}, {1, 2, 2}, {2, 3, 6}, {1, 4, 8}, {4, 4, 7}, {5, 0, 0}}};
  constexpr std::array<double, 6> lengths{5, 3, 7, 9, 9, 5};
  const int k = random.below(6);
  const double scale = std::ldexp(1.0, random.below(21) - 10);
  std::array<Vec3, 1> step{scaled(steps[k], scale)};
  permute(random, step);
  return moved(scaled(on_lattice(random, 3), random.one_in(2) ? scale : 1), step[0],
               beside(random, static_cast<float>(lengths[k] * scale)));
}

/// Approaches b = ‖x − x_prev‖.
CaseData truncate_bound(Random& random) {
  const TruncateCase c = case_of<TruncateCase>(
      moved(in_box(random, -1, 1), scaled(in_box(random, -1, 1), random.magnitude(-6, 0)), 0));
  const Vec3 step{double{c.position.x} - c.previous.x, double{c.position.y} - c.previous.y,
                  double{c.position.z} - c.previous.z};
  return TruncateCase{c.previous, c.position, beside(random, static_cast<float>(length(step)))};
}

/// Makes bounds as small as the spacing of coordinates and smaller.
CaseData truncate_far(Random& random) {
  const Vec3 step = scaled(in_box(random, -1, 1), random.magnitude(-3, 0));
  return moved(scaled(in_box(random, -1, 1), random.magnitude(0, 6)), step,
               static_cast<float>(length(step) * random.magnitude(-5, 0.5)));
}

/// Makes bounds and steps that are 0 or almost 0.
CaseData truncate_zero(Random& random) {
  const Vec3 step = random.one_in(3) ? Vec3{} : scaled(in_box(random, -1, 1), std::abs(random.rung()));
  return moved(random.one_in(2) ? Vec3{} : in_box(random, -1, 1), step,
               static_cast<float>(random.one_in(3) ? 0 : std::abs(random.rung())));
}

/// Returns slightly more than 2⁻⁵⁰ (Σ|n_k x_k| + |o|). X_prev and the current position must lie inside each half-space
/// by at least this margin.
double spare(const Vec3f& n, const Vec3f& x, double offset) {
  const double size = std::abs(double{n.x} * x.x) + std::abs(double{n.y} * x.y) + std::abs(double{n.z} * x.z);
  return 0x1.8p-50 * (size + std::abs(offset));
}

double height(const Vec3f& n, const Vec3f& x) { return double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z; }

/// Builds a region of X_prev, a ball, and half-spaces at distances from X_prev.
struct RegionBuilder {
  Random& random;
  TruncateCase c;

  RegionBuilder(Random& source, const Vec3& previous, double bound) : random(source) {
    c.previous = c.current = single(previous);
    c.bound = static_cast<float>(bound);
    stiffness(source.magnitude(0, 3));
    c.is_prescribed = source.one_in(4) ? 1 : 0;
  }

  /// Adds a half-space at the distance `room` from X_prev along the direction.
  void add(const Vec3& direction, double room) {
    const double norm = std::max(length(direction), 1e-30);
    const Vec3f n = single(scaled(direction, (random.one_in(8) ? random.magnitude(-0.3, 0.3) : 1) / norm));
    const double at = height(n, c.previous), offset = at + room;
    c.half_spaces.push_back({n, std::max(offset, at + spare(n, c.previous, offset))});
  }
  /// Sets the block H, at a random scale: the unit matrix as inertia, plus contacts along two random directions, which
  /// are `over_inertia` times as stiff.
  void stiffness(double over_inertia) {
    std::array<double, 6> h{1, 0, 0, 1, 0, 1};
    for (int k = 0; k < 2; ++k) {
      Vec3 a = in_box(random, -1, 1);
      a = scaled(a, 1 / std::max(length(a), 0.1));
      const std::array<double, 6> outer{a.x * a.x, a.x * a.y, a.x * a.z, a.y * a.y, a.y * a.z, a.z * a.z};
      for (std::size_t i = 0; i < 6; ++i) h[i] += over_inertia * outer[i];
    }
    const double scale = random.magnitude(-2, 4);
    for (std::size_t i = 0; i < 6; ++i) c.block[i] = static_cast<float>(scale * h[i]);
  }
  Vec3 previous() const { return {c.previous.x, c.previous.y, c.previous.z}; }
  /// Moves the vertex within a part of the ball about X_prev; it stays at X_prev if the new position is outside of the
  /// region.
  void set_current(double part) {
    const Vec3f x = single(sum(previous(), scaled(in_box(random, -1, 1), 0.5 * part * double{c.bound})));
    const Vec3 away{double{x.x} - c.previous.x, double{x.y} - c.previous.y, double{x.z} - c.previous.z};
    bool inside = length(away) <= double{c.bound} * (1 - 0x1p-40);
    for (const HalfSpace& h : c.half_spaces)
      inside = inside && height(h.normal, x) + spare(h.normal, x, h.offset) <= h.offset;
    if (inside) c.current = x;
  }
  /// Returns the case, in which X_prev + `step` is the position to be truncated.
  CaseData finish(const Vec3& step) {
    c.position = single(sum(previous(), step));
    return c;
  }
};

Vec3 direction(Random& random) {
  const Vec3 a = in_box(random, -1, 1);
  return scaled(a, 1 / std::max(length(a), 0.1));
}

/// Makes one to six half-spaces at any distance within the ball. The proposed position is at most three radii of the
/// ball from X_prev.
CaseData regions(Random& random) {
  const double bound = random.magnitude(-4, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  for (int k = 1 + random.below(random.one_in(2) ? 2 : 6); k > 0; --k)
    region.add(direction(random), bound * random.between(0.05, 1));
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.between(0.1, 3)));
}

/// Makes regions of small integers: heights and offsets are exact, and proposed positions may be exactly on a plane.
CaseData regions_lattice(Random& random) {
  RegionBuilder region(random, on_lattice(random, 3), 1 + random.below(6));
  for (int k = 1 + random.below(3); k > 0; --k) {
    Vec3 n;
    while (length(n) == 0) n = {1.0 * random.below(3) - 1, 1.0 * random.below(3) - 1, 1.0 * random.below(3) - 1};
    const Vec3f normal = single(n);
    const double at = height(normal, region.c.previous), offset = at + random.below(3);
    region.c.half_spaces.push_back({normal, std::max(offset, at + spare(normal, region.c.previous, offset))});
  }
  region.c.block = {4, 0, 0, 2, 0, 1};
  return region.finish(on_lattice(random, 4));
}

/// Puts X_prev on the plane of a half-space, or a rung times the bound inside of the half-space. The proposed position
/// is a rung times the bound from X_prev along the normal. In half of the cases it is also shifted along the plane.
CaseData on_plane(Random& random) {
  const double bound = random.magnitude(-3, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  const Vec3 n = direction(random);
  region.add(n, bound * std::abs(random.rung()));
  if (random.one_in(3)) region.add(direction(random), bound * random.unit());
  region.set_current(random.unit());
  // `along` is parallel to the plane, so that the proposed position is near the plane.
  const Vec3 any = direction(random), across = scaled(n, n.x * any.x + n.y * any.y + n.z * any.z);
  const Vec3 along = scaled(sum(any, scaled(across, -1)), bound * random.between(0.1, 2));
  return region.finish(sum(random.one_in(2) ? along : Vec3{}, scaled(n, bound * random.rung())));
}

/// Makes three half-spaces through one point, a rung from X_prev, with normals along the axes or random ones.
CaseData corner(Random& random) {
  const double bound = random.magnitude(-3, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  const bool is_cube = random.one_in(2);
  const Vec3 tip = scaled(direction(random), bound * std::abs(random.rung()));
  std::array<Vec3, 3> normals{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (Vec3& n : normals) {
    if (!is_cube) n = direction(random);
    const double room = n.x * tip.x + n.y * tip.y + n.z * tip.z;
    region.add(room < 0 ? scaled(n, -1) : n, std::abs(room));
  }
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.magnitude(-1, 1)));
}

/// Makes two half-spaces with nearly equal or nearly opposite normals, which leave a thin wedge.
CaseData wedge(Random& random) {
  const double bound = random.magnitude(-3, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  const Vec3 n = direction(random), tilt = scaled(direction(random), random.rung());
  region.add(n, bound * random.magnitude(-4, 0));
  region.add(sum(scaled(n, random.sign()), tilt), bound * random.magnitude(-4, 0));
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.magnitude(-1, 1)));
}

/// Makes proposed positions up to 10⁹ bounds away.
CaseData outside(Random& random) {
  const double bound = random.magnitude(-4, -1);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  for (int k = 1 + random.below(3); k > 0; --k) region.add(direction(random), bound * random.between(0, 1));
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.magnitude(0, 9)));
}

/// Makes regions as thin as the spacing of coordinates, and thinner.
CaseData sub_ulp(Random& random) {
  const double far = random.magnitude(0, 5), bound = far * 0x1p-24 * random.magnitude(-2, 2);
  RegionBuilder region(random, scaled(in_box(random, -1, 1), far), bound);
  for (int k = 1 + random.below(4); k > 0; --k) region.add(direction(random), bound * random.magnitude(-3, 0.3));
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.magnitude(-1, 3)));
}

/// Makes blocks H whose eigenvalues differ by up to 10⁶. In the metric of H, the nearest point of a half-space is far
/// from the foot of the perpendicular.
CaseData stiff(Random& random) {
  const double bound = random.magnitude(-3, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  region.add(direction(random), bound * random.unit());
  if (random.one_in(4)) region.add(direction(random), bound * random.unit());
  region.stiffness(random.magnitude(2, 6));
  region.c.is_prescribed = 0;
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.between(0.1, 2)));
}

/// Makes regions with very many half-spaces.
CaseData crowded(Random& random) {
  const double bound = random.magnitude(-4, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  for (int k = 8 + random.below(20); k > 0; --k)
    region.add(direction(random), bound * (random.one_in(3) ? std::abs(random.rung()) : random.unit()));
  region.set_current(random.unit());
  return region.finish(scaled(direction(random), bound * random.magnitude(-1, 1)));
}

/// Makes vertices that start at X_prev and whose step is only shortened, as with bounds=dat. X_prev is near half-spaces
/// or on them. The step is parallel to half-spaces, nearly parallel, or has a random direction relative to them.
CaseData from_previous(Random& random) {
  const double bound = random.magnitude(-4, 0);
  RegionBuilder region(random, in_box(random, -1, 1), bound);
  const Vec3 way = direction(random);
  for (int k = 1 + random.below(random.one_in(2) ? 2 : 8); k > 0; --k) {
    const Vec3 a = direction(random),
               across{way.y * a.z - way.z * a.y, way.z * a.x - way.x * a.z, way.x * a.y - way.y * a.x};
    const Vec3 n = random.one_in(3) ? across : a;
    region.add(sum(n, scaled(way, random.one_in(3) ? random.rung() : 0)), bound * std::abs(random.rung()));
  }
  region.c.is_prescribed = 1;
  return region.finish(scaled(way, bound * random.magnitude(-2, 1)));
}

constexpr std::array<Generator, 17> table{{{"uniform", 20, true, truncate_uniform},
                                           {"bits", 20, false, truncate_bits},
                                           {"dust", 8, false, truncate_uniform},
                                           {"lattice", 20, false, truncate_lattice},
                                           {"ladder.bound", 75, false, truncate_bound},
                                           {"ladder.far", 10, false, truncate_far},
                                           {"ladder.zero", 10, false, truncate_zero},
                                           {"regions", 16, true, regions, 0, Stage::plane},
                                           {"regions.lattice", 6, false, regions_lattice, 0, Stage::plane},
                                           {"ladder.on_plane", 30, false, on_plane, 0, Stage::plane},
                                           {"ladder.corner", 8, false, corner, 0, Stage::plane},
                                           {"ladder.wedge", 8, false, wedge, 0, Stage::plane},
                                           {"ladder.outside", 8, false, outside, 0, Stage::plane},
                                           {"ladder.sub_ulp", 20, false, sub_ulp, 0, Stage::plane},
                                           {"ladder.stiff", 8, false, stiff, 0, Stage::plane},
                                           {"ladder.crowded", 6, false, crowded, 0, Stage::plane},
                                           {"ladder.scaled", 10, false, from_previous, 0, Stage::plane}}};

}  // namespace

std::span<const Generator> truncate_generators() { return table; }

}  // namespace ogc::compare
