// Lists the kinds of elements. Code that treats all kinds alike iterates over this list.
#pragma once

#include <type_traits>

#include "fast/kernels/kinds/hinge.hpp"
#include "fast/kernels/kinds/segment.hpp"
#include "fast/kernels/kinds/spring.hpp"
#include "fast/kernels/kinds/tetrahedron.hpp"
#include "fast/kernels/kinds/triangle.hpp"

namespace ogc::fast {

template <class... Kinds>
struct KindList {
  struct Views : Kinds::View... {};

  /// The bit of a kind in the features of a sum (sweep_view.hpp). The bits follow the order of the list.
  template <class Kind>
  static constexpr unsigned bit = [] {
    unsigned next = first_kind_bit, own = 0;
    ((own |= std::is_same_v<Kind, Kinds> ? next : 0u, next *= 2), ...);
    return own;
  }();
  static constexpr unsigned bits = (bit<Kinds> | ...);

  /// Calls use(kind) for each kind, in order.
  template <class Use>
  static void for_each(const Use& use) {
    (use(Kinds{}), ...);
  }
};

/// A sum adds the parts of kinds in this order.
using Kinds = KindList<TriangleKind, HingeKind, SpringKind, TetrahedronKind, SegmentKind>;

/// Holds all data that the updates of a sweep read and write.
struct SweepView : SweepShared, Kinds::Views {};

}  // namespace ogc::fast
