#include "compare/oracle/exact_intersection.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"
#include "tests/compare/oracle/rational_intersection.hpp"

using namespace ogc::compare;
using ogc::tests::hulls_meet;

namespace {

using Segment = std::array<Vec3, 2>;
using Corners = std::array<Vec3, 3>;

/// Returns whether segment and triangle meet. Checks that the answer equals that of hulls_meet for every order of
/// points and axes.
bool answer(const Segment& s, const Corners& t) {
  const bool expected = hulls_meet(s, t);
  constexpr std::array<std::array<std::size_t, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& axes : orders) {
    const auto turned = [&](const Vec3& v) {
      const std::array<double, 3> c{v.x, v.y, v.z};
      return Vec3{c[axes[0]], c[axes[1]], c[axes[2]]};
    };
    for (const auto& order : orders) {
      const Corners corners{turned(t[order[0]]), turned(t[order[1]]), turned(t[order[2]])};
      CHECK(segment_meets_triangle({turned(s[0]), turned(s[1])}, corners) == expected);
      CHECK(segment_meets_triangle({turned(s[1]), turned(s[0])}, corners) == expected);
    }
  }
  return expected;
}

constexpr Corners right_triangle{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};

}  // namespace

TEST_CASE("a segment across the plane meets a triangle in its interior, on its edges and in its corners", "[unit]") {
  CHECK(answer({Vec3{1, 1, -1}, Vec3{1, 1, 1}}, right_triangle));
  CHECK(answer({Vec3{2, 0, -1}, Vec3{2, 0, 1}}, right_triangle));  // edge
  CHECK(answer({Vec3{2, 2, -1}, Vec3{2, 2, 1}}, right_triangle));  // hypotenuse
  CHECK(answer({Vec3{4, 0, -1}, Vec3{4, 0, 1}}, right_triangle));  // corner
  CHECK(answer({Vec3{1, 1, 0}, Vec3{1, 1, 5}}, right_triangle));   // begins in the interior
  CHECK(answer({Vec3{2, 0, 0}, Vec3{2, -1, 5}}, right_triangle));  // begins on an edge
  CHECK(answer({Vec3{0, 4, 0}, Vec3{0, 5, 5}}, right_triangle));   // begins in a corner
  CHECK_FALSE(answer({Vec3{1, 1, 1}, Vec3{1, 1, 2}}, right_triangle));
  CHECK_FALSE(answer({Vec3{2, 2.5, -1}, Vec3{2, 2.5, 1}}, right_triangle));
  CHECK_FALSE(answer({Vec3{-1, 1, 0}, Vec3{-1, 1, 5}}, right_triangle));  // ends on the plane, outside
}

TEST_CASE("a segment in the plane of a triangle meets it where they overlap or touch", "[unit]") {
  CHECK(answer({Vec3{0.5, 0.5, 0}, Vec3{1, 1, 0}}, right_triangle));    // inside
  CHECK(answer({Vec3{-1, 1, 0}, Vec3{5, 1, 0}}, right_triangle));       // through
  CHECK(answer({Vec3{1, 1, 0}, Vec3{9, 9, 0}}, right_triangle));        // one end inside
  CHECK(answer({Vec3{1, 0, 0}, Vec3{2, 0, 0}}, right_triangle));        // part of an edge
  CHECK(answer({Vec3{-3, 0, 0}, Vec3{0, 0, 0}}, right_triangle));       // collinear with an edge, touching its corner
  CHECK(answer({Vec3{-2, 2, 0}, Vec3{2, -2, 0}}, right_triangle));      // only the corner at the origin
  CHECK(answer({Vec3{4, 0, 0}, Vec3{4, 7, 0}}, right_triangle));        // begins in a corner
  CHECK_FALSE(answer({Vec3{5, 0, 0}, Vec3{7, 0, 0}}, right_triangle));  // collinear with an edge, apart
  CHECK_FALSE(answer({Vec3{3, 3, 0}, Vec3{5, 5, 0}}, right_triangle));
  CHECK_FALSE(answer({Vec3{-1, -1, 0}, Vec3{5, -1, 0}}, right_triangle));
}

