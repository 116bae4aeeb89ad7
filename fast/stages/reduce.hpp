// Sums in double over vertices, elements and records, for reports. The order of addition is fixed by the size of the mesh alone: item i goes to chunk
// i mod C, C = 1024 or, for large meshes, 32768; chunks are added in runs of 32 until 32 rows are left, then those; no backend and no number of threads can
// change a bit. A chunk is one thread's work, and 1024 threads are a twentieth of what a large device holds.
#pragma once

#include <utility>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

inline constexpr int reduce_run = 32;

/// C for a mesh of so many vertices.
inline int reduce_chunks(int vertices) { return vertices <= 32768 ? 1024 : 32768; }

/// for_each over chunks: adds the chunk's items to its row of `columns` partial sums.
template <class Term>
struct AddChunk {
  Term term;
  int count;
  const int* counted;  ///< on the device; null: `count` holds
  int chunks, columns;
  double* partial;

  OGC_HD void operator()(int chunk) const {
    const int n = counted == nullptr ? count : *counted;
    for (int i = chunk; i < n; i += chunks) term(i, partial + chunk * columns);
  }
};

/// for_each over runs and columns: a row of `to` is the sum of 32 rows of `from`.
struct AddRun {
  int columns;
  const double* from;
  double* to;

  OGC_HD void operator()(int i) const {
    const int run = i / columns, column = i % columns;
    double sum = 0;
    for (int k = 0; k < reduce_run; ++k) sum += from[(run * reduce_run + k) * columns + column];
    to[i] = sum;
  }
};

struct ClearPartial {
  double* partial;

  OGC_HD void operator()(int i) const { partial[i] = 0; }
};

/// A set of sums: `begin`, any number of `add`s of different kinds of items, then `end` writes the totals, `columns` of them.
template <class Backend>
class Reduction {
 public:
  /// For a mesh of `vertices`.
  Reduction(Backend& backend, int columns, int vertices) : backend_(backend), columns_(columns), chunks_(reduce_chunks(vertices)) {
    partial_.resize(static_cast<std::size_t>(chunks_ * columns));
    runs_.resize(static_cast<std::size_t>(chunks_ / reduce_run * columns));
  }
  void begin() { backend_.for_each(chunks_ * columns_, ClearPartial{partial_.data()}); }
  /// term(i, sums) adds item i to its columns.
  template <class Term>
  void add(int count, Term term) {
    backend_.for_each(chunks_, AddChunk<Term>{term, count, nullptr, chunks_, columns_, partial_.data()});
  }
  template <class Term>
  void add_counted(const int* count, Term term) {
    backend_.for_each(chunks_, AddChunk<Term>{term, 0, count, chunks_, columns_, partial_.data()});
  }
  void end(double* total) {
    double *from = partial_.data(), *to = runs_.data();
    for (int rows = chunks_ / reduce_run; rows > 1; rows /= reduce_run) {
      backend_.for_each(rows * columns_, AddRun{columns_, from, to});
      std::swap(from, to);
    }
    backend_.for_each(columns_, AddRun{columns_, from, total});
  }

 private:
  Backend& backend_;
  int columns_, chunks_;
  typename Backend::template Buffer<double> partial_, runs_;
};

}  // namespace ogc::fast
