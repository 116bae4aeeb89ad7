#include "fast/cpu/pack.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "fast/kernels/arctangent.hpp"
#include "fast/kernels/separation.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

using Floats = std::array<float, 4>;

Floats floats(Pack a) {
  Floats out;
  a.store(out.data());
  return out;
}

Pack pack(const Floats& a) { return {a[0], a[1], a[2], a[3]}; }

/// The same bits, or both not a number: of two NaN operands a processor keeps the first, and which that is a compiler may choose.
bool alike(float a, float b) { return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0; }

/// f of packs against f of each place, for numbers of every size, zeros of both signs, infinities and NaN.
template <class F>
int differences(F f) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  constexpr float special[] = {0.0F, -0.0F, 1e-40F, -1e38F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1.0F};
  const auto number = [&] { return random() % 8 == 0 ? special[random() % 7] : std::ldexp(normal(random), static_cast<int>(random() % 80) - 40); };
  int wrong = 0;
  for (int k = 0; k < 20000; ++k) {
    Floats a, b;
    for (float& x : a) x = number();
    for (float& x : b) x = number();
    const Floats got = floats(f(pack(a), pack(b)));
    for (std::size_t i = 0; i < 4; ++i) wrong += alike(got[i], f(a[i], b[i])) ? 0 : 1;
  }
  return wrong;
}

}  // namespace

TEST_CASE("every operation on a pack gives the bits of the same operation on each of its numbers", "[property]") {
  CHECK(differences([](auto a, auto b) { return a + b; }) == 0);
  CHECK(differences([](auto a, auto b) { return a - b; }) == 0);
  CHECK(differences([](auto a, auto b) { return a * b; }) == 0);
  CHECK(differences([](auto a, auto b) { return a / b; }) == 0);
  CHECK(differences([](auto a, auto) { return -a; }) == 0);
  CHECK(differences([](auto a, auto b) { return add(a, b); }) == 0);
  CHECK(differences([](auto a, auto b) { return smaller(a, b); }) == 0);
  CHECK(differences([](auto a, auto b) { return larger(a, b); }) == 0);
  CHECK(differences([](auto a, auto) { return root(a); }) == 0);
  CHECK(differences([](auto a, auto) { return absolute(a); }) == 0);
  CHECK(differences([](auto a, auto b) { return select(a > b, a, b); }) == 0);
  CHECK(differences([](auto a, auto b) { return select(!(a < b), a, b); }) == 0);
  CHECK(differences([](auto a, auto b) { return select(a > b || b > 1.0F, a, b); }) == 0);
  CHECK(differences([](auto a, auto b) { return select(a > b && b > 1.0F, a, b); }) == 0);
}

TEST_CASE("the kernels' arctangent of a pack has the bits of each", "[property]") {
  CHECK(differences([](auto a, auto b) { return arctangent2(a, b); }) == 0);
}

TEST_CASE("a mask is false only where none of its places is true, and counts from the first place") {
  for (int count = 0; count <= 5; ++count) {
    const Floats got = floats(select(first_of(count), Pack{1.0F}, Pack{}));
    for (int i = 0; i < 4; ++i) CHECK(got[static_cast<std::size_t>(i)] == (i < count ? 1.0F : 0.0F));
    CHECK(is_false(first_of(count)) == (count == 0));
  }
}

TEST_CASE("four places make three packs, coordinate by coordinate") {
  const Place place[4] = {Place({1, 2, 3}), Place({4, 5, 6}), Place({7, 8, 9}), Place({10, 11, 12})};
  const Vector<Pack> all = transposed(place[0], place[1], place[2], place[3]);
  CHECK(floats(all.x) == Floats{1, 4, 7, 10});
  CHECK(floats(all.y) == Floats{2, 5, 8, 11});
  CHECK(floats(all.z) == Floats{3, 6, 9, 12});
}

TEST_CASE("the lower bounds of distances of four pairs at a time have the bits of each", "[property]") {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  const auto point = [&](float size) { return Vec{size * normal(random), size * normal(random), size * normal(random)}; };
  const auto packed = [](const Vec* p) { return Vector<Pack>{{p[0].x, p[1].x, p[2].x, p[3].x}, {p[0].y, p[1].y, p[2].y, p[3].y}, {p[0].z, p[1].z, p[2].z, p[3].z}}; };
  int wrong = 0;
  for (int k = 0; k < 20000; ++k) {
    Vec p[4][4];  // [which point][pair]
    const float size = std::ldexp(1.0F, -static_cast<int>(random() % 20));
    for (auto& of_pairs : p)
      for (Vec& x : of_pairs) x = random() % 16 == 0 ? p[0][0] : point(random() % 4 == 0 ? 1.0F : size);  // some coincide
    const Floats edges = floats(separation(EndsOf<Pack>{packed(p[0]), packed(p[1])}, EndsOf<Pack>{packed(p[2]), packed(p[3])}));
    const Floats corners = floats(separation(packed(p[0]), CornersOf<Pack>{packed(p[1]), packed(p[2]), packed(p[3])}));
    for (std::size_t i = 0; i < 4; ++i) {
      wrong += alike(edges[i], separation(Ends{p[0][i], p[1][i]}, Ends{p[2][i], p[3][i]})) ? 0 : 1;
      wrong += alike(corners[i], separation(p[0][i], Corners{p[1][i], p[2][i], p[3][i]})) ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}
