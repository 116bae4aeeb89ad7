// Defines the operations of a world's program: the loops and collectives of fast/stages/backend.hpp, run by one block.
// A block is a host thread (fast/worlds/host.hpp) or the threads of a device's block (fast/cuda/world_block.cuh). All
// threads of a block run an operation together; a barrier follows each operation.
//
// A block has:
//   int thread(), threads()                      this thread's number; number of threads
//   void barrier()                               waits for all threads, whose writes are then visible
//   const F& reread(const F& f)                  f itself, whose members are read again rather than kept in registers
//   team_loop<W>(n, f), group_loop<W>(n, f), row_loop(n, offsets, values, f), search(searches), scan(scan)
//                                                see fast/stages/backend.hpp
#pragma once

#include <cstdint>

#include "fast/kernels/search.hpp"
#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Requires ahead(i), which reads data of f(i) before the loop's turn.
template <class F>
concept HasAhead = requires(const F& f) {
  f.ahead(0);
};

/// Runs f(i) for 0 ≤ i < n; the block's threads share the items. All threads of a warp call f together if n is a
/// multiple of 32.
template <class F, class Block>
OGC_HD void loop(const Block& block, int n, const F& f) {
  for (int i = block.thread(); i < n; i += block.threads()) {
    const F& own = block.reread(f);
    if constexpr (HasAhead<F>)
      own(i, own.ahead(i));
    else
      own(i);
  }
}

/// Runs a call of for_each (fast/stages/backend.hpp).
template <class F>
struct EachOperation {
  int n;
  F f;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    loop(block, n, f);
  }
};

/// Runs a call of for_each_counted (fast/stages/backend.hpp).
template <class F>
struct CountedOperation {
  const int* n;
  int capacity;
  F f;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    loop(block, *n < capacity ? *n : capacity, f);
  }
};

/// Runs a call of for_both (fast/stages/backend.hpp).
template <class F, class G>
struct BothOperation {
  int m;
  const int* n;
  int capacity;
  F f;
  G g;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    loop(block, m, f);
    loop(block, *n < capacity ? *n : capacity, g);
  }
};

/// Runs a call of for_each_group (fast/stages/backend.hpp).
template <int W, class F>
struct GroupOperation {
  int n;
  F f;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    block.template group_loop<W>(n, f);
  }
};

/// Runs a call of for_each_team (fast/stages/backend.hpp).
template <int W, class F>
struct TeamOperation {
  int n;
  F f;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    block.template team_loop<W>(n, f);
  }
};

/// Runs a call of for_each_row (fast/stages/backend.hpp).
template <class F>
struct RowOperation {
  int n;
  const int* offsets;
  const float* values;
  F f;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    block.row_loop(n, offsets, values, f);
  }
};

/// search, of one kind
template <class Query>
struct SearchOperation {
  Searches<Query> searches;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    block.search(searches);
  }
};

/// Runs a call of exclusive_scans (fast/stages/backend.hpp).
struct ScanOperation {
  Scan first, second;
  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    block.scan(first);
    block.barrier();
    block.scan(second);
  }
};

/// sort_pairs: merges sorted runs of one item, then of two, four, …; each thread finds the places of its items by
/// bisection in the other run. Equal keys keep their order: an item of the first run goes before equal items of the
/// second.
struct SortOperation {
  std::uint64_t *keys, *other_keys;  ///< `other`: temporary memory for n items
  int *values, *other_values;
  int n;
  KeyBits bits;

  template <class Block>
  OGC_HD void operator()(const Block& block) const {
    std::uint64_t *from = keys, *to = other_keys;
    int *values_from = values, *values_to = other_values;
    for (int run = 1; run < n; run *= 2) {
      for (int i = block.thread(); i < n; i += block.threads()) {
        const int pair = i / (2 * run) * (2 * run), middle = least(pair + run, n), end = least(pair + 2 * run, n);
        const bool is_first = i < middle;
        const int place = is_first ? i + count_below(from, middle, end, from[i], false) - middle
                                   : i - middle + count_below(from, pair, middle, from[i], true);
        to[place] = from[i];
        values_to[place] = values_from[i];
      }
      block.barrier();
      exchange(from, to);
      exchange(values_from, values_to);
    }
    if (from == keys) return;
    for (int i = block.thread(); i < n; i += block.threads()) keys[i] = from[i], values[i] = values_from[i];
  }

 private:
  OGC_HD static int least(int a, int b) { return a < b ? a : b; }
  template <class T>
  OGC_HD static void exchange(T& a, T& b) {
    const T old = a;
    a = b;
    b = old;
  }
  OGC_HD std::uint64_t part(std::uint64_t key) const {
    const int above = 64 - bits.end;
    return key << above >> (above + bits.begin);
  }
  /// Returns the first place of a sorted run whose key is not below `key`; with `or_equal`, whose key is above it.
  OGC_HD int count_below(const std::uint64_t* sorted, int begin, int end, std::uint64_t key, bool or_equal) const {
    const std::uint64_t own = part(key);
    while (begin < end) {
      const int middle = begin + (end - begin) / 2;
      const std::uint64_t other = part(sorted[middle]);
      if (other < own || (or_equal && other == own))
        begin = middle + 1;
      else
        end = middle;
    }
    return begin;
  }
};

}  // namespace ogc::fast
