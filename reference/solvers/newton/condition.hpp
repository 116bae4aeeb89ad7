// Extreme eigenvalues of a factorised system by Lanczos' method, on the matrix and on its inverse.
#pragma once

#include "reference/solvers/newton/factor.hpp"

namespace ogc::reference {

/// Returns λ_min [N/m], within a relative distance of 2⁻²⁰ of an eigenvalue; not-a-number if 500 iterations are not
/// enough. The matrix must be positive definite and factorised.
double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor);

/// Returns λ_max/λ_min, each within a relative distance of 2⁻²⁰ of an eigenvalue; not-a-number if 500 iterations are
/// not enough. The matrix must be positive definite and factorised.
double condition_number(const BlockMatrix& matrix, Factor& factor);

/// Returns the condition number of the matrix of inertia and a potential's first `stencils` stencils. `derivatives` and
/// `projected` have the derivatives of all stencils; `projected` is used if the matrix of `derivatives` is not positive
/// definite. Returns not-a-number if neither matrix is.
double condition_of_first(const Potential& potential, std::size_t stencils, const PotentialDerivatives& derivatives,
                          const PotentialDerivatives& projected);

}  // namespace ogc::reference
