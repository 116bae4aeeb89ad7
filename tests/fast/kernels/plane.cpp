#include "fast/kernels/held.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;
using Quad = __float128;

constexpr float share = 0.45f;

template <int m, int n>
PairPlane plane_of(const PairPoints<m, n>& pair) {
  return ogc::fast::plane_of(pair, distance_of(pair).below(), share);
}

/// Returns n·x in 113 bits: the three products have 48 bits each and exponents within 60 of each other.
Quad along(const Vec& n, const Vec& x) { return Quad(n.x) * x.x + Quad(n.y) * x.y + Quad(n.z) * x.z; }

bool is_exactly_behind(const HalfSpace& plane, const Vec& x) { return along(plane.normal, x) <= Quad(plane.offset); }

bool is_exactly_within(const FeasibleRegion& region, const Vec& x) {
  const Quad a = Quad(x.x) - region.ball.centre.x, b = Quad(x.y) - region.ball.centre.y,
             c = Quad(x.z) - region.ball.centre.z;
  return a * a + b * b + c * c <= Quad(region.ball.radius) * region.ball.radius;
}

bool is_exactly_in(const FeasibleRegion& region, const Vec& x) {
  for (int k = 0; k < region.count; ++k)
    if (!is_exactly_behind(region.planes[k], x)) return false;
  return is_exactly_within(region, x);
}

bool same_bits(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Draws the points of random pairs: apart, near, needles, collapsed triangles, far from the origin.
class RandomPairs {
 public:
  Vec point(float size) { return {size * unit_(random_), size * unit_(random_), size * unit_(random_)}; }
  float size() { return std::ldexp(1.0f, exponent_(random_)); }
  float number() { return unit_(random_); }

  template <int m, int n>
  PairPoints<m, n> pair() {
    PairPoints<m, n> pair{};
    const float extent = size(), apart = extent * size();
    const Vec origin = point(place_(random_) == 0 ? 1.0f : extent), away = point(apart), line = point(extent);
    const bool is_needle = place_(random_) == 0;
    for (Vec& x : pair.first) x = origin + point(extent);
    for (Vec& x : pair.second) x = pair.first[0] + away + (is_needle ? number() * line : point(extent));
    pair.is_first_fixed = place_(random_) == 0;
    pair.is_second_fixed = !pair.is_first_fixed && place_(random_) == 0;
    return pair;
  }

 private:
  std::mt19937 random_{27};
  std::uniform_real_distribution<float> unit_{-1, 1};
  std::uniform_int_distribution<int> exponent_{-20, 0}, place_{0, 3};
};

struct Counts {
  int planes = 0, without = 0, wrong = 0, meeting = 0, broken = 0, met = 0, off_way = 0;
};

/// Returns whether x lies on the segment from `from` to `to`. The tolerance along each axis is 8 · 2⁻²⁴ of the largest
/// coordinate, for the rounding of x and three steps of one unit in the last place.
bool is_on_way(const Vec& from, const Vec& to, const Vec& x) {
  const auto wide = [](const Vec& a) { return Vector<double>{a.x, a.y, a.z}; };
  const Vector<double> way = wide(to) - wide(from), gone = wide(x) - wide(from);
  const double square = dot(way, way), part = square > 0 ? std::clamp(dot(gone, way) / square, 0.0, 1.0) : 0;
  const Vector<double> off = gone - part * way;
  const double size = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return std::sqrt(dot(off, off)) <= std::sqrt(3.0) * 8 * 0x1p-24 * size;
}

/// Returns all points of a pair after each has moved towards a proposal as far as its region allows.
template <int m, int n>
PairPoints<m, n> moved(RandomPairs& random, const PairPoints<m, n>& pair, const PairPlane& plane, float radius,
                       Counts& counts, bool slides = true) {
  PairPoints<m, n> to = pair;
  const auto move = [&](Vec& x, const HalfSpace& side, bool is_fixed) {
    if (is_fixed) return;
    const FeasibleRegion region{{x, radius}, &side, 1, slides};
    Vec current = x;
    for (int k = 0; k < 3; ++k) {
      const Vec proposal = current + random.point(4 * radius);
      const Truncated kept = held(region, current, proposal, InertiaMetric{});
      if (!slides) counts.off_way += !is_on_way(x, proposal, kept.position);
      counts.broken += !is_exactly_in(region, kept.position);
      counts.broken += !kept.cut && !same_bits(kept.position, proposal);
      current = kept.position;
    }
    x = current;
  };
  const HalfSpace first = plane.of_first(), second = plane.of_second();
  for (Vec& x : to.first) move(x, first, pair.is_first_fixed);
  for (Vec& x : to.second) move(x, second, pair.is_second_fixed);
  return to;
}

template <int m, int n>
bool is_separated(const PairPlane& plane, const PairPoints<m, n>& pair) {
  bool separated = plane.first < plane.second;
  for (const Vec& x : pair.first) separated = separated && is_exactly_behind(plane.of_first(), x);
  for (const Vec& x : pair.second) separated = separated && is_exactly_behind(plane.of_second(), x);
  return separated;
}

template <int m, int n>
ByApproach<m, n> approach(RandomPairs& random) {
  ByApproach<m, n> all{};
  const float first = random.size(), second = random.number() > 0.5F ? 0.0F : first * random.size();
  for (Vec& w : all.first) w = random.point(first);
  for (Vec& w : all.second) w = random.point(second);
  return all;
}

template <int m, int n>
void check(RandomPairs& random, Counts& counts, bool divides = false) {
  const PairPoints<m, n> pair = random.pair<m, n>();
  const PairPlane plane = divides ? ogc::fast::plane_of(pair, distance_of(pair).below(), share, approach<m, n>(random))
                                  : plane_of(pair);
  if (!plane.exists()) {
    ++counts.without;
    return;
  }
  ++counts.planes;
  counts.wrong += !is_separated(plane, pair);
  const PairPoints<m, n> to = moved(random, pair, plane, 8 * plane.below, counts, !divides);
  counts.met += !is_separated(plane, to);
}

}  // namespace

