#include "reference/solvers/symmetric3.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace ogc::reference {

double norm(const Symmetric3& a) {
  return std::sqrt(a[0] * a[0] + a[3] * a[3] + a[5] * a[5] + 2 * (a[1] * a[1] + a[2] * a[2] + a[4] * a[4]));
}

Eigen3 eigen_of(const Symmetric3& s) {
  Eigen::Matrix3d a;
  a << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
  Eigen3 result;
  for (int i = 0; i < 3; ++i) {
    const auto axis = solver.eigenvectors().col(i);
    result.value[static_cast<std::size_t>(i)] = solver.eigenvalues()[i];
    result.axis[static_cast<std::size_t>(i)] = {axis[0], axis[1], axis[2]};
  }
  return result;
}

}  // namespace ogc::reference
