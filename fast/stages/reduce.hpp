// Sums vertices, elements and records in double, for reports. The order of addition depends on the size of the mesh
// only: item i is added to chunk i mod C, with C = 1024, or 32768 for large meshes. The sums of a chunk are a row. Rows
// are added in runs of 32 until 32 rows are left, then these 32. So no backend and no number of threads can change a
// bit. One thread adds the items of a chunk.
//
// Few launches are made, because a launch takes as long as all the additions. One launch adds items of all kinds, and
// `total` sums columns that were added at different times. The caller may run other loops in these launches.
#pragma once

#include <utility>

#include "fast/stages/beside.hpp"

namespace ogc::fast {

/// Number of rows that one thread adds to a single row.
inline constexpr int reduce_run = 32;

/// Returns C, the number of chunks. More chunks are shorter but leave more rows to add, so only large meshes get more.
inline int reduce_chunks(int vertices) { return vertices <= 2048 ? 1024 : 32768; }

/// Adds the items of a chunk, kind by kind, with all.add(chunk, chunks, sums). Writes the sums to some columns of the
/// chunk's row of partial sums. Runs once for each chunk.
template <int count, class All>
struct AddChunk {
  All all;
  int chunks;       ///< C
  double* partial;  ///< at the first column to write
  int columns;      ///< number of columns of a whole row

  OGC_HD void operator()(int chunk) const {
    double sums[count] = {};
    all.add(chunk, chunks, sums);
    for (int k = 0; k < count; ++k) partial[chunk * columns + k] = sums[k];
  }
};

/// Adds a run of 32 rows of `from` into a row of `to`. Runs once for each run and column.
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

/// Computes the sums over one mesh.
template <class Backend, int columns>
class Reduction {
 public:
  /// Takes the number of vertices of the mesh.
  Reduction(Backend& backend, int vertices) : backend_(backend), chunks_(reduce_chunks(vertices)) {
    partial_.resize(static_cast<std::size_t>(chunks_ * columns));
    runs_.resize(static_cast<std::size_t>(chunks_ / reduce_run * columns));
  }
  /// Adds all items into the columns from `first` on. The same launch calls f(i) for i < n.
  template <int first, int count, class All, class F>
  void add(const All& all, int n, const F& f) {
    static_assert(0 <= first && first + count <= columns);
    for_each_beside(backend_, chunks_, AddChunk<count, All>{all, chunks_, partial_.data() + first, columns}, n, f);
  }

  /// Writes the totals of all columns. Each column must have been added since the last call. The first launch also
  /// calls f(i) for i < n, and the last launch g(i) for i < m.
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
