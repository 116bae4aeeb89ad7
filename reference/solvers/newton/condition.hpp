// Extreme eigenvalues of a factorised system by Lanczos' method on the matrix and on its inverse.
#pragma once

#include "reference/solvers/newton/factor.hpp"

namespace ogc::reference {

/// λ_min [N/m], an eigenvalue within 2⁻²⁰ of itself; not-a-number where 500 iterations are not enough. The matrix must
/// be positive definite and factorised.
double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor);

/// λ_max/λ_min, each an eigenvalue within 2⁻²⁰ of itself; not-a-number where 500 iterations are not enough. The matrix
/// must be positive definite and factorised.
double condition_number(const BlockMatrix& matrix, Factor& factor);

/// The condition number of the matrix of a potential's first `stencils` stencils and its inertia, from derivatives of
/// all of them. Stencils are those of `projected` where the matrix of `derivatives` is not positive definite;
/// not-a-number where neither is.
double condition_of_first(const Potential& potential, std::size_t stencils, const PotentialDerivatives& derivatives,
                          const PotentialDerivatives& projected);

}  // namespace ogc::reference
