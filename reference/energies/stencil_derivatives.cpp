#include "reference/energies/stencil_derivatives.hpp"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Dense>

namespace ogc::reference {
namespace {

template <int Size>
void project_sized(double* matrix, compare::HessianProjection projection) {
  using Matrix = Eigen::Matrix<double, Size, Size>;  // symmetric: rows are columns
  using Vector = Eigen::Matrix<double, Size, 1>;
  Eigen::Map<Matrix> h(matrix);
  // What Cholesky's factorisation tells costs a hundredth of the eigenvalues.
  if (h.isZero(0) || Eigen::LLT<Matrix>(h).info() == Eigen::Success) return;
  Eigen::SelfAdjointEigenSolver<Matrix> solver(h);
  Vector values = solver.eigenvalues();
  if (values.minCoeff() >= 0) return;
  for (int i = 0; i < Size; ++i) values[i] = projection == compare::HessianProjection::absolute ? std::abs(values[i]) : std::max(values[i], 0.0);
  h = solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

void project(double* matrix, std::size_t size, compare::HessianProjection projection) {
  if (projection == compare::HessianProjection::none) return;
  switch (size) {
    case 3: return project_sized<3>(matrix, projection);
    case 6: return project_sized<6>(matrix, projection);
    case 9: return project_sized<9>(matrix, projection);
    default: throw std::invalid_argument("project: a stencil has 2, 3 or 4 vertices");
  }
}

}  // namespace ogc::reference
