// Extreme eigenvalues of a factorised system by Lanczos' method, on the matrix and on its inverse.
#pragma once

#include "reference/solvers/newton/factor.hpp"

namespace ogc::reference {

/// Returns λ_min [N/m], within 2⁻²⁰ of an eigenvalue, relatively; not-a-number where 500 iterations are not enough. The
/// matrix must be positive definite and factorised.
double smallest_eigenvalue(const BlockMatrix& matrix, Factor& factor);

/// Returns λ_max/λ_min, each within 2⁻²⁰ of an eigenvalue, relatively; not-a-number where 500 iterations are not
/// enough. The matrix must be positive definite and factorised.
double condition_number(const BlockMatrix& matrix, Factor& factor);

/// Returns the condition number of the matrix of a potential's first `stencils` stencils and its inertia, from
/// derivatives of all stencils. Takes `projected` where the matrix of `derivatives` is not positive definite; returns
/// not-a-number where neither is.
double condition_of_first(const Potential& potential, std::size_t stencils, const PotentialDerivatives& derivatives,
                          const PotentialDerivatives& projected);

}  // namespace ogc::reference