TEST_CASE("plane: no vertex that keeps its side lets its pair meet, whatever it proposes", "[property]") {
  RandomPairs random;
  Counts counts;
  for (int i = 0; i < 50000; ++i) {
    check<1, 3>(random, counts);
    check<2, 2>(random, counts);
  }
  CHECK(counts.planes > 90000);
  CHECK(counts.wrong == 0);
  CHECK(counts.broken == 0);
  CHECK(counts.met == 0);
}

TEST_CASE("plane: where approach divides the gap and nothing slides no pair meets either", "[property]") {
  RandomPairs random;
  Counts counts;
  for (int i = 0; i < 50000; ++i) {
    check<1, 3>(random, counts, true);
    check<2, 2>(random, counts, true);
  }
  CHECK(counts.planes > 90000);
  CHECK(counts.wrong == 0);
  CHECK(counts.broken == 0);
  CHECK(counts.met == 0);
  CHECK(counts.off_way == 0);
}

TEST_CASE("plane: approach along the normal divides the gap, with a sixteenth for who does not approach", "[unit]") {
  // a vertex 1 m below a triangle
  const PairPoints<1, 3> pair{{{0, 0, 0}}, {{-1, -1, 1}, {1, -1, 1}, {0, 2, 1}}, false, false};
  const auto room_of_first = [&](const ByApproach<1, 3>& w) {
    const PairPlane plane = ogc::fast::plane_of(pair, 1, share, w);
    // Both sides together may move by 2 γ_p times the distance of 1 m.
    CHECK(plane.first + (1 - plane.second) == Approx(2 * static_cast<double>(share)));
    return plane.first / (2 * static_cast<double>(share));
  };
  CHECK(room_of_first({{{0, 0, 0}}, {}}) == Approx(0.5));
  CHECK(room_of_first({{{9, 0, -1}}, {{0, 0, 2}, {0, 0, 1}, {5, 5, 0}}}) == Approx(0.5));
  CHECK(room_of_first({{{0, 0, 3}}, {{0, 0, -1}, {0, 0, 5}, {}}}) == Approx(0.75));
  CHECK(room_of_first({{{0, 0, 1}}, {{0, 0, 1}, {0, 0, 1}, {}}}) == Approx(15.0 / 16));
  CHECK(room_of_first({{{0, 0, -1}}, {{0, 0, 1}, {0, 0, -1e-6F}, {}}}) == Approx(1.0 / 16));
}

TEST_CASE("plane: what does not slide is scaled from X_prev, prescribed or not", "[unit]") {
  const HalfSpace wall{{0, 0, 1}, 0.5};
  const FeasibleRegion region{{{0, 0, 0}, 10}, &wall, 1, false};
  const Vec current{1, 0, 0.25F}, proposal{2, 2, 1};
  for (const Truncated& kept :
       {held(region, current, proposal, InertiaMetric{}), held_on_path(region, current, proposal)}) {
    CHECK(kept.cut);
    CHECK(kept.position.x == Approx(1).epsilon(1e-6));
    CHECK(kept.position.y == Approx(1).epsilon(1e-6));
    CHECK(kept.position.z == Approx(0.5).epsilon(1e-6));
  }
  CHECK(held(region, current, {3, 3, -4}, InertiaMetric{}).position.z == -4);
}

