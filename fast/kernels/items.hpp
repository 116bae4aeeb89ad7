// Reads the data of elements for the formulas of a kind. The formulas are written once, for one element (OneItem) or
// for several side by side on a CPU (fast/cpu/packed_items.hpp), and both give the same bits.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// A single element.
template <class Item>
struct OneItem {
  using Number = float;  ///< number type of the formulas
  const Item& item;

  /// `each` returns number(item), and `which` returns condition(item).
  template <class F>
  OGC_HD float each(F number) const {
    return number(item);
  }
  template <class F>
  OGC_HD bool which(F condition) const {
    return condition(item);
  }
  /// Returns the position of a vertex [m] in the buffer that the update reads; index(item) is its encoded index.
  template <class F>
  OGC_HD Vec position(const SweepShared& view, F index) const {
    return view.read(index(item));
  }
  /// Returns xᵗ of the vertex with the encoded index index(item) [m].
  template <class F>
  OGC_HD Vec start(const SweepShared& view, F index) const {
    return view.start[decoded(index(item))];
  }
};

}  // namespace ogc::fast
