// Tests which data of rods a sweep reads: which end, which neighbour, which of two buffers, which damping.
// tests/fast/kernels/models/rod.cpp tests the formulas.
#include "fast/kernels/sweep/update_segment.hpp"

#include <array>
#include <random>

#include "tests/catch.hpp"
#include "tests/fast/numeric.hpp"

using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

bool same(const Quat& a, const Quat& b) { return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w; }

/// Holds a chain of four vertices and three segments, and a sweep over the middle segment, whose first end has moved
/// already. All numbers are different.
struct Chain {
  static constexpr int vertices = 4;
  std::mt19937 random;
  std::array<PaddedVec, 2 * vertices> positions;
  std::array<Vec, 3> direction;
  std::array<Quat, 3> q, start;
  SegmentSlot slot;
  StepControl control;
  SweepView view;

  explicit Chain(unsigned seed) : random(seed) {
    for (PaddedVec& x : positions) x = PaddedVec(vector());
    for (Vec& c : direction) c = vector();
    for (Quat& each : q) each = orientation();
    for (Quat& each : start) each = orientation();
    slot.rest = {{~1, 2}, 0.5f, 3, 0.25f};
    slot.segment = 1;
    slot.neighbours.rest[0] = {0.7f, orientation()};
    slot.neighbours.rest[1] = {1.1f, orientation()};
    slot.neighbours.number[0] = 0, slot.neighbours.number[1] = 2;
    view.old = positions.data();
    view.to_fresh = vertices;
    view.control = &control;
    view.rods.slots = &slot;
    view.rods.orientation = q.data();
    view.rods.orientation_start = start.data();
    view.rods.direction = direction.data();
  }

  Quat orientation() {
    std::normal_distribution<float> normal;
    return unit(Quat{normal(random), normal(random), normal(random), normal(random)});
  }
  Vec vector() {
    std::normal_distribution<float> normal;
    return {normal(random), normal(random), normal(random)};
  }

  Vec at(int place) const {
    const PaddedVec& x = positions[static_cast<std::size_t>(place)];
    return {x.x, x.y, x.z};
  }
  /// Returns D of the middle segment, from its first end, which has moved, to its second end, which has not.
  Vec apart() const { return at(2) - at(vertices + 1); }
  /// Returns b, the sum of the pulls of the middle segment's neighbours.
  Quat pull(float damping) const {
    Quat b{0, 0, 0, 0};
    add_neighbour(slot.neighbours.rest[0], false, damping, q[0], start[0], start[1], q[1], b);
    add_neighbour(slot.neighbours.rest[1], true, damping, q[2], start[2], start[1], q[1], b);
    return b;
  }
};

}  // namespace

TEST_CASE("a segment is set from its ends and neighbours, with its own damping", "[property]") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Chain chain(seed);
    const Quat damped = rod_orientation(3, chain.apart(), chain.direction[1], chain.pull(0.25f), chain.q[1]);
    const Quat free = rod_orientation(3, chain.apart(), {0, 0, 1}, chain.pull(0), chain.q[1]);
    const Quat published = published_orientation(3, chain.apart(), chain.direction[1], chain.pull(0.25f), chain.q[1]);
    const std::array<Quat, 3> before = chain.q;
    const auto set = [&] {
      chain.q = before;
      UpdateSegment{chain.view, 0}(0);
      REQUIRE(same(chain.q[0], before[0]));
      REQUIRE(same(chain.q[2], before[2]));
      return chain.q[1];
    };
    REQUIRE(same(set(), damped));
    chain.view.rods.as_published = true;
    REQUIRE(same(set(), published));
    chain.view.rods.as_published = false;
    chain.view.rods.is_damped_by_vertex = true;  // strains are damped by vertex and frames are not damped
    chain.view.rods.direction = nullptr;
    REQUIRE(same(set(), free));
    REQUIRE(chain.control.not_finite == 0);
  }
}

TEST_CASE("a segment stays where it is another iteration's turn, or no number comes of it", "[unit]") {
  Chain chain(1);
  const Quat before = chain.q[1];
  const int turn = 1;
  chain.view.turn = &turn;
  for (const bool asks_late : {false, true}) {
    UpdateSegment{chain.view, 0, asks_late}(0);
    CHECK(same(chain.q[1], before));
  }
  chain.view.turn = nullptr;
  chain.positions[2] = PaddedVec(Vec{INFINITY, 0, 0});
  UpdateSegment{chain.view, 0}(0);
  CHECK(same(chain.q[1], before));
  CHECK(chain.control.not_finite == 1);
}

TEST_CASE("a vertex feels its segments by the end that it is, damped as its body is", "[property]") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Chain chain(seed);
    const Vec own = chain.vector(), moved = chain.vector(), other = chain.at(Chain::vertices + 3);
    const SegmentRest rest{{}, 0.5f, 3, 0};
    for (const int end : {0, 1}) {
      const RodIncidence seen{~3, end == 0 ? 1 : ~1, 0.5f, 3};
      const Vec apart = end == 0 ? other - own : own - other;
      const auto felt = [&] {
        ForceAndBlock sum;
        AddRod{chain.view, chain.view.rods, {own, moved}, 0.25f}(seen, sum);
        return sum;
      };
      ForceAndBlock strain, elastic;
      add_rod(rest, 0.25f, end, apart, chain.q[1], chain.direction[1], strain);
      chain.view.rods.is_damped_by_vertex = false;
      REQUIRE(length(felt().force - strain.force) == 0);
      REQUIRE(felt().block.xx == strain.block.xx);
      add_rod(rest, 0, end, apart, chain.q[1], chain.direction[1], elastic);
      chain.view.rods.is_damped_by_vertex = true;
      // Damping by vertex adds the force −k B `moved`, with the elastic block B = (k_s/l) I. The error comes from a
      // difference and two products.
      const double size = length(elastic.force) + 0.25 * 3 / 0.5 * length(moved);
      REQUIRE(length(felt().force - (elastic.force - 0.25f * 3 / 0.5f * moved)) <= 4 * 0x1p-24 * size);
      REQUIRE(felt().block.xx == Approx(3 * 1.25 / 0.5));
    }
  }
}
