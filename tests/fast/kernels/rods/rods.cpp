// Tests kernels of rods that no stage judges alone: frames at the start and the end of a step, metrics of rods, and the
// published update of a frame.
#include <array>
#include <random>

#include "fast/kernels/rods/contact_distance.hpp"
#include "fast/kernels/rods/metrics.hpp"
#include "fast/kernels/rods/turn.hpp"
#include "fast/kernels/sweep/update_segment.hpp"
#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

constexpr double u = 0x1p-24;

struct Drawn {
  std::mt19937 random;

  Quat orientation() {
    std::normal_distribution<float> normal;
    return unit(Quat{normal(random), normal(random), normal(random), normal(random)});
  }
  Vec vector() {
    std::normal_distribution<float> normal;
    return {normal(random), normal(random), normal(random)};
  }
};

double size(const Quat& q) {
  return std::sqrt(double{q.x} * q.x + double{q.y} * q.y + double{q.z} * q.z + double{q.w} * q.w);
}

/// Returns v after the smallest rotation from the direction of `from` to that of `to`, by Rodrigues' formula in double.
D3 rotated(const Vec& from, const Vec& to, const D3& v) {
  const D3 a = 1 / length(from) * wide(from), b = 1 / length(to) * wide(to), axis = cross(a, b);
  const double cosine = dot(a, b);
  return cosine * v + cross(axis, v) + dot(axis, v) / (1 + cosine) * axis;
}

/// Returns R(q) v from the matrix of q.
D3 turned_by(const Quat& q, const D3& v) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return {(1 - 2 * (y * y + z * z)) * v.x + 2 * (x * y - w * z) * v.y + 2 * (x * z + w * y) * v.z,
          2 * (x * y + w * z) * v.x + (1 - 2 * (x * x + z * z)) * v.y + 2 * (y * z - w * x) * v.z,
          2 * (x * z - w * y) * v.x + 2 * (y * z + w * x) * v.y + (1 - 2 * (x * x + y * y)) * v.z};
}

/// Holds a segment that starts at (1, 2, 3) along z and moves to lie along y. `turns` has the rotations of two motions
/// in each of two steps; tests use the second step. In this step the second motion has no rotation, which w = 2 marks.
struct OneSegment {
  SegmentRest rest{{1, 0}, 2, 1, 0};
  std::array<Vec, 2> start{Vec{1, 2, 5}, Vec{1, 2, 3}}, position{Vec{7, 10, 3}, Vec{7, 8, 3}};
  Quat before = unit(Quat{0.1f, 0.2f, 0.3f, 0.9f}), after{9, 9, 9, 9};
  std::array<Quat, 4> turns{Quat{0, 0, 1, 0}, Quat{0, 0, 1, 0}, unit(Quat{0, 0.6f, 0, 0.8f}), Quat{0, 0, 0, 2}};
  StepControl control;

  Quat turned(int held, bool turns_free) {
    control.steps_done = 1;
    TurnSegment{&rest, &held, turns.data(), 2, start.data(), position.data(), &before, &after, turns_free, &control}(0);
    return after;
  }
  Quat along() const { return turned_along({0, 0, 2}, {0, 2, 0}, before); }
};

}  // namespace

TEST_CASE("a frame is turned by the smallest rotation between two directions, whatever their lengths", "[property]") {
  Drawn drawn{std::mt19937(91)};
  for (int i = 0; i < 10000; ++i) {
    const Quat q = drawn.orientation();
    const Vec from = drawn.vector();
    Vec to = drawn.vector();
    if (i % 4 == 0) to = 1e-3f * (-1.0f * from + 0.1f * to);  // nearly opposite
    const Quat turned = turned_along(from, to, q);
    REQUIRE(std::abs(size(turned) - 1) <= 8 * u);
    const double cosine = dot(wide(from), wide(to)) / (length(from) * length(to));
    // Errors in units of 2⁻²⁴, with the angle θ between `from` and `to`:
    // - 14: two unit vectors (4 each) and their product (6), over 2 cos θ/2, the length of `twice` in turned_along
    // - 40: two products of quaternions, and normalising
    // A rotation doubles these errors.
    const double tolerance = 2 * (14 / std::sqrt(2 * (1 + cosine)) + 40) * u;
    for (const D3& v : {D3{1, 0, 0}, D3{0, 1, 0}, D3{0, 0, 1}})
      REQUIRE(length(turned_by(turned, v) - rotated(from, to, turned_by(q, v))) <= tolerance);
  }
}

