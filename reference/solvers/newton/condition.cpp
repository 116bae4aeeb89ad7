#include "reference/solvers/newton/condition.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Dense>

namespace ogc::reference {
namespace {

constexpr int most_iterations = 500;
/// Relative tolerance of an eigenvalue θ. If ‖A z − θ z‖ ≤ tolerance θ for a unit vector z, A has an eigenvalue within
/// tolerance θ of θ. The tolerance is small, so that the iteration separates the largest eigenvalue from its
/// neighbours.
constexpr double tolerance = 0x1p-20;

/// Returns a start vector with pseudorandom entries in [−1, 1), the same in every run. If it were orthogonal to the
/// eigenvector of the largest eigenvalue, the iteration would miss this eigenvalue.
Eigen::VectorXd start(Eigen::Index size) {
  std::mt19937 engine;
  Eigen::VectorXd x(size);
  for (double& value : x) value = static_cast<double>(engine()) * 0x1p-31 - 1;
  return x.normalized();
}

/// Returns the largest eigenvalue of a symmetric positive definite operator, by Lanczos' method with full
/// reorthogonalisation.
template <class Apply>
double largest_eigenvalue(Eigen::Index size, Apply apply) {
  std::vector<Eigen::VectorXd> basis{start(size)};
  std::vector<double> diagonal, beside;
  while (static_cast<int>(diagonal.size()) < most_iterations) {
    Eigen::VectorXd next = apply(basis.back());
    diagonal.push_back(next.dot(basis.back()));
    for (int pass = 0; pass < 2; ++pass)
      for (const Eigen::VectorXd& old : basis) next -= next.dot(old) * old;
    const double length = next.norm();
    const auto count = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), count),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), count - 1));
    const double largest = ritz.eigenvalues()[count - 1];
    if (length * std::abs(ritz.eigenvectors()(count - 1, count - 1)) <= tolerance * largest || count == size)
      return largest;
    beside.push_back(length);
    basis.push_back(next / length);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Converts a function of std::vector to one of Eigen's vectors.
template <class Operation>
auto through(Operation operation) {
  return [operation](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const std::vector<double> y = operation(std::vector<double>(x.data(), x.data() + x.size()));
    return Eigen::Map<const Eigen::VectorXd>(y.data(), x.size());
  };
}

}  // namespace

double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor) {
  const auto solve = through([&](const std::vector<double>& x) { return factor.solve(x); });
  return 1 / largest_eigenvalue(static_cast<Eigen::Index>(matrix.rows()), solve);
}

double condition_number(const BlockMatrix& matrix, Factor& factor) {
  const auto multiply = through([&](const std::vector<double>& x) { return matrix.times(x); });
  return largest_eigenvalue(static_cast<Eigen::Index>(matrix.rows()), multiply) / smallest_eigenvalue(matrix, factor);
}

double condition_of_first(const Potential& potential, std::size_t stencils, const PotentialDerivatives& derivatives,
                          const PotentialDerivatives& projected) {
  const std::vector<StencilVertices> vertices = potential.vertices();
  BlockMatrix matrix(potential.unknowns());
  matrix.set_stencils(std::span(vertices).first(stencils));
  Factor factor;
  factor.analyze(matrix);
  for (const PotentialDerivatives* tried : {&derivatives, &projected}) {
    matrix.assemble(potential.inertias(), std::span(tried->stencil).first(stencils));
    if (factor.factorize(matrix)) return condition_number(matrix, factor);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ogc::reference
