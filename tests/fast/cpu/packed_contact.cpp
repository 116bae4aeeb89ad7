// Tests which contacts a pack computes together. If a pack computed fewer contacts together, results would be the same,
// but slower.
#include "fast/cpu/packed_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

/// Holds a contact for each vector lane; x[s][lane] is vertex s of the lane's contact.
struct Four {
  Vec x[4][Pack::width];

  std::array<Vector<Pack>, 4> packs() const {
    std::array<Vector<Pack>, 4> packed;
    for (std::size_t s = 0; s < 4; ++s) {
      packed[s] = {Pack::of_each([&](int k) { return x[s][k].x; }), Pack::of_each([&](int k) { return x[s][k].y; }),
                   Pack::of_each([&](int k) { return x[s][k].z; })};
    }
    return packed;
  }
  /// Returns one bit per lane: whether the lane's weights have the same bits as the weights of its contact computed
  /// alone.
  unsigned alike(ContactKind kind, const ContactWeightsOf<Pack>& weights) const {
    unsigned all = 0;
    for (int k = 0; k < Pack::width; ++k) {
      const Vec own[4] = {x[0][k], x[1][k], x[2][k], x[3][k]};
      const ContactWeights one = weights_of_one(kind, own);
      const auto same = [&](int s) { return weights.slot[s][k] == one.slot[s]; };
      if (same(0) && same(1) && same(2) && same(3)) all |= 1U << k;
    }
    return all;
  }
};

}  // namespace

TEST_CASE("edges are computed together unless they have no length or count as parallel, at any scale", "[property]") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return D3{normal(random), normal(random), normal(random)}; };
  for (int trial = 0; trial < 4000; ++trial) {
    Four four;
    unsigned expected = 0;
    const double scale = std::ldexp(1.0, trial % 21 - 10);
    for (int k = 0; k < Pack::width; ++k) {
      // Squared ratio of the sine of the angle to the limit for nearly parallel edges. Rounding changes no ratio from
      // below 1 to above 1.
      const double share = std::array{0.3, 0.7, 1.4, 1.8, 3.0, 1e4}[random() % 6];
      const D3 start = vector(), first = vector(), aside = cross(first, vector());
      const D3 across = std::sqrt(share * 1e-6 / (1 - share * 1e-6)) * length(first) / length(aside) * aside;
      const D3 second = (random() % 2 == 0 ? 1.0 : -0.3) * (first + across), other = start + vector();
      const int without_length = static_cast<int>(random() % 8);  // 1 or 5: the first has no length; 2 or 5: the second
      const D3 points[4] = {start, without_length % 4 == 1 ? start : start + first, other,
                            without_length == 2 || without_length == 5 ? other : other + second};
      for (int s = 0; s < 4; ++s) four.x[s][k] = narrow(scale * points[s]);
      const bool proper = without_length % 4 != 1 && without_length != 2;
      // Coordinates near 1 are rounded by 2^-24, which changes sines near 1e-3 by about 1e-3 of their size.
      if (proper && share > 1) expected |= 1U << k;
    }
    Pack::Mask usual;
    const auto packs = four.packs();
    const ContactWeightsOf<Pack> weights = packed::segment_weights<Pack>(packs.data(), usual);
    REQUIRE(true_lanes(usual) == expected);
    REQUIRE((four.alike(ContactKind::segment_segment, weights) & expected) == expected);
  }
}

TEST_CASE("points over the interiors of triangles are computed together, at any scale", "[property]") {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> inner(0.1, 0.8), outer(-1, -0.1);
  const auto vector = [&] { return D3{normal(random), normal(random), normal(random)}; };
  for (int trial = 0; trial < 4000; ++trial) {
    Four four;
    unsigned expected = 0;
    const double scale = std::ldexp(1.0, trial % 21 - 10);
    for (int k = 0; k < Pack::width; ++k) {
      const D3 a = vector(), ab = vector(), aside = cross(ab, vector());
      const D3 ac = 0.3 * ab + length(ab) / length(aside) * aside, above = cross(ab, ac);
      const int beyond = static_cast<int>(random() % 6);  // beyond edge ac, ab or bc, or beyond none
      const double b = beyond == 0 ? outer(random) : inner(random), c = beyond == 1 ? outer(random) : inner(random);
      const double scaled = beyond == 2 ? 1.2 / (b + c) : 0.9 / std::max(b + c, 0.9);
      const D3 point = a + (b * scaled) * ab + (c * scaled) * ac + normal(random) * above;
      const D3 points[4] = {point, a, a + ab, a + ac};
      for (int s = 0; s < 4; ++s) four.x[s][k] = narrow(scale * points[s]);
      if (beyond > 2) expected |= 1U << k;
    }
    Pack::Mask usual;
    const auto packs = four.packs();
    const ContactWeightsOf<Pack> weights = packed::triangle_weights<Pack>(packs.data(), usual);
    REQUIRE(true_lanes(usual) == expected);
    REQUIRE((four.alike(ContactKind::point_triangle, weights) & expected) == expected);
  }
}
