// What the formulas of a kind read of its elements. They are written once, over what stands for the elements: one of
// them here, several side by side on a CPU (fast/cpu/packed_items.hpp), to the same bits.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// One element.
template <class Item>
struct OneItem {
  using Number = float;  ///< of the formulas
  const Item& item;

  /// Return number(item) and condition(item).
  template <class F>
  OGC_HD float each(F number) const {
    return number(item);
  }
  template <class F>
  OGC_HD bool which(F condition) const {
    return condition(item);
  }
  /// Returns the position of the vertex with the encoded index index(item), as the update of a vertex reads it [m].
  template <class F>
  OGC_HD Vec position(const SweepShared& view, F index) const {
    return view.read(index(item));
  }
  /// Returns xᵗ of that vertex [m].
  template <class F>
  OGC_HD Vec start(const SweepShared& view, F index) const {
    return view.start[decoded(index(item))];
  }
};

}  // namespace ogc::fast
