// Tests that segments updated in packs have the bits of single updates, in each case of UpdateSegment.
#include <bit>
#include <cstring>
#include <random>
#include <vector>

#include "fast/cpu/pack_kernels.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// Holds the segments of one colour, so no segment is a neighbour of another. spoil() makes a third of them unusual.
struct Colour {
  static constexpr int count = 43;
  std::mt19937 random;
  std::vector<PaddedVec> positions{4 * count};
  std::vector<Quat> q{3 * count}, start{3 * count};
  std::vector<Vec> direction{3 * count};
  std::vector<SegmentSlot> slots{count};
  StepControl control;
  SweepView view;

  explicit Colour(unsigned seed) : random(seed) {
    for (Quat& each : q) each = orientation();
    for (Quat& each : start) each = orientation();
    for (Vec& each : direction) each = vector();
    for (PaddedVec& each : positions) each = PaddedVec(vector());
    for (int k = 0; k < count; ++k) {
      SegmentSlot& slot = slots[static_cast<std::size_t>(k)];
      slot.rest = {{random() % 2 == 0 ? 2 * k : ~(2 * k), 2 * k + 1}, 0.5F, stretch(), 0};
      slot.segment = k;
      for (int side = 0; side < 2; ++side) {
        slot.neighbours.number[side] = (1 + side) * count + k;
        slot.neighbours.rest[side] = {random() % 6 == 0 ? 0.0F : 1.1F, orientation()};
      }
      spoil(k);
    }
    view.old = positions.data();
    view.to_fresh = 2 * count;
    view.control = &control;
    view.rods.slots = slots.data();
    view.rods.orientation = q.data();
    view.rods.orientation_start = start.data();
  }

  Quat orientation() { return unit(Quat{normal(), normal(), normal(), normal()}); }
  Vec vector() { return {normal(), normal(), normal()}; }
  float normal() { return std::normal_distribution<float>()(random); }
  float stretch() { return std::array{1e-3F, 1.0F, 1e4F}[random() % 3]; }

  /// Makes a segment unusual: without neighbour, without length, with neighbours that pull towards a reversed director,
  /// or with a NaN.
  void spoil(int k) {
    SegmentSlot& slot = slots[static_cast<std::size_t>(k)];
    const auto first = static_cast<std::size_t>(2 * k);
    switch (random() % 12) {
      case 0: slot.neighbours.rest[0].weight = slot.neighbours.rest[1].weight = 0; break;
      case 1:
        for (const std::size_t half : {std::size_t{0}, std::size_t{2} * count})
          positions[first + half] = positions[first + 1];
        break;
      case 2:
        slot.neighbours.rest[0].weight = 0;
        slot.neighbours.rest[1].rest = {};
        q[static_cast<std::size_t>(slot.neighbours.number[1])] = {1, 0, 0, 0};
        for (const std::size_t half : {std::size_t{0}, std::size_t{2} * count})
          positions[first + half] = PaddedVec(Vec{0, 0, 0}), positions[first + 1 + half] = PaddedVec(Vec{0, 0, 1});
        break;
      case 3: positions[first + 1].x = __builtin_huge_valf(); break;
      default: break;
    }
  }

  /// Returns the quaternions after an update, the counter of numbers that are not finite, and the quaternions before.
  template <class Update>
  std::vector<std::uint32_t> after(Update update) {
    const std::vector<Quat> before = q;
    control.not_finite = 0;
    update(UpdateSegment{view, 0});
    std::vector<std::uint32_t> bits(4 * q.size() + 1);
    std::memcpy(bits.data(), q.data(), q.size() * sizeof(Quat));
    bits.back() = static_cast<std::uint32_t>(control.not_finite);
    q = before;
    view.rods.orientation = q.data();
    return bits;
  }
};

}  // namespace

TEST_CASE("segments in packs have the bits of segments one by one, in every case and on every machine", "[property]") {
  std::vector<const PackKernels*> machines{&pack_kernels_baseline};
  if (has_avx2()) machines.push_back(&pack_kernels_avx2);
  int other = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Colour colour(seed);
    if (seed % 5 == 0) colour.view.rods.as_published = true;
    if (seed % 7 == 0) {
      colour.view.rods.direction = colour.direction.data();
      for (SegmentSlot& slot : colour.slots) slot.rest.damping = 0.25F;
    }
    const auto expected = colour.after([](const UpdateSegment& f) {
      for (int k = 0; k < Colour::count; ++k) f(k);
    });
    other += static_cast<int>(expected.back());
    for (const PackKernels* machine : machines)
      REQUIRE(colour.after([&](const UpdateSegment& f) {
        machine->update_segments(f, 0, 5);
        machine->update_segments(f, 5, Colour::count);
      }) == expected);
  }
  CHECK(other > 0);
}

TEST_CASE("segments in packs stay where it is another iteration's turn", "[unit]") {
  Colour colour(1);
  const std::vector<Quat> before = colour.q;
  const int turn = 1;
  colour.view.turn = &turn;
  run_range(UpdateSegment{colour.view, 0}, 0, Colour::count);
  CHECK(std::memcmp(before.data(), colour.q.data(), before.size() * sizeof(Quat)) == 0);
}
