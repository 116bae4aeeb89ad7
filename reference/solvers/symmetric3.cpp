#include "reference/solvers/symmetric3.hpp"

#include <cmath>
#include <cstddef>

namespace ogc::reference {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Rotates rows and columns p and q so that a[p][q] becomes 0, and the columns of `axes` with them.
void annihilate(Matrix& a, Matrix& axes, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double ratio = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double tangent = (ratio < 0 ? -1 : 1) / (std::abs(ratio) + std::hypot(1.0, ratio)),
               cosine = 1 / std::hypot(1.0, tangent), sine = tangent * cosine;
  for (std::size_t k = 0; k < 3; ++k) {
    const double first = a[k][p], second = a[k][q];
    a[k][p] = cosine * first - sine * second;
    a[k][q] = sine * first + cosine * second;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double first = a[p][k], second = a[q][k];
    a[p][k] = cosine * first - sine * second;
    a[q][k] = sine * first + cosine * second;
  }
  for (auto& row : axes) {
    const double first = row[p], second = row[q];
    row[p] = cosine * first - sine * second;
    row[q] = sine * first + cosine * second;
  }
}

}  // namespace

double norm(const Symmetric3& a) {
  return std::sqrt(a[0] * a[0] + a[3] * a[3] + a[5] * a[5] + 2 * (a[1] * a[1] + a[2] * a[2] + a[4] * a[4]));
}

Eigen3 eigen_of(const Symmetric3& s) {
  Matrix a{{{s[0], s[1], s[2]}, {s[1], s[3], s[4]}, {s[2], s[4], s[5]}}}, axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  // Convergence is quadratic from the third round on; ten are plenty for three rows.
  for (int round = 0; round < 10; ++round) {
    annihilate(a, axes, 0, 1);
    annihilate(a, axes, 0, 2);
    annihilate(a, axes, 1, 2);
  }
  Eigen3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.value[i] = a[i][i];
    result.axis[i] = {axes[0][i], axes[1][i], axes[2][i]};
  }
  return result;
}

}  // namespace ogc::reference
