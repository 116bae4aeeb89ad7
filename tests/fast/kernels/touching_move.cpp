#include "fast/kernels/touching_move.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// Holds a vertex at distance 0.5 above the middle of a triangle, and the targets of all four vertices.
struct Touching {
  Vec position[4] = {{0.25f, 0.5f, 0.25f}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  Vec target[4] = {{0.25f, 0.5f, 0.25f}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  Vec taken[4];
  int offsets[5] = {0, 1, 2, 2, 2};
  ContactIncidence contacts[2];

  explicit Touching(float friction) {
    for (ContactIncidence& contact : contacts)
      contact = {.index = {0, 1, 2, 3}, .stiffness = 1, .friction = friction, .kind = ContactKind::point_triangle};
    contacts[1].own = 1;
  }

  Vec held(int v, const Vec& move) {
    target[v] = position[v] + move;
    return held_move({offsets, contacts, position, target, taken, 1}, v, move);
  }
  void move_partner(const Vec& by) {
    for (int k = 1; k < 4; ++k) target[k] = position[k] + by;
  }
};

void check(const Vec& found, const Vec& expected) {
  CAPTURE(found.x, found.y, found.z, expected.x, expected.y, expected.z);
  CHECK(std::hypot(found.x - expected.x, found.y - expected.y, found.z - expected.z) < 1e-6);
}

}  // namespace

TEST_CASE("what contacts leave: without friction an approach is taken whole, the way along the partner stays",
          "[unit]") {
  Touching touching(0);
  check(touching.held(0, {0.3f, -0.2f, 0.1f}), {0.3f, 0, 0.1f});
  check(touching.held(0, {0.3f, 0.2f, 0.1f}), {0.3f, 0.2f, 0.1f});
}

TEST_CASE("what contacts leave: friction takes at most μ times the approach from the slip, and never turns it",
          "[unit]") {
  Touching touching(0.5f);
  check(touching.held(0, {0.3f, -0.2f, 0}), {0.2f, 0, 0});
  check(touching.held(0, {0.05f, -0.2f, 0}), {0, 0, 0});
  check(touching.held(0, {0.3f, 0, 0}), {0.3f, 0, 0});
}

TEST_CASE("what contacts leave: a partner that makes room is followed, one that comes near is not fled from",
          "[unit]") {
  Touching touching(0);
  touching.move_partner({0, -0.125f, 0});
  check(touching.held(0, {0, -0.125f, 0}), {0, -0.125f, 0});
  check(touching.held(0, {0, -0.25f, 0}), {0, -0.125f, 0});
  touching.move_partner({0, 0.125f, 0});
  check(touching.held(0, {0, -0.25f, 0}), {0, 0, 0});
  check(touching.held(0, {0, 0.01f, 0}), {0, 0.01f, 0});
}

TEST_CASE("what contacts leave: a partner carries, and what was taken from it before counts", "[unit]") {
  Touching touching(1);
  touching.move_partner({0.25f, 0, 0});
  check(touching.held(0, {0, -0.5f, 0}), {0.25f, 0, 0});
  touching.move_partner({0, -0.25f, 0});
  for (int k = 1; k < 4; ++k) touching.taken[k] = {0, 0.25f, 0};
  check(touching.held(0, {0, -0.25f, 0}), {0, 0, 0});
}

TEST_CASE("what contacts leave: a corner is held by its own share", "[unit]") {
  Touching touching(0);  // weights 1/2, 1/4, 1/4
  check(touching.held(1, {0, 0.2f, 0}), {0, 0, 0});
  touching.target[0] = touching.position[0] + Vec{0, 0.05f, 0};
  check(touching.held(1, {0, 0.2f, 0}), {0, 0.1f, 0});
}

TEST_CASE("what contacts leave: beyond r nothing is held, and no move grows", "[property]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  const auto vector = [&] { return Vec{any(random), any(random), any(random)}; };
  int shorter = 0;
  for (int i = 0; i < 2000; ++i) {
    Touching touching(std::abs(any(random)));
    touching.position[0] = {0.25f + 0.1f * any(random), 2 * std::abs(any(random)), 0.25f + 0.1f * any(random)};
    const Vec move = vector(), held = touching.held(0, move);
    if (touching.position[0].y > 1.001f) check(held, move);
    CHECK(dot(held, held) <= dot(move, move) * 1.00001f);
    shorter += dot(held, held) < 0.999f * dot(move, move) ? 1 : 0;
  }
  CHECK(shorter > 200);
}
