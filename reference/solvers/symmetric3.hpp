// Eigenvalues and eigenvectors of a symmetric 3×3 matrix. An error of the force moves a vertex differently far in the
// directions of the eigenvectors, and contacts make the ratio of the eigenvalues large.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// xx, xy, xz, yy, yz, zz, in the order of the blocks of compare/stages/force.hpp.
using Symmetric3 = std::array<double, 6>;

/// Returns the Frobenius norm of the whole matrix.
double norm(const Symmetric3& a);

/// A = Σ value[i] axis[i] axis[i]ᵀ, axes orthonormal.
struct Eigen3 {
  std::array<double, 3> value{};
  std::array<compare::Vec3, 3> axis{};
};

/// Decomposes `a`. Values ascend; they lie within a few units of 2⁻⁵³ ‖A‖ of the exact ones.
Eigen3 eigen_of(const Symmetric3& a);

}  // namespace ogc::reference
