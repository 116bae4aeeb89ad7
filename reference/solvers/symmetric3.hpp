// Eigenvalues and eigenvectors of a vertex's symmetric 3×3 block. They are needed because an error of the force moves a
// vertex by different distances along the eigenvectors; with contacts the ratio of the eigenvalues is large.
#pragma once

#include <array>

#include "compare/problem/vector.hpp"

namespace ogc::reference {

/// A symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz, as in compare/stages/force.hpp.
using Symmetric3 = std::array<double, 6>;

/// Returns the Frobenius norm; entries off the diagonal count twice.
double norm(const Symmetric3& a);

/// The eigenvalues and eigenvectors of A = Σ value[i] axis[i] axis[i]ᵀ; the axes are orthonormal.
struct Eigen3 {
  std::array<double, 3> value{};
  std::array<compare::Vec3, 3> axis{};
};

/// Decomposes `a`. The values ascend. Their errors are a few times 2⁻⁵³ ‖A‖.
Eigen3 eigen_of(const Symmetric3& a);

}  // namespace ogc::reference
