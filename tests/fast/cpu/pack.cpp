#include "fast/cpu/pack.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "fast/kernels/arctangent.hpp"
#include "fast/kernels/bending.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

using Floats = std::array<float, 4>;

Floats floats(Pack a) {
  Floats out;
  _mm_storeu_ps(out.data(), a.value);
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
