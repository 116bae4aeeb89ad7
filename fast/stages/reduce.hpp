// Sums in double over vertices, elements and records, for reports. The order of addition is fixed by the size of the
// mesh alone: item i goes to chunk i mod C, C = 1024 or, for large meshes, 32768; chunks are added in runs of 32 until
// 32 rows are left, then those; no backend and no number of threads can change a bit. A chunk is one thread's work. All
// kinds of items are added in one launch: a launch of its own for each would take as long as that.
#pragma once

#include <utility>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

inline constexpr int reduce_run = 32;

/// C for a mesh of so many vertices: an item or two a chunk, where there are enough of them to pay for the rows.
inline int reduce_chunks(int vertices) { return vertices <= 2048 ? 1024 : 32768; }

struct NoItems {
  OGC_HD void add(int, int, double*) const {}
};

/// Items of one kind, and those of others: term(i, sums) adds item i to its columns.
template <class Term, class Rest>
struct Items {
  Term term;
  int count;
  const int* counted;  ///< on the device; null: `count` holds
  Rest rest;

  OGC_HD void add(int chunk, int chunks, double* sums) const {
    const int n = counted == nullptr ? count : *counted;
    for (int i = chunk; i < n; i += chunks) term(i, sums);
    rest.add(chunk, chunks, sums);
  }
};

template <class Term, class Rest = NoItems>
Items<Term, Rest> items(int count, const Term& term, const Rest& rest = {}) {
  return {term, count, nullptr, rest};
}
template <class Term, class Rest = NoItems>
Items<Term, Rest> items(const int* counted, const Term& term, const Rest& rest = {}) {
  return {term, {}, counted, rest};
}

/// for_each over chunks: a row of partial sums each, of the chunk's items kind by kind.
template <int columns, class All>
struct AddChunk {
  All all;
  int chunks;
  double* partial;

  OGC_HD void operator()(int chunk) const {
    double sums[columns] = {};
    all.add(chunk, chunks, sums);
    for (int k = 0; k < columns; ++k) partial[chunk * columns + k] = sums[k];
  }
};

/// for_each over runs and columns: a row of `to` is the sum of 32 rows of `from`.
template <int columns>
struct AddRun {
  const double* from;
  double* to;

  OGC_HD void operator()(int i) const {
    const int run = i / columns, column = i % columns;
    double sum = 0;
    for (int k = 0; k < reduce_run; ++k) sum += from[(run * reduce_run + k) * columns + column];
    to[i] = sum;
  }
};

template <class Backend, int columns>
class Reduction {
 public:
  /// For a mesh of `vertices`.
  Reduction(Backend& backend, int vertices) : backend_(backend), chunks_(reduce_chunks(vertices)) {
    partial_.resize(static_cast<std::size_t>(chunks_ * columns));
    runs_.resize(static_cast<std::size_t>(chunks_ / reduce_run * columns));
  }
  /// The totals of all items, `columns` of them.
  template <class All>
  void sum(double* total, const All& all) {
    backend_.for_each(chunks_, AddChunk<columns, All>{all, chunks_, partial_.data()});
    double *from = partial_.data(), *to = runs_.data();
    for (int rows = chunks_ / reduce_run; rows > 1; rows /= reduce_run) {
      backend_.for_each(rows * columns, AddRun<columns>{from, to});
      std::swap(from, to);
    }
    backend_.for_each(columns, AddRun<columns>{from, total});
  }

 private:
  Backend& backend_;
  int chunks_;
  typename Backend::template Buffer<double> partial_, runs_;
};

}  // namespace ogc::fast
