#include "reference/solvers/symmetric3.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using ogc::reference::Eigen3;
using ogc::reference::Symmetric3;

namespace {

double entry(const Eigen3& e, double ogc::compare::Vec3::*row, double ogc::compare::Vec3::*column) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += e.value[i] * e.axis[i].*row * (e.axis[i].*column);
  return sum;
}

}  // namespace

TEST_CASE("eigenvectors are orthonormal and give the matrix back, over ratios up to 10¹²", "[property]") {
  using ogc::compare::Vec3;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1), exponent(-6, 6);
  for (int i = 0; i < 2000; ++i) {
    Symmetric3 a;
    for (double& x : a) x = i % 3 == 0 ? std::round(2 * unit(random)) : unit(random) * std::pow(10.0, exponent(random));
    const Eigen3 e = ogc::reference::eigen_of(a);
    const double error = 1e-14 * ogc::reference::norm(a);
    const std::array<std::array<double Vec3::*, 2>, 6> places{{{&Vec3::x, &Vec3::x},
                                                               {&Vec3::x, &Vec3::y},
                                                               {&Vec3::x, &Vec3::z},
                                                               {&Vec3::y, &Vec3::y},
                                                               {&Vec3::y, &Vec3::z},
                                                               {&Vec3::z, &Vec3::z}}};
    for (std::size_t k = 0; k < 6; ++k) REQUIRE(std::abs(entry(e, places[k][0], places[k][1]) - a[k]) <= error);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l)
        REQUIRE(e.axis[k].x * e.axis[l].x + e.axis[k].y * e.axis[l].y + e.axis[k].z * e.axis[l].z ==
                Approx(k == l ? 1 : 0).margin(1e-14));
  }
}

TEST_CASE("the norm counts entries off the diagonal twice", "[unit]") {
  CHECK(ogc::reference::norm(Symmetric3{1, 0, 0, 0, 0, 0}) == 1);
  CHECK(ogc::reference::norm(Symmetric3{0, 1, 0, 0, 0, 0}) == Approx(std::sqrt(2.0)));
  CHECK(ogc::reference::norm(Symmetric3{1, 2, 3, 4, 5, 6}) == Approx(std::sqrt(1 + 16 + 36 + 2 * (4 + 9 + 25.0))));
}
