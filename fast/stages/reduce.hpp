// Sums in double over vertices, elements and records, for reports. The order of addition is fixed by the size of the
// mesh alone: item i goes to chunk i mod C, C = 1024 or, for large meshes, 32768; chunks are added in runs of 32 until
// 32 rows are left, then those; no backend and no number of threads can change a bit. A chunk is one thread's work. One
// launch adds items of all kinds, and runs of what was added at different times are added together: a launch for each
// would take as long as that. For the same reason launches of the caller's that need no sum stand beside these.
#pragma once

#include <utility>

#include "fast/stages/beside.hpp"

namespace ogc::fast {

/// Rows that a thread adds.
inline constexpr int reduce_run = 32;

/// C for a mesh of so many vertices: an item or two a chunk, where there are enough of them to pay for the rows.
inline int reduce_chunks(int vertices) { return vertices <= 2048 ? 1024 : 32768; }

/// for_each over chunks: part of a row of partial sums each. all.add(chunk, chunks, sums) adds the items of a chunk,
/// kind by kind.
template <int count, class All>
struct AddChunk {
  All all;
  int chunks;       ///< C
  double* partial;  ///< from the part's first column on
  int columns;      ///< of a whole row

  OGC_HD void operator()(int chunk) const {
    double sums[count] = {};
    all.add(chunk, chunks, sums);
    for (int k = 0; k < count; ++k) partial[chunk * columns + k] = sums[k];
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
  /// Takes the number of vertices of the mesh.
  Reduction(Backend& backend, int vertices) : backend_(backend), chunks_(reduce_chunks(vertices)) {
    partial_.resize(static_cast<std::size_t>(chunks_ * columns));
    runs_.resize(static_cast<std::size_t>(chunks_ / reduce_run * columns));
  }
  /// Adds all items, into the columns from `first` on; f(i) for i < n beside it.
  template <int first, int count, class All, class F>
  void add(const All& all, int n, const F& f) {
    static_assert(0 <= first && first + count <= columns);
    for_each_beside(backend_, chunks_, AddChunk<count, All>{all, chunks_, partial_.data() + first, columns}, n, f);
  }

  /// The totals of all columns, each added since the last total. f(i) for i < n beside the first launch, then g(i) for
  /// i < m beside the last.
  template <class F, class G>
  void total(double* totals, int n, const F& f, int m, const G& g) {
    double *from = partial_.data(), *to = runs_.data();
    int rows = chunks_ / reduce_run;  // at least reduce_run
    for_each_beside(backend_, rows * columns, AddRun<columns>{from, to}, n, f);
    for (std::swap(from, to); (rows /= reduce_run) > 1; std::swap(from, to))
      backend_.for_each(rows * columns, AddRun<columns>{from, to});
    for_each_beside(backend_, columns, AddRun<columns>{from, totals}, m, g);
  }

 private:
  Backend& backend_;
  int chunks_;
  typename Backend::template Buffer<double> partial_, runs_;
};

}  // namespace ogc::fast
