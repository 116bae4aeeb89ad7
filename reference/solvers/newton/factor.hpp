// A supernodal Cholesky factorisation that reuses its symbolic part until the pattern changes. Only factor.cpp includes
// CHOLMOD.
#pragma once

#include <memory>
#include <vector>

#include "reference/solvers/newton/matrix.hpp"

namespace ogc::reference {

/// A Cholesky factorisation by CHOLMOD.
class Factor {
 public:
  Factor();
  ~Factor();
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  /// Analyses the pattern and finds an order with little fill. Throws compare::ResourceError if memory runs out.
  void analyze(const BlockMatrix& matrix);
  /// Factorises; returns false if the matrix is not positive definite (or holds a not-a-number). Throws like `analyze`.
  bool factorize(const BlockMatrix& matrix);
  /// Returns A⁻¹ b. The last factorisation must have succeeded.
  std::vector<double> solve(const std::vector<double>& b);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace ogc::reference
