// Tests that the lower bound of a pair's distance (`separation`) is never too large; it may be too small. A pair that
// the bound rejects must not change any smallest distance by one bit.
#include "fast/kernels/separation.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;

/// Draws the points of one pair: generic, on a lattice (parallel, coplanar, touching, of zero length), nearly flat or
/// nearly collinear. Some are far from the origin. Scales vary.
class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}

  void next(Vec (&x)[4]) {
    const int kind = static_cast<int>(random_() % 5);
    const float scale = std::ldexp(1.0F, static_cast<int>(random_() % 61) - 30),
                shift = random_() % 3 == 0 ? 100 * scale : 0.0F;
    const float flat = kind == 2 ? std::ldexp(1.0F, -static_cast<int>(random_() % 24)) : 1.0F;
    for (Vec& p : x) {
      p = kind == 1 ? Vec{integer(), integer(), integer()}
                    : Vec{uniform_(random_), flat * uniform_(random_), uniform_(random_)};
    }
    if (kind == 3) {
      const Vec along = x[1] - x[0];
      for (int k = 2; k < 4; ++k)
        x[k] = x[0] + uniform_(random_) * along + std::ldexp(1.0F, -static_cast<int>(random_() % 24)) * x[k];
    }
    for (Vec& p : x) p = scale * p + Vec{shift, shift, shift};
  }

 private:
  float integer() { return static_cast<float>(static_cast<int>(random_() % 5) - 2); }

  std::mt19937 random_;
  std::uniform_real_distribution<float> uniform_{-1, 1};
};

}  // namespace

TEST_CASE("separation: never above the rounded-down distance, in any scale and degenerate case", "[property]") {
  Points points(1);
  int edges_too_far = 0, triangle_too_far = 0;
  for (int k = 0; k < 400'000; ++k) {
    Vec x[4];
    points.next(x);
    const Ends p{x[0], x[1]}, q{x[2], x[3]};
    const Corners t{x[1], x[2], x[3]};
    edges_too_far += separation(p, q) > edge_edge_distance(p, q).below();
    triangle_too_far += separation(x[0], t) > point_triangle_distance(x[0], t).below();
  }
  CHECK(edges_too_far == 0);
  CHECK(triangle_too_far == 0);
}

TEST_CASE(
    "separation: the distance to a thousandth of all but a hundredth of generic pairs, so that it rejects what it "
    "should",
    "[property]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int loose_edges = 0, loose_triangles = 0;
  constexpr int count = 100'000;
  for (int k = 0; k < count; ++k) {
    Vec x[4];
    for (Vec& p : x) p = {uniform(random), uniform(random), uniform(random)};
    const Ends p{x[0], x[1]}, q{x[2], x[3]};
    const Corners t{x[1], x[2], x[3]};
    const double d = edge_edge_distance(p, q).value, e = point_triangle_distance(x[0], t).value;
    loose_edges += d > 0.01 && static_cast<double>(separation(p, q)) < 0.999 * d;
    loose_triangles += e > 0.01 && static_cast<double>(separation(x[0], t)) < 0.999 * e;
  }
  CHECK(loose_edges < count / 100);
  CHECK(loose_triangles < count / 100);
}

TEST_CASE("separation: rejects nothing that touches, and nothing at a distance of not a number", "[unit]") {
  const Ends p{{0, 0, 0}, {1, 0, 0}}, crossing{{0.5F, 0, -1}, {0.5F, 0, 1}}, point{{2, 2, 2}, {2, 2, 2}};
  CHECK_FALSE(is_beyond(separation(p, crossing), 0));
  CHECK_FALSE(is_beyond(separation(point, point), 0));
  CHECK_FALSE(is_beyond(std::nanf(""), 0));
  CHECK(is_beyond(0.5F, 0.2F));
  CHECK_FALSE(is_beyond(0.5F, 0.3F));
  CHECK_FALSE(is_beyond(-0.5F, 0.2F));
}
