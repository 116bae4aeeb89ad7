// Sums in double over vertices, elements and records, for reports. The order of addition is fixed by the size of the
// mesh alone: item i goes to chunk i mod C, C = 1024 or, for large meshes, 32768; chunks are added in runs of 32 until
// 32 rows are left, then those; no backend and no number of threads can change a bit. A chunk is one thread's work. One
// launch adds items of all kinds: a launch for each kind would take as long as that.
#pragma once

#include <utility>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Rows that a thread adds.
inline constexpr int reduce_run = 32;

/// C for a mesh of so many vertices: an item or two a chunk, where there are enough of them to pay for the rows.
inline int reduce_chunks(int vertices) { return vertices <= 2048 ? 1024 : 32768; }

/// for_each over chunks: a row of partial sums each. all.add(chunk, chunks, sums) adds the items of a chunk, kind by
/// kind.
template <int columns, class All>
struct AddChunk {
  All all;
  int chunks;       ///< C
  double* partial;  ///< [chunk][column], on the backend

  OGC_HD void operator()(int chunk) const {
    double sums[columns] = {};
    all.add(chunk, chunks, sums);
    for (int k = 0; k < columns; ++k) partial[chunk * columns + k] = sums[k];
  }
};

/// for_each over runs and columns: a row of `to` is the sum of 32 rows of `from`.
template <int columns>
struct AddRun {
  const double* from;  ///< [row][column], on the backend
  double* to;          ///< [row][column], on the backend

  OGC_HD void operator()(int i) const {
    const int run = i / columns, column = i % columns;
    double sum = 0;
    for (int k = 0; k < reduce_run; ++k) sum += from[(run * reduce_run + k) * columns + column];
    to[i] = sum;
  }
};

/// The sums of one mesh.
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
