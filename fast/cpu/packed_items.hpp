// Items of a part of a vertex' sum, a pack of them at a time, and sums of packs.
#pragma once

#include "fast/cpu/pack.hpp"
#include "fast/kernels/accumulator.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// The items of a part that as many lanes begin with; places beyond the part repeat its last item, and are not counted.
template <class Item, class P>
struct Items {
  const Item* at[P::width];
  typename P::Mask counted;

  Items(const Item* first, int count) : counted(first_of<P>(count)) {
    for (int k = 0; k < P::width; ++k) at[k] = first + (k < count ? k : count - 1);
  }
  template <class F>
  P each(F number) const {
    return P::of_each([&](int k) { return number(*at[k]); });
  }
  /// place(item): where it is.
  template <class F>
  Vector<P> each_place(F place) const {
    const Place* places[P::width];
    for (int k = 0; k < P::width; ++k) places[k] = &place(*at[k]);
    return transposed<P>(places);
  }
};

template <class P>
Vector<P> everywhere(const Vec& a) {
  return {a.x, a.y, a.z};
}

template <class P>
ForceAndBlockOf<P> selected(typename P::Mask condition, const ForceAndBlockOf<P>& a, const ForceAndBlockOf<P>& b) {
  const Symmetric3Of<P>&p = a.block, &q = b.block;
  return {select(condition, a.force, b.force),
          {select(condition, p.xx, q.xx), select(condition, p.xy, q.xy), select(condition, p.xz, q.xz),
           select(condition, p.yy, q.yy), select(condition, p.yz, q.yz), select(condition, p.zz, q.zz)}};
}

}  // namespace packed
}  // namespace OGC_PACKS
}  // namespace ogc::fast
