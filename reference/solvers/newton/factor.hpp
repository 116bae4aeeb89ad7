// A supernodal Cholesky factorisation whose symbolic part is kept while the pattern stays. Only this header's source
// uses CHOLMOD.
#pragma once

#include <memory>
#include <vector>

#include "reference/solvers/newton/matrix.hpp"

namespace ogc::reference {

/// A Cholesky factorisation by CHOLMOD, whose analysis is kept as long as the pattern stays.
class Factor {
 public:
  Factor();
  ~Factor();
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  /// Orders the pattern for little fill. Throws compare::ResourceError where memory runs out.
  void analyze(const BlockMatrix& matrix);
  /// Returns false where the matrix is not positive definite (or holds a not-a-number). Throws like `analyze`.
  bool factorize(const BlockMatrix& matrix);
  /// Returns A⁻¹ b. The last factorisation must have succeeded.
  std::vector<double> solve(const std::vector<double>& b);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace ogc::reference