TEST_CASE("plane: as near as the closest points, and no less room than a ball of the pair's distance", "[property]") {
  RandomPairs random;
  int narrow = 0, far = 0, planes = 0;
  const auto look = [&](const auto& pair) {
    const PairPlane plane = plane_of(pair);
    const auto [d, slack] = distance_of(pair);
    double extent = 0;
    for (const Vec& x : pair.first)
      for (const Vec& y : pair.second) extent = std::max(extent, norm_1(difference<Rounded>(x, y)));
    // In single precision n is rotated by 2⁻²⁴, and projections on n change by this share of the extent.
    if (!plane.exists() || d < 0x1p12 * slack || d < 0x1p-12 * extent) return;
    ++planes;
    // o₂ − o₁ is (1 − 2γ_p) times the gap, and the gap is the distance.
    far += std::abs((plane.second - plane.first) - (pair.is_first_fixed || pair.is_second_fixed ? 0.05 : 0.1) * d) >
           1e-3 * d;
    for (const Vec& x : pair.first)
      if (!pair.is_first_fixed) narrow += plane.first - static_cast<double>(along(plane.normal, x)) < 0.449 * d;
    for (const Vec& x : pair.second)
      if (!pair.is_second_fixed) narrow += static_cast<double>(along(plane.normal, x)) - plane.second < 0.449 * d;
  };
  for (int i = 0; i < 50000; ++i) {
    look(random.pair<1, 3>());
    look(random.pair<2, 2>());
  }
  CHECK(planes > 60000);
  CHECK(narrow == 0);
  CHECK(far == 0);
}

TEST_CASE(
    "plane: a region of many half-spaces holds what it returns, and takes the current position where nothing else",
    "[property]") {
  RandomPairs random;
  int outside = 0, changed = 0, moved = 0, cases = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec centre = random.point(1);
    const float radius = random.size();
    std::vector<HalfSpace> planes;
    for (int k = 0; k < 1 + i % 16; ++k) {
      const Vec n = random.point(1);
      planes.push_back({n, static_cast<double>(along(n, centre)) + radius * random.size()});
      if (!is_behind(planes.back(), centre)) planes.pop_back();
    }
    const FeasibleRegion region{{centre, radius}, planes.data(), static_cast<int>(planes.size())};
    Vec current = centre;
    for (int k = 0; k < 4; ++k) {
      const Vec proposal = centre + random.point(k == 3 ? 1e6f : 4 * radius);
      Symmetric3 block{1, 0, 0, 1, 0, 1};
      const Vec a = random.point(30);
      block.xx += a.x * a.x, block.xy = a.x * a.y, block.xz = a.x * a.z;
      block.yy += a.y * a.y, block.yz = a.y * a.z, block.zz += a.z * a.z;
      const Truncated kept = k == 2 ? held_on_path(region, current, proposal)
                                    : held(region, current, proposal, BlockMetric{block, 1});
      outside += !is_exactly_in(region, kept.position);
      changed += kept.cut == same_bits(kept.position, proposal);
      moved += !same_bits(kept.position, current);
      ++cases;
      current = kept.position;
    }
  }
  CHECK(outside == 0);
  CHECK(changed == 0);
  CHECK(moved > cases / 2);
}

