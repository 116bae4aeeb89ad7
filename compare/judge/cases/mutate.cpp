#include "compare/judge/cases/mutate.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

namespace {

/// Rounds to single precision and clamps to legal coordinates (compare/judge/cases/legal.hpp).
float legal(double x) { return std::clamp(static_cast<float>(x), -most_coordinate, most_coordinate); }

Vec3f point(double x, double y, double z) { return {legal(x), legal(y), legal(z)}; }

double apart(const Vec3f& a, const Vec3f& b) {
  return std::max({std::abs(double{a.x} - b.x), std::abs(double{a.y} - b.y), std::abs(double{a.z} - b.z)});
}

class Mutation {
 public:
  Mutation(Random& random, std::span<Vec3f> points) : random_(random), points_(points) {}

  void one() {
    const Vec3f &a = any(), &b = any();
    Vec3f& moved = any();
    switch (random_.below(6)) {
      case 0: return shift(moved, a, apart(a, b));
      case 1:
        return shift(moved, point(0.5 * (double{a.x} + b.x), 0.5 * (double{a.y} + b.y), 0.5 * (double{a.z} + b.z)),
                     apart(a, b));
      case 2: moved = a; return;
      case 3: return shift(moved, moved, apart(a, b));
      case 4: return take_coordinate(moved, a);
      default: return coarsen(apart(a, b));
    }
  }

 private:
  Vec3f& any() { return points_[random_.bits() % points_.size()]; }

  void shift(Vec3f& moved, const Vec3f& to, double size) {
    moved = point(to.x + size * random_.rung(), to.y + size * random_.rung(), to.z + size * random_.rung());
  }

  void take_coordinate(Vec3f& moved, const Vec3f& from) {
    const int k = random_.below(3);
    (k == 0 ? moved.x : k == 1 ? moved.y : moved.z) = k == 0 ? from.x : k == 1 ? from.y : from.z;
  }

  /// Rounds all points to multiples of a power of two, 2⁻³ … 2⁻¹⁰ of `size`.
  void coarsen(double size) {
    if (!(size > 0)) return;
    const double step = std::ldexp(1.0, std::ilogb(size) - 3 - random_.below(8));
    for (Vec3f& p : points_)
      p = point(step * std::nearbyint(p.x / step), step * std::nearbyint(p.y / step),
                step * std::nearbyint(p.z / step));
  }

  Random& random_;
  std::span<Vec3f> points_;
};

}  // namespace

void mutate(Random& random, TestCase& test) { traits_of(test.name.stage).mutate(random, test.data); }

void mutate_points(Random& random, std::span<Vec3f> points) {
  if (points.empty()) return;
  Mutation mutation(random, points);
  for (int count = 1 + random.below(4); count > 0; --count) mutation.one();
}

std::vector<Vec3> mutated(Random& random, const std::vector<Vec3>& vectors) {
  std::vector<Vec3f> points = to_single(vectors);
  mutate_points(random, points);
  return to_double(points);
}

}  // namespace ogc::compare
