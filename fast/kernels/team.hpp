// Defines the sum of a team of W team lanes, here run by one thread. A sum has parts, one for each kind of term. Item k
// of a part is added by team lane k mod W. A team lane adds its items of one part in order, then its parts in order; a
// fixed tree adds the team lanes. Every team that follows this rule gives the same bits, on any backend and with any
// number of threads. Only W changes bits.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/rounding.hpp"

namespace ogc::fast {

/// A part of a sum: terms k with 0 ≤ k < count. load(k) reads only data that the preceding launch does not write.
/// add(loaded, sum) reads the rest and adds the term. So a device can call load while the preceding launch still runs
/// (programmatic dependent launch).
template <class Load, class Add>
struct Part {
  int count;  ///< items
  Load load;
  Add add;
};

template <class Load, class Add>
OGC_HD Part<Load, Add> part(int count, Load load, Add add) {
  return {count, load, add};
}

/// Reads item k of a row; used as `load` of a Part.
template <class Item>
struct LoadFrom {
  const Item* first;  ///< first item of the row

  OGC_HD Item operator()(int k) const { return first[k]; }
};

/// A part whose terms do not depend on the team's own data. So all threads of a block may compute the terms of all its
/// teams together. The items are begin + k for 0 ≤ k < count, and those of the next team's item begin where these end.
/// term(load(item)) returns an Accumulator.
template <class Load, class Term>
struct PooledPart {
  int begin, count;  ///< first item; number of items
  Load load;
  Term term;
};

template <class Load, class Term>
OGC_HD PooledPart<Load, Term> pooled_part(int begin, int count, Load load, Term term) {
  return {begin, count, load, term};
}

/// load_item reads item k of a part, add_item adds a loaded item to a sum. Each accepts both types of parts, so that a
/// team needs one loop.
template <class Load, class Add>
OGC_HD auto load_item(const Part<Load, Add>& part, int k) {
  return part.load(k);
}
template <class Load, class Term>
OGC_HD auto load_item(const PooledPart<Load, Term>& part, int k) {
  return part.load(part.begin + k);
}
template <class Load, class Add, class Loaded, class Accumulator>
OGC_HD void add_item(const Part<Load, Add>& part, const Loaded& loaded, Accumulator& sum) {
  part.add(loaded, sum);
}
template <class Load, class Term, class Loaded, class Accumulator>
OGC_HD void add_item(const PooledPart<Load, Term>& part, const Loaded& loaded, Accumulator& sum) {
  sum += part.term(loaded);
}

/// Searches items k < count, for a team of one lane. In a team of several lanes all lanes call the same functions
/// together with the same numbers, share the items, and get the same results.
struct OneLane {
  /// Returns the smallest k ≥ from for which is(k) holds; count if there is none.
  template <class Is>
  OGC_HD int first(int count, int from, Is is) const {
    for (int k = from; k < count; ++k)
      if (is(k)) return k;
    return count;
  }
  /// Returns the smallest of `most` and all numbers of(k).
  template <class Of>
  OGC_HD double smallest(int count, double most, Of of) const {
    for (int k = 0; k < count; ++k) most = smaller(most, of(k));
    return most;
  }
};

/// Runs W team lanes one after the other. `Accumulator` has `+=`, and value initialisation makes it zero. Zeros are +0,
/// and a rounded sum is −0 only if both terms are −0. So a lane without items changes no bit and may be omitted.
template <int W>
struct SerialTeam : OneLane {
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;  ///< W, the number of team lanes
  /// false: the thread that has the total also does the work after the sum. Some teams of a device move totals to other
  /// threads (fast/cuda/team.cuh).
  static constexpr bool moves_totals = false;

  /// Does nothing. Teams on a device may load this number of bytes, beginning at this address, into a cache.
  OGC_HD static void prefetch(const void*, int) {}

  /// Does nothing. A team that has no vertex to update calls leave() instead of sum(), because each team of a launch
  /// must call one of the two.
  OGC_HD static void leave() {}

  /// Returns the sum of all terms of all parts. In a team of threads, only threads with holds_total() get it.
  template <class Accumulator, class... Parts>
  OGC_HD Accumulator sum(const Parts&... parts) const {
    Accumulator lanes[W] = {};
    (add_part(parts, lanes), ...);
    for (int s = W / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) lanes[l] += lanes[l + s];
    }
    return lanes[0];
  }

  /// Returns whether this thread has the total. `first` and `smallest` must be called by all threads of the team that
  /// have it, and by no others.
  OGC_HD bool holds_total() const { return true; }
  /// Returns whether this thread writes the team's result; if so it also has the total.
  OGC_HD bool leader() const { return true; }

 private:
  template <class AnyPart, class Accumulator>
  OGC_HD static void add_part(const AnyPart& part, Accumulator (&lanes)[W]) {
    for (int l = 0; l < W && l < part.count; ++l) {
      Accumulator own{};
      for (int k = l; k < part.count; k += W) add_item(part, load_item(part, k), own);
      lanes[l] += own;
    }
  }
};

}  // namespace ogc::fast