TEST_CASE("a collapsed triangle is the segment or point that it covers", "[unit]") {
  const Corners needle{Vec3{0, 0, 0}, Vec3{4, 4, 4}, Vec3{1, 1, 1}}, point{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}};
  CHECK(answer({Vec3{2, 2, 0}, Vec3{2, 2, 3}}, needle));        // crosses it
  CHECK(answer({Vec3{3, 3, 3}, Vec3{9, 0, 0}}, needle));        // begins on it
  CHECK(answer({Vec3{2, 2, 2}, Vec3{3, 3, 3}}, needle));        // lies in it
  CHECK(answer({Vec3{-1, -1, -1}, Vec3{0, 0, 0}}, needle));     // touches its end, collinear
  CHECK_FALSE(answer({Vec3{5, 5, 5}, Vec3{6, 6, 6}}, needle));  // collinear, apart
  CHECK_FALSE(answer({Vec3{2, 2, 0}, Vec3{3, 2, 0}}, needle));  // skew
  CHECK_FALSE(answer({Vec3{5, 5, 6}, Vec3{5, 5, 4}}, needle));  // in one plane, apart
  CHECK(answer({Vec3{0, 2, 3}, Vec3{2, 2, 3}}, point));
  CHECK(answer({Vec3{1, 2, 3}, Vec3{1, 2, 3}}, point));
  CHECK_FALSE(answer({Vec3{0, 2, 3}, Vec3{0.5, 2, 3}}, point));
  CHECK_FALSE(answer({Vec3{1, 2, 4}, Vec3{1, 2, 4}}, point));
}

TEST_CASE("a segment of length zero is a point", "[unit]") {
  const auto at = [](Vec3 p) { return Segment{p, p}; };
  CHECK(answer(at({1, 1, 0}), right_triangle));
  CHECK(answer(at({2, 2, 0}), right_triangle));
  CHECK(answer(at({0, 0, 0}), right_triangle));
  CHECK_FALSE(answer(at({3, 3, 0}), right_triangle));
  CHECK_FALSE(answer(at({1, 1, 1}), right_triangle));
}

TEST_CASE("one unit in the last place decides, where a computation in double does not see it", "[unit]") {
  // A point (1/2 + i 2⁻⁵³, 1/2 + j 2⁻⁵³, 0) lies in the plane x = y only if i = j. Subtracting a corner in double
  // rounds i and j away.
  const Corners plane{Vec3{-24, -24, -8}, Vec3{24, 24, -8}, Vec3{1, 1, 40}};
  int wrong_in_double = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      const Vec3 p{0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, 0};
      const double dx = p.x - plane[0].x, dy = p.y - plane[0].y;
      wrong_in_double += (dx == dy) != (i == j);
      CHECK(segment_meets_triangle({p, p}, plane) == (i == j));
      const double away = i < j ? -1 : 1;  // the first segment stays on the same side of the plane as p
      CHECK(segment_meets_triangle({p, Vec3{0.5 + away, 0.5 - away, 0}}, plane) == (i == j));
      CHECK(segment_meets_triangle({p, Vec3{0.5 - away, 0.5 + away, 0}}, plane));
    }
  }
  CHECK(wrong_in_double > 0);
}

TEST_CASE("one unit in the last place beside an edge decides in the plane too", "[unit]") {
  const float third = 1.0f / 3;
  for (const float y : {std::nextafter(third, 0.0f), third, std::nextafter(third, 1.0f)}) {
    const Segment s{Vec3{0.25, double{y}, 0}, Vec3{0.75, double{y}, 0}};
    CHECK(answer(s, {Vec3{0, double{third}, 0}, Vec3{1, double{third}, 0}, Vec3{0.5, 7, 0}}) == (y >= third));
  }
}

TEST_CASE(
    "the exact answer is that of brute force in rational numbers, on lattices full of degenerate cases and off them",
    "[property]") {
  std::mt19937 random(7);
  std::array<int, 2> seen{};
  for (const int size : {1, 2, 3, 1 << 20}) {
    const double scale = size > 3 ? 0.1 : 1;  // 0.1 is no binary fraction and fills all bits of the mantissa
    std::uniform_int_distribution<int> coordinate(0, size);
    const auto point = [&] {
      return Vec3{scale * coordinate(random), scale * coordinate(random), scale * coordinate(random)};
    };
    for (int trial = 0; trial < 500; ++trial) {
      const Segment s{point(), point()};
      const Corners t{point(), point(), point()};
      const bool expected = hulls_meet(s, t);
      ++seen[expected];
      REQUIRE(segment_meets_triangle(s, t) == expected);
      REQUIRE(segments_meet(s, {t[0], t[1]}) == hulls_meet(s, {t[0], t[1], t[1]}));
    }
  }
  CHECK(seen[0] > 200);
  CHECK(seen[1] > 200);
}