TEST_CASE("a direction that is reversed turns half about the frame's first axis; none turns nothing", "[unit]") {
  Drawn drawn{std::mt19937(92)};
  for (int i = 0; i < 1000; ++i) {
    const Quat q = drawn.orientation();
    const D3 along = turned_by(q, {0, 0, 1}), first = turned_by(q, {1, 0, 0});
    const Quat reversed = turned_along({0, 0, 3}, {0, 0, -2}, q);
    CHECK(size(reversed) == Approx(1).epsilon(8 * u));
    CHECK(length(turned_by(reversed, {0, 0, 1}) + along) <= 40 * u);
    CHECK(length(turned_by(reversed, {1, 0, 0}) - first) <= 40 * u);
    CHECK(size(turned_along({0, 0, 0}, {0, 1, 0}, q) - q) == 0);
    CHECK(size(turned_along({0, 1, 0}, {0, 0, 0}, q) - q) == 0);
  }
}

TEST_CASE("at the start of a step a segment turns as what holds it does", "[unit]") {
  OneSegment one;
  CHECK(size(one.turned(segment_free, true) - one.along()) == 0);
  CHECK(length(turned_by(one.after, {0, 0, 1}) - rotated({0, 0, 1}, {0, 1, 0}, turned_by(one.before, {0, 0, 1}))) <=
        100 * u);
  CHECK(size(one.turned(segment_free, false) - one.before) == 0);  // rod_start=kept
  CHECK(size(one.turned(segment_fixed, true) - one.before) == 0);
  for (const bool turns_free : {false, true}) {
    CHECK(size(one.turned(0, turns_free) - one.turns[2] * one.before) <= 20 * u);
    CHECK(size(one.turned(1, turns_free) - one.along()) == 0);
  }
  one.turns[2] = {0, 0, 0, 1};  // a motion that does not rotate
  CHECK(size(one.turned(0, true) - one.before) <= 4 * u);
}

TEST_CASE("a frame that is turned in every step stays of unit length", "[property]") {
  Drawn drawn{std::mt19937(96)};
  Quat q = drawn.orientation();
  Vec from = drawn.vector();
  for (int step = 0; step < 100000; ++step) {
    const Vec to = drawn.vector();
    q = turned_along(from, to, q);
    from = to;
  }
  CHECK(std::abs(size(q) - 1) <= 4 * u);  // the accuracy of `unit`, however often it is applied
}

TEST_CASE("frames of a step count where the step does", "[unit]") {
  const Quat now{0.6f, 0, 0, 0.8f};
  Quat start{0, 0, 0, 1};
  StepControl control;
  control.active = 0;
  CommitSegment{&now, &control, &start}(0);
  CHECK(size(start - Quat{0, 0, 0, 1}) == 0);
  control.active = 1;
  CommitSegment{&now, &control, &start}(0);
  CHECK(size(start - now) == 0);
}

TEST_CASE("with damping a segment asks for its strain at the start of the step, seen from its frame then",
          "[property]") {
  Drawn drawn{std::mt19937(93)};
  for (int i = 0; i < 1000; ++i) {
    const SegmentRest rest{{1, 0}, 0.5f, 3, 0.25f};
    const std::array<Vec, 2> start{drawn.vector(), drawn.vector()};
    const Quat q = drawn.orientation();
    Vec direction;
    SetDirection{&rest, start.data(), &q, &direction}(0);
    // By definition R(qᵗ) (c − e₃) = k Dᵗ/l, with c = `direction` and k = k_d/h = 0.25. Dᵗ leads from the segment's
    // first end, vertex 1, to its second end, vertex 0.
    const D3 apart = wide(start[0]) - wide(start[1]);
    const D3 asked = turned_by(q, wide(direction) - D3{0, 0, 1});
    REQUIRE(length(asked - 0.25 / 0.5 * apart) <= 60 * u * (1 + length(apart)));
  }
}

