#include "fast/cpu/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <tuple>
#include <type_traits>

#include "fast/kernels/arithmetic/arctangent.hpp"
#include "fast/kernels/separation.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// The pack types to test: both widths if this file is compiled for AVX2, otherwise one.
using Packs = std::conditional_t<Pack::width == WidePack::width, std::tuple<Pack>, std::tuple<Pack, WidePack>>;

template <class P>
using Floats = std::array<float, P::width>;

template <class P>
Floats<P> floats(const P& a) {
  Floats<P> out;
  a.store(out.data());
  return out;
}

template <class P>
P pack(const Floats<P>& a) {
  return P::of_each([&a](int k) { return a[static_cast<std::size_t>(k)]; });
}

/// Returns whether the bits are the same, or both are NaN. If both operands of an operation are NaN, the result depends
/// on their order, which the compiler may choose.
bool alike(float a, float b) { return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0; }

/// Counts the cases in which f of packs differs from f of single numbers. Numbers are of every size, zeros of both
/// signs, infinities and NaN.
template <class P, class F>
int differences(F f) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  constexpr float special[] = {
      0.0F, -0.0F, 1e-40F, -1e38F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
      1.0F};
  const auto number = [&] {
    return random() % 8 == 0 ? special[random() % 7] : std::ldexp(normal(random), static_cast<int>(random() % 80) - 40);
  };
  int wrong = 0;
  for (int k = 0; k < 20000; ++k) {
    Floats<P> a, b;
    for (float& x : a) x = number();
    for (float& x : b) x = number();
    const Floats<P> got = floats(P(f(pack<P>(a), pack<P>(b))));
    for (std::size_t i = 0; i < got.size(); ++i) wrong += alike(got[i], f(a[i], b[i])) ? 0 : 1;
  }
  return wrong;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("every operation on a pack gives the bits of the same operation on each of its numbers",
                        "[property]", Packs) {
  CHECK(differences<TestType>([](auto a, auto b) { return a + b; }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return a - b; }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return a * b; }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return a / b; }) == 0);
  CHECK(differences<TestType>([](auto a, auto) { return -a; }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return add(a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return smaller(a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return larger(a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto) { return root(a); }) == 0);
  CHECK(differences<TestType>([](auto a, auto) { return absolute(a); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return select(a > b, a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return select(!(a < b), a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return select(a > b || b > 1.0F, a, b); }) == 0);
  CHECK(differences<TestType>([](auto a, auto b) { return select(a > b && b > 1.0F, a, b); }) == 0);
}

TEMPLATE_LIST_TEST_CASE("the kernels' arctangent of a pack has the bits of each", "[property]", Packs) {
  CHECK(differences<TestType>([](auto a, auto b) { return arctangent2(a, b); }) == 0);
}

TEMPLATE_LIST_TEST_CASE("a number everywhere in a pack keeps its bits", "[property]", Packs) {
  for (const float number : {0.0F, -0.0F, 1e-45F, -1.5F, std::numeric_limits<float>::infinity()}) {
    for (const float at : floats(TestType(number))) CHECK(alike(at, number));
  }
}

TEMPLATE_LIST_TEST_CASE("a mask is false only where none of its lanes is true, and counts from the first lane",
                        "[property]", Packs) {
  for (int count = 0; count <= TestType::width + 1; ++count) {
    const auto mask = first_of<TestType>(count);
    const auto got = floats(select(mask, TestType{1.0F}, TestType{}));
    for (int i = 0; i < TestType::width; ++i) CHECK(got[static_cast<std::size_t>(i)] == (i < count ? 1.0F : 0.0F));
    CHECK(is_false(mask) == (count == 0));
    CHECK(true_lanes(mask) == (1U << std::min(count, TestType::width)) - 1U);
  }
}

TEMPLATE_LIST_TEST_CASE("positions make three packs, coordinate by coordinate", "[property]", Packs) {
  constexpr std::size_t width = TestType::width;
  std::array<PaddedVec, width> place;
  std::array<const PaddedVec*, width> at;
  for (std::size_t k = 0; k < width; ++k) {
    const float first = 3 * static_cast<float>(k);
    place[k] = PaddedVec({first, first + 1, first + 2});
    at[k] = &place[k];
  }
  const Vector<TestType> all = transposed<TestType>(at.data());
  for (std::size_t k = 0; k < width; ++k) {
    CHECK(floats(all.x)[k] == place[k].x);
    CHECK(floats(all.y)[k] == place[k].y);
    CHECK(floats(all.z)[k] == place[k].z);
  }
}

TEST_CASE("the lower bounds of distances of four pairs at a time have the bits of each", "[property]") {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  const auto point = [&](float size) {
    return Vec{size * normal(random), size * normal(random), size * normal(random)};
  };
  const auto packed = [](const Vec* p) {
    const auto each = [p](float Vec::*axis) { return Pack::of_each([&](int k) { return p[k].*axis; }); };
    return Vector<Pack>{each(&Vec::x), each(&Vec::y), each(&Vec::z)};
  };
  int wrong = 0;
  for (int k = 0; k < 20000; ++k) {
    Vec p[4][4];  // [point][pair]
    const float size = std::ldexp(1.0F, -static_cast<int>(random() % 20));
    for (auto& of_pairs : p)
      // some points coincide
      for (Vec& x : of_pairs) x = random() % 16 == 0 ? p[0][0] : point(random() % 4 == 0 ? 1.0F : size);
    const auto edges = floats(
        separation(EndsOf<Pack>{packed(p[0]), packed(p[1])}, EndsOf<Pack>{packed(p[2]), packed(p[3])}));
    const auto corners = floats(separation(packed(p[0]), CornersOf<Pack>{packed(p[1]), packed(p[2]), packed(p[3])}));
    for (std::size_t i = 0; i < 4; ++i) {
      wrong += alike(edges[i], separation(Ends{p[0][i], p[1][i]}, Ends{p[2][i], p[3][i]})) ? 0 : 1;
      wrong += alike(corners[i], separation(p[0][i], Corners{p[1][i], p[2][i], p[3][i]})) ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}