TEST_CASE("plane: what slides along a wall keeps its way along it", "[unit]") {
  // A vertex 1 mm above a fixed wall may come down by 0.9 mm.
  const PairPoints<1, 3> pair{{{0, 0, 1e-3f}}, {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, false, true};
  const PairPlane plane = plane_of(pair);
  REQUIRE(plane.exists());
  const HalfSpace wall = plane.of_first();
  const FeasibleRegion region{{pair.first[0], 0.1f}, &wall, 1};
  const Truncated slid = held(region, pair.first[0], {0.02f, -0.01f, -0.01f}, InertiaMetric{});
  CHECK(slid.cut);
  CHECK(slid.position.x == 0.02f);
  CHECK(slid.position.y == -0.01f);
  CHECK(slid.position.z == Approx(1e-4).epsilon(1e-3));
  // On its straight path the vertex moves up to the half-space's plane.
  const Truncated scaled = held_on_path(region, pair.first[0], {0.011f, 0, -0.010f});
  CHECK(scaled.position.x == Approx(0.011 * 0.9 / 11).epsilon(1e-3));
  CHECK(scaled.position.z == Approx(1e-4).epsilon(1e-3));
  // If the vertex moves away from the wall, nothing is cut.
  CHECK_FALSE(held(region, pair.first[0], {0, 0, 0.05f}, InertiaMetric{}).cut);
}

TEST_CASE("plane: the least increase of a vertex's energy, not the shortest way", "[unit]") {
  // H is stiff along x, so the vertex leaves the half-space x + y ≤ 0 along y.
  const HalfSpace plane{{1, 1, 0}, 0};
  const FeasibleRegion region{{{0, 0, 0}, 1}, &plane, 1};
  const Truncated kept = held(region, {-0.1f, 0, 0}, {0.1f, 0.1f, 0}, BlockMetric{{1000, 0, 0, 1, 0, 1}, 1});
  CHECK(kept.position.x == Approx(0.1 - 0.2 / 1001).epsilon(1e-4));
  CHECK(kept.position.y == Approx(0.1 - 200.0 / 1001).epsilon(1e-4));
}

TEST_CASE("plane: where the ball ends a way, all of the way to it is gone, sliding or not", "[property]") {
  RandomPairs random;
  const HalfSpace beyond{{0, 0, 1}, 10};
  int at_end = 0, count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec centre = random.point(1), way = random.point(1);
    const float length = std::sqrt(dot(way, way));
    if (!(length > 0.1f)) continue;
    const FeasibleRegion region{{centre, 1e-3f}, &beyond, 1};
    const Vec proposal = centre + (3e-3f / length) * way;
    for (const Truncated& kept :
         {held(region, centre, proposal, InertiaMetric{}), held_on_path(region, centre, proposal)}) {
      CHECK(kept.cut);
      CHECK(is_exactly_in(region, kept.position));
      const Vec gone = kept.position - centre;
      at_end += std::sqrt(dot(gone, gone)) > 0.999e-3f;  // storing costs 2^-22 of a coordinate of size 1
      ++count;
    }
  }
  CHECK(at_end == count);
}

TEST_CASE("plane: what goes along its half-space gets to the end, whichever coordinate is small", "[property]") {
  // The coordinate along the normal's largest component is small. One step of its floats is too short to bring a stored
  // position back behind the plane.
  RandomPairs random;
  int short_of_end = 0, outside = 0, count = 0;
  for (int i = 0; i < 6000; ++i) {
    Vec x = random.point(1), n = random.point(1), way = random.point(1e-2f);
    float* const coordinates[] = {&x.x, &x.y, &x.z};
    float* const normals[] = {&n.x, &n.y, &n.z};
    *coordinates[i % 3] *= 1e-3f;
    *normals[i % 3] = 1;
    way = way - (dot(way, n) / dot(n, n)) * n;
    const double height = static_cast<double>(along(n, x));
    const HalfSpace beside{n, height + 0x1p-49 * std::abs(height)};
    const Vec target = x + way;
    // Skips moves that leave the half-space by rounding, about half of all.
    if (!is_behind(beside, x) || along(n, target) > along(n, x) || !(std::sqrt(dot(way, way)) > 5e-3f)) continue;
    const FeasibleRegion region{{x, 4e-3f}, &beside, 1};
    const Truncated kept = held_on_path(region, x, target);
    const Vec gone = kept.position - x;
    outside += !is_exactly_in(region, kept.position);
    // the tolerance covers the rounding of a stored position and three steps of one ulp, with coordinates of up to 1
    short_of_end += std::sqrt(dot(gone, gone)) < 4e-3f - 16 * 0x1p-24f;
    ++count;
  }
  CHECK(count > 1000);
  CHECK(outside == 0);
  CHECK(short_of_end == 0);
}

TEST_CASE("plane: turned axes turn the answer, but for the spacing of stored numbers", "[property]") {
  RandomPairs random;
  const auto turned = [](const Vec& a) { return Vec{a.y, a.z, a.x}; };
  int far = 0, outside = 0, cut = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec centre = random.point(1), n = random.point(1);
    const float radius = 1e-2f;
    const HalfSpace side{n, static_cast<double>(along(n, centre)) + 1e-3}, other{turned(n), side.offset};
    const Vec proposal = centre + random.point(4 * radius);
    const FeasibleRegion region{{centre, radius}, &side, 1}, region_turned{{turned(centre), radius}, &other, 1};
    for (const bool is_prescribed : {false, true}) {
      const auto hold = [is_prescribed](const FeasibleRegion& in, const Vec& from, const Vec& to) {
        return is_prescribed ? held_on_path(in, from, to) : held(in, from, to, InertiaMetric{});
      };
      const Truncated a = hold(region, centre, proposal), b = hold(region_turned, turned(centre), turned(proposal));
      const Vec apart = turned(a.position) - b.position;
      cut += a.cut;
      outside += a.cut != b.cut;
      // each of the two positions is rounded by half a spacing (2⁻²³) and moved back by at most three spacings
      far += std::sqrt(dot(apart, apart)) > 7 * 0x1p-23f;
    }
  }
  CHECK(cut > 20000);
  CHECK(outside == 0);
  CHECK(far == 0);
}

