#include "compare/oracle/certificate.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

MotionCertificate of_one(Vec3f position, Vec3f previous, float bound) {
  return motion_certificate(std::array{position}, std::array{previous}, std::array{bound});
}

bool exceeds_in_rationals(const Vec3f& x, const Vec3f& p, float b) {
  using Rational = boost::multiprecision::cpp_rational;
  const Rational dx = Rational(x.x) - Rational(p.x), dy = Rational(x.y) - Rational(p.y),
                 dz = Rational(x.z) - Rational(p.z);
  return dx * dx + dy * dy + dz * dz > Rational(b) * Rational(b);
}

}  // namespace

TEST_CASE("a vertex exactly at its bound keeps it, one unit in the last place further breaks it", "[unit]") {
  CHECK(of_one({3, 4, 0}, {0, 0, 0}, 5).kept());  // 3² + 4² = 5²
  CHECK(of_one({3, 4, 0}, {0, 0, 0}, 5).worst_ratio == 1);
  CHECK_FALSE(of_one({3, 4, 0}, {0, 0, 0}, std::nextafter(5.0f, 0.0f)).kept());
  CHECK_FALSE(of_one({3, std::nextafter(4.0f, 5.0f), 0}, {0, 0, 0}, 5).kept());
}

TEST_CASE("an excess that double rounds away is found", "[unit]") {
  const Vec3f x{1, 0x1p-60f, 0};  // 1 + 2⁻¹²⁰ > 1
  CHECK(double{x.x} * double{x.x} + double{x.y} * double{x.y} == 1.0);
  CHECK(of_one(x, {0, 0, 0}, 1).violations == 1);
  CHECK(of_one({0x1p30f, 0, 0}, {0x1p-40f, 0, 0}, 0x1p30f).kept());  // 2³⁰ − 2⁻⁴⁰ rounds to the bound
  CHECK_FALSE(of_one({0x1p30f, 0, 0}, {-0x1p-40f, 0, 0}, 0x1p30f).kept());
}

TEST_CASE("vertices that rest, with bound zero, without a number", "[unit]") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const MotionCertificate rest = of_one({1, 2, 3}, {1, 2, 3}, 0);
  CHECK(rest.kept());
  CHECK(rest.worst_vertex == -1);
  CHECK(of_one({1, 0, 0}, {0, 0, 0}, 0).worst_ratio == infinity);
  CHECK_FALSE(of_one({0x1p-149f, 0, 0}, {0, 0, 0}, 0).kept());  // the smallest possible motion
  CHECK_FALSE(of_one({nan, 0, 0}, {0, 0, 0}, 1).kept());
  CHECK_FALSE(of_one({infinity, 0, 0}, {infinity, 0, 0}, 1).kept());
  CHECK_FALSE(of_one({0, 0, 0}, {0, 0, 0}, nan).kept());
  CHECK_FALSE(of_one({0, 0, 0}, {0, 0, 0}, -1).kept());
  CHECK(motion_certificate({}, {}, {}).kept());
  CHECK_THROWS_AS(motion_certificate(std::array<Vec3f, 2>{}, std::array<Vec3f, 1>{}, std::array<float, 2>{}),
                  InputError);
}

TEST_CASE("the certificate counts, and names the vertex of the largest ratio", "[unit]") {
  const std::array<Vec3f, 4> previous{}, positions{Vec3f{1, 0, 0}, Vec3f{0, 3, 0}, Vec3f{0, 0, 3}, Vec3f{0.5f, 0, 0}};
  const MotionCertificate certificate = motion_certificate(positions, previous, std::array{1.0f, 2.0f, 2.0f, 1.0f});
  CHECK(certificate.violations == 2);
  CHECK(certificate.worst_vertex == 1);
  CHECK(certificate.worst_ratio == 1.5);
}

TEST_CASE("the certificate decides as rational arithmetic does, at and around the bound", "[property]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 20);
  std::array<int, 2> seen{};
  for (int trial = 0; trial < 4000; ++trial) {
    const auto scaled = [&] { return std::ldexp(coordinate(random), exponent(random)); };
    const auto point = [&] { return Vec3f{scaled(), coordinate(random), scaled()}; };
    const Vec3f x = point(), p = point();
    const double length = std::hypot(double{x.x} - double{p.x}, double{x.y} - double{p.y}, double{x.z} - double{p.z});
    const auto nearest = static_cast<float>(length);
    for (const float b : {nearest, std::nextafter(nearest, 0.0f), std::nextafter(nearest, 1e30f)}) {
      const bool expected = exceeds_in_rationals(x, p, b);
      ++seen[expected];
      REQUIRE(of_one(x, p, b).kept() == !expected);
    }
  }
  CHECK(seen[0] > 1000);
  CHECK(seen[1] > 1000);
}
