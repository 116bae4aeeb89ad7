// Defines the sum of a team of W team lanes, run by one thread. A sum has parts, one for each kind of term. Item k of a
// part goes to team lane k mod W. A team lane adds its items of one part in order, then its parts in order; a fixed
// tree adds the team lanes. Every team that follows this rule gives the same bits, on any backend and with any number
// of threads; only W can change a bit.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/rounding.hpp"

namespace ogc::fast {

/// Terms k of a sum, 0 ≤ k < count. load(k) reads only what the preceding launch does not write; add(loaded, acc) reads
/// the rest and adds. So a device can load while the preceding launch still runs (programmatic dependent launch).
template <class Load, class Add>
struct Part {
  int count;  ///< items
  Load load;
  Add add;
};

/// Returns a Part with these members.
template <class Load, class Add>
OGC_HD Part<Load, Add> part(int count, Load load, Add add) {
  return {count, load, add};
}

/// The `load` of a Part that reads item k of a row.
template <class Item>
struct LoadFrom {
  const Item* first;  ///< first item of the row

  OGC_HD Item operator()(int k) const { return first[k]; }
};

/// Terms of items begin + k that read nothing of the team's vertex. So the threads of a block may share the terms of
/// all its teams. term(load(item)) is an Accumulator.
template <class Load, class Term>
struct PooledPart {
  int begin, count;  ///< first item, and how many
  Load load;
  Term term;
};

/// Returns a PooledPart with these members.
template <class Load, class Term>
OGC_HD PooledPart<Load, Term> pooled_part(int begin, int count, Load load, Term term) {
  return {begin, count, load, term};
}

/// Read item k of either kind of part, and add it, so that a team has one loop for both.
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

/// Searches and minima over items k < count, for a team of one lane. A team of several lanes shares the items: its
/// lanes hold the same numbers, call together, and get the answer of one lane.
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

/// Runs W team lanes in turn. `Accumulator` is value-initialised to its zero and has `+=`. Zeros are +0, and a rounded
/// sum is −0 only if both terms are −0. So omitting the empty lanes of a part changes no bit.
template <int W>
struct SerialTeam : OneLane {
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;  ///< W, team lanes

  /// Prefetches `bytes` from `rows` on into a cache, if that helps; does nothing here.
  OGC_HD static void prefetch(const void*, int) {}

  /// Replaces `sum` for a team without a vertex: all teams of a launch call `sum` or `leave`.
  OGC_HD static void leave() {}

  /// Returns Σ over all terms of all parts; in a team of threads only those with holds_total() get it.
  template <class Accumulator, class... Parts>
  OGC_HD Accumulator sum(const Parts&... parts) const {
    Accumulator lanes[W] = {};
    (add_part(parts, lanes), ...);
    for (int s = W / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) lanes[l] += lanes[l + s];
    }
    return lanes[0];
  }

  /// Returns whether this thread has the total; such threads may call `first` and `smallest` together.
  OGC_HD bool holds_total() const { return true; }
  /// Returns whether this thread writes the team's result; it also holds the total.
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