TEST_CASE("a row has the energies of segments and joints, each joint once, whatever the signs", "[property]") {
  Drawn drawn{std::mt19937(94)};
  for (int i = 0; i < 1000; ++i) {
    const std::array<Vec, 3> x{drawn.vector(), drawn.vector(), drawn.vector()};
    const std::array<SegmentRest, 2> rest{SegmentRest{{0, 1}, 0.5f, 3, 0}, SegmentRest{{1, 2}, 0.25f, 2, 0}};
    const Quat p = drawn.orientation();
    std::array<Quat, 2> q{drawn.orientation(), drawn.orientation()};
    const float w = 0.7f;
    std::array<SegmentNeighbours, 2> neighbours;
    neighbours[0].rest[1] = {w, p}, neighbours[0].number[1] = 1;
    neighbours[1].rest[0] = {w, p}, neighbours[1].number[0] = 0;
    std::array<double, sum_columns> sums{};
    const SegmentTerm term{rest.data(), neighbours.data(), x.data(), q.data()};
    const std::array<float, 2> ratios{term(0, sums.data()), term(1, sums.data())};
    double energy = 0, stretched = 0;
    for (std::size_t e = 0; e < 2; ++e) {
      const double l = rest[e].length;
      const D3 apart = 1 / l * (wide(x[e + 1]) - wide(x[e])), strain = apart - turned_by(q[e], {0, 0, 1});
      energy += 0.5 * rest[e].stretch * l * dot(strain, strain);
      stretched += length(apart) - 1;
      CHECK(ratios[e] == Approx(length(apart)).epsilon(8 * u));
    }
    // A joint has the energy w/2 ‖q̄₀ q₁ − p‖², with w = 4 k_b/l̄. The sign of p is the one that gives the smaller
    // energy.
    const Quat relative = conjugate(q[0]) * q[1];
    const double apart = std::min(size(relative - p), size(relative + p));
    energy += 0.5 * w * apart * apart;
    REQUIRE(sums[sum_rod] == Approx(energy).epsilon(1e-5));
    REQUIRE(sums[sum_stretch] == Approx(stretched).epsilon(1e-6).margin(1e-6));
    q[1] = -1.0f * q[1];
    std::array<double, sum_columns> flipped{};
    term(0, flipped.data()), term(1, flipped.data());
    REQUIRE(flipped[sum_rod] == Approx(sums[sum_rod]).epsilon(1e-12));
  }
}

TEST_CASE("of a segment that is not finite a row has no length", "[unit]") {
  const SegmentRest rest{{0, 1}, 0.5f, 3, 0};
  const SegmentNeighbours none;
  const Quat q;
  std::array<double, sum_columns> sums{};
  for (const float far : {INFINITY, NAN}) {
    const std::array<Vec, 2> x{Vec{0, 0, 0}, Vec{far, 0, 0}};
    CHECK(SegmentTerm{&rest, &none, x.data(), &q}(0, sums.data()) == 0);
  }
}

TEST_CASE("a contact has a distance where it acts, at the positions of the row", "[unit]") {
  const std::array<Vec, 4> previous{Vec{-1, 0, 0}, Vec{1, 0, 0}, Vec{0, 0.5f, -1}, Vec{0, 0.5f, 1}};
  std::array<Vec, 4> position = previous;
  position[2].y = position[3].y = 0.25f;
  const std::array<int, 4> body{0, 0, 0, 0};
  const std::array<float, 2> rest_squared{0, 0};
  ContactMaterial material{};
  EdgeEdgeRecord record{};
  record.first[0] = 0, record.first[1] = 1, record.second[0] = 2, record.second[1] = 3;
  record.first_edge = 0, record.second_edge = 1;
  const auto distance = [&](float stiffness, float radius) {
    material.stiffness = stiffness;
    const ContactTables tables{body.data(), &material, 1, rest_squared.data(), previous.data()};
    return ActiveDistance<EdgeEdgeRecord>{&record, tables, position.data(), radius}(0);
  };
  CHECK(distance(222, 0.3f) == Approx(0.25).epsilon(8 * u));
  CHECK(distance(222, 0.2f) > 1e38f);  // beyond r
  CHECK(distance(0, 0.3f) > 1e38f);    // without stiffness
}

TEST_CASE("the published frame is (μ + M) b with μ = σ + ‖b‖, of unit length", "[property]") {
  Drawn drawn{std::mt19937(95)};
  for (int i = 0; i < 1000; ++i) {
    const float stretch = 0.4f;
    const Vec apart = drawn.vector(), direction = drawn.vector();
    const Quat b = 0.3f * drawn.orientation(), old = drawn.orientation();
    const Quat found = published_orientation(stretch, apart, direction, b, old);
    const double sigma = 2 * double{stretch} * length(apart) * length(direction), mu = sigma + size(b);
    // M b = −2 k_s D b c
    const Quat reflected = -2 * stretch * (pure(apart) * b * pure(direction));
    std::array<double, 4> wanted{mu * b.x + reflected.x, mu * b.y + reflected.y, mu * b.z + reflected.z,
                                 mu * b.w + reflected.w};
    double norm = 0;
    for (const double part : wanted) norm += part * part;
    norm = std::sqrt(norm);
    const std::array<double, 4> got{found.x, found.y, found.z, found.w};
    for (std::size_t k = 0; k < 4; ++k)
      REQUIRE(got[k] == Approx(wanted[k] / norm).margin(64 * u * (mu + sigma) * size(b) / norm));
  }
}