TEST_CASE(
    "plane: within the inner radius every position is behind all half-spaces, and it is hardly less than their "
    "distance",
    "[property]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto direction = [&] {
    Vec d;
    do d = {unit(random), unit(random), unit(random)};
    while (!(dot(d, d) > 0.01f));
    return (1.0f / std::sqrt(dot(d, d))) * d;
  };
  int outside = 0, pessimistic = 0, differences = 0;
  for (int i = 0; i < 20000; ++i) {
    const float size = i % 3 == 0 ? 1e-3f : i % 3 == 1 ? 1.0f : 1e3f;
    const Vec centre = size * direction();
    // the nearest half-space is a few spacings of floats away, or far more
    const double distance = size * (i % 2 == 0 ? 0x1p-22 : 0.1) * (1 + std::abs(unit(random)));
    HalfSpace sides[16];
    for (HalfSpace& side : sides) {
      side.normal = direction();
      side.offset = excess(side.normal, 0, centre).value + distance * (1 + std::abs(unit(random)));
    }
    sides[i % 16].offset = excess(sides[i % 16].normal, 0, centre).value + distance;
    const float inner = inner_radius(sides, 16, centre);
    pessimistic += !(inner > 0.9998 * distance && inner < distance);
    // a region that knows its inner radius truncates to the same bits, also where its ball is the smaller one
    const FeasibleRegion region{{centre, static_cast<float>((i % 5 == 0 ? 0.5 : 3) * distance)}, sides, 16};
    FeasibleRegion knowing = region;
    knowing.inner = inner;
    for (int k = 0; k < 20; ++k) {
      // towards the nearest half-space, or anywhere
      const Vec x = centre + inner * (k % 2 == 0 ? sides[i % 16].normal : direction());
      const Vec proposal = centre + (k < 10 ? 1.0f : 2.0f) * (x - centre);
      const Truncated one = held(region, centre, proposal, InertiaMetric{}),
                      other = held(knowing, centre, proposal, InertiaMetric{});
      differences += !same_bits(one.position, other.position) || one.cut != other.cut;
      if (!is_certainly_within(Ball{centre, inner}, x)) continue;
      for (const HalfSpace& side : sides) outside += !is_behind(side, x);
    }
  }
  CHECK(outside == 0);
  CHECK(pessimistic == 0);
  CHECK(differences == 0);
  // a half-space through the centre, or beyond it, leaves none
  const HalfSpace through{{1, 0, 0}, 2.0}, beyond{{1, 0, 0}, 1.5};
  CHECK(inner_radius(&through, 1, {2, 0, 0}) == 0);
  CHECK(inner_radius(&beyond, 1, {2, 0, 0}) == 0);
}

TEST_CASE("plane: touching pairs have none", "[unit]") {
  CHECK_FALSE(plane_of(PairPoints<1, 3>{{{0, 0, 0}}, {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, false, false}).exists());
  CHECK_FALSE(plane_of(PairPoints<2, 2>{{{-1, 0, 0}, {1, 0, 0}}, {{0, -1, 0}, {0, 1, 0}}, false, false}).exists());
}

TEST_CASE("plane: mirrored positions give mirrored answers, bit for bit", "[property]") {
  RandomPairs random;
  int different = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto pair = random.pair<2, 2>();
    auto other = pair;
    for (Vec& x : other.first) x.y = -x.y;
    for (Vec& x : other.second) x.y = -x.y;
    const PairPlane plane = plane_of(pair), mirrored = plane_of(other);
    different += plane.normal.x != mirrored.normal.x || plane.normal.y != -mirrored.normal.y ||
                 plane.first != mirrored.first || plane.second != mirrored.second;
    if (!plane.exists()) continue;
    const HalfSpace side = plane.of_first(), mirrored_side = mirrored.of_first();
    const Vec step = random.point(4 * plane.below), from = pair.first[0];
    const Truncated a = held({from, plane.below, &side, 1}, from, from + step, InertiaMetric{}),
                    b = held({other.first[0], plane.below, &mirrored_side, 1}, other.first[0],
                             other.first[0] + Vec{step.x, -step.y, step.z}, InertiaMetric{});
    different += !same_bits(a.position, {b.position.x, -b.position.y, b.position.z});
  }
  CHECK(different == 0);
}
