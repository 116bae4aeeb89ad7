// Extreme eigenvalues of a factorised system by Lanczos' method on the matrix and on its inverse.
#pragma once

#include "reference/solvers/newton_factor.hpp"

namespace ogc::reference {

/// λ_min [N/m], an eigenvalue within 2⁻²⁰ of itself; not-a-number where 500 iterations are not enough. The matrix must be positive
/// definite and factorised.
double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor);

/// λ_max/λ_min, each an eigenvalue within 2⁻²⁰ of itself; not-a-number where 500 iterations are not enough. The matrix must be positive definite and factorised.
double condition_number(const BlockMatrix& matrix, Factor& factor);

}  // namespace ogc::reference
