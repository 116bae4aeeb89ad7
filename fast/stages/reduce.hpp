// Sums in double over vertices, elements and records, for reports. The order of addition is fixed by the number of items alone: item i goes to chunk
// i mod 1024, chunks are added in runs of 32, then the 32 runs; no backend and no number of threads can change a bit.
#pragma once

#include <algorithm>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

inline constexpr int reduce_chunks = 1024, reduce_run = 32;

/// for_each over chunks: adds the chunk's items to its row of `columns` partial sums.
template <class Term>
struct AddChunk {
  Term term;
  int count;
  const int* counted;  ///< on the device; null: `count` holds
  int columns;
  double* partial;

  OGC_HD void operator()(int chunk) const {
    const int n = counted == nullptr ? count : *counted;
    for (int i = chunk; i < n; i += reduce_chunks) term(i, partial + chunk * columns);
  }
};

struct AddRun {
  int columns;
  const double* partial;
  double* runs;

  OGC_HD void operator()(int i) const {
    const int run = i / columns, column = i % columns;
    double sum = 0;
    for (int k = 0; k < reduce_run; ++k) sum += partial[(run * reduce_run + k) * columns + column];
    runs[i] = sum;
  }
};

struct AddRuns {
  int columns;
  const double* runs;
  double* total;

  OGC_HD void operator()(int column) const {
    double sum = 0;
    for (int run = 0; run < reduce_chunks / reduce_run; ++run) sum += runs[run * columns + column];
    total[column] = sum;
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
  Reduction(Backend& backend, int columns) : backend_(backend), columns_(columns) {
    partial_.resize(static_cast<std::size_t>(reduce_chunks * columns));
    runs_.resize(static_cast<std::size_t>(reduce_chunks / reduce_run * columns));
  }
  void begin() { backend_.for_each(reduce_chunks * columns_, ClearPartial{partial_.data()}); }
  /// term(i, sums) adds item i to its columns.
  template <class Term>
  void add(int count, Term term) {
    backend_.for_each(reduce_chunks, AddChunk<Term>{term, count, nullptr, columns_, partial_.data()});
  }
  template <class Term>
  void add_counted(const int* count, Term term) {
    backend_.for_each(reduce_chunks, AddChunk<Term>{term, 0, count, columns_, partial_.data()});
  }
  void end(double* total) {
    backend_.for_each(reduce_chunks / reduce_run * columns_, AddRun{columns_, partial_.data(), runs_.data()});
    backend_.for_each(columns_, AddRuns{columns_, runs_.data(), total});
  }

 private:
  Backend& backend_;
  int columns_;
  typename Backend::template Buffer<double> partial_, runs_;
};

}  // namespace ogc::fast
