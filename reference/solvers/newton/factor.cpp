// CHOLMOD copies the entries of each small supernode with four OpenMP threads on every machine, and BLAS may start one
// thread for each core. Waiting threads occupy their cores: on two busy cores the factorisation of 14,700 rows took 2.4
// times as long as with one thread. So this file limits OpenMP to one thread, and BLAS unless OPENBLAS_NUM_THREADS is
// set.
#include "reference/solvers/newton/factor.hpp"

#include <cstdlib>

#include <cholmod.h>

#include "compare/problem/error.hpp"

// Weak symbols: the first is defined only if CHOLMOD was built with OpenMP, the second only if BLAS is OpenBLAS.
extern "C" {
[[gnu::weak]] void omp_set_max_active_levels(int levels);
[[gnu::weak]] void openblas_set_num_threads(int threads);
}

namespace ogc::reference {

struct Factor::Memory {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Memory() {
    cholmod_start(&common);
    if (openblas_set_num_threads != nullptr && std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
      openblas_set_num_threads(1);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  ~Memory() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  void check() const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw compare::ResourceError(
          "the factorisation of Newton's matrix needs more memory than there is; take a smaller scale or --solver vbd");
  }
};

namespace {

/// Returns a view of the matrix. CHOLMOD reads the matrix in place and does not change it.
cholmod_sparse view(const BlockMatrix& matrix) {
  cholmod_sparse a{};
  a.nrow = a.ncol = matrix.rows();
  a.nzmax = matrix.values().size();
  a.p = const_cast<std::int32_t*>(matrix.column_begin().data());
  a.i = const_cast<std::int32_t*>(matrix.row_index().data());
  a.x = const_cast<double*>(matrix.values().data());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

}  // namespace

Factor::Factor() : memory_(std::make_unique<Memory>()) {}
Factor::~Factor() = default;

void Factor::analyze(const BlockMatrix& matrix) {
  cholmod_free_factor(&memory_->factor, &memory_->common);
  cholmod_sparse a = view(matrix);
  memory_->factor = cholmod_analyze(&a, &memory_->common);
  memory_->check();
}

bool Factor::factorize(const BlockMatrix& matrix) {
  if (omp_set_max_active_levels != nullptr) omp_set_max_active_levels(0);  // affects the calling thread
  cholmod_sparse a = view(matrix);
  cholmod_factorize(&a, memory_->factor, &memory_->common);
  memory_->check();
  return memory_->common.status == CHOLMOD_OK && memory_->factor->minor == memory_->factor->n;
}

std::vector<double> Factor::solve(const std::vector<double>& b) {
  cholmod_dense right{};
  right.nrow = right.d = right.nzmax = b.size();
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, memory_->factor, &right, &memory_->common);
  memory_->check();
  const auto* values = static_cast<const double*>(solution->x);
  std::vector<double> x(values, values + b.size());
  cholmod_free_dense(&solution, &memory_->common);
  return x;
}

}  // namespace ogc::reference
