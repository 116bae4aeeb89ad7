// Computes extreme eigenvalues of a factorised matrix by Lanczos' method on the matrix and on its inverse.
#pragma once

#include "reference/solvers/newton/factor.hpp"

namespace ogc::reference {

/// Returns λ_min [N/m] with a relative error of at most 2⁻²⁰; not-a-number if 500 iterations are not enough. The matrix
/// must be positive definite and factorised.
double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor);

/// Returns λ_max/λ_min, each with a relative error of at most 2⁻²⁰; not-a-number if 500 iterations are not enough. The
/// matrix must be positive definite and factorised.
double condition_number(const BlockMatrix& matrix, Factor& factor);

/// Returns the condition number of the matrix of inertia and the potential's first `stencils` stencils. `derivatives`
/// and `projected` are the derivatives of all stencils, without and with projection. Uses the projected ones if the
/// matrix without projection is not positive definite. Returns not-a-number if neither matrix is positive definite.
double condition_of_first(const Potential& potential, std::size_t stencils, const PotentialDerivatives& derivatives,
                          const PotentialDerivatives& projected);

}  // namespace ogc::reference
