// Items of a part of a vertex' sum, four at a time, and sums of packs.
#pragma once

#include "fast/cpu/pack.hpp"
#include "fast/kernels/accumulator.hpp"

namespace ogc::fast::packed {

/// The four items of a part that four lanes begin with; places beyond the part repeat its last item, and are not counted.
template <class Item>
struct Items {
  const Item* at[Pack::width];
  PackMask counted;

  Items(const Item* first, int count) : counted(first_of(count)) {
    for (int k = 0; k < Pack::width; ++k) at[k] = first + (k < count ? k : count - 1);
  }
  template <class F>
  Pack each(F number) const {
    return {number(*at[0]), number(*at[1]), number(*at[2]), number(*at[3])};
  }
  /// place(item): where it is.
  template <class F>
  Vector<Pack> each_place(F place) const {
    return transposed(place(*at[0]), place(*at[1]), place(*at[2]), place(*at[3]));
  }
};

inline Vector<Pack> everywhere(const Vec& a) { return {a.x, a.y, a.z}; }

inline ForceAndBlockOf<Pack> select(PackMask condition, const ForceAndBlockOf<Pack>& a, const ForceAndBlockOf<Pack>& b) {
  const Symmetric3Of<Pack>&p = a.block, &q = b.block;
  return {fast::select(condition, a.force, b.force),
          {fast::select(condition, p.xx, q.xx), fast::select(condition, p.xy, q.xy), fast::select(condition, p.xz, q.xz), fast::select(condition, p.yy, q.yy),
           fast::select(condition, p.yz, q.yz), fast::select(condition, p.zz, q.zz)}};
}

}  // namespace ogc::fast::packed
