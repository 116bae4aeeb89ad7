// Reads items of a part of a vertex's sum, a pack at a time, and adds packs of sums.
#pragma once

#include "fast/cpu/pack.hpp"
#include "fast/kernels/items.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// The next items of a part, one for each lane. Lanes beyond the last item repeat that item and are not counted.
template <class Item, class P>
struct Items {
  const Item* at[P::width];  ///< by lane
  typename P::Mask counted;  ///< false in lanes beyond the part

  Items(const Item* first, int count) : counted(first_of<P>(count)) {
    for (int k = 0; k < P::width; ++k) at[k] = first + (k < count ? k : count - 1);
  }
  using Number = P;  ///< number type of the formulas

  /// `each` returns number(item) of each item, `which` a mask of the items for which condition(item) holds.
  template <class F>
  P each(F number) const {
    return P::of_each([&](int k) { return number(*at[k]); });
  }
  template <class F>
  typename P::Mask which(F condition) const {
    return each([&](const Item& item) { return condition(item) ? 1.0F : 0.0F; }) > P{};
  }
  /// Returns the positions of vertices as the update of a vertex reads them [m]. index(item): encoded index of the
  /// vertex.
  template <class F>
  Vector<P> position(const SweepShared& view, F index) const {
    return each_position([&](const Item& item) -> const PaddedVec& { return view.old[view.number(index(item))]; });
  }
  /// Returns xᵗ of vertices [m]. index(item): encoded index of the vertex.
  template <class F>
  Vector<P> start(const SweepShared& view, F index) const {
    return each_position([&](const Item& item) -> const PaddedVec& { return view.start.at[decoded(index(item))]; });
  }

 private:
  /// Returns the positions of all items. position(item) refers to the position of an item.
  template <class F>
  Vector<P> each_position(F position) const {
    const PaddedVec* padded[P::width];
    for (int k = 0; k < P::width; ++k) padded[k] = &position(*at[k]);
    return transposed<P>(padded);
  }
};

/// Returns the same vector in each lane.
template <class P>
Vector<P> everywhere(const Vec& a) {
  return {a.x, a.y, a.z};
}

}  // namespace packed

/// Returns a where the condition holds, else b.
template <class P>
ForceAndBlockOf<P> selected(typename P::Mask condition, const ForceAndBlockOf<P>& a, const ForceAndBlockOf<P>& b) {
  const Symmetric3Of<P>&p = a.block, &q = b.block;
  return {select(condition, a.force, b.force),
          {select(condition, p.xx, q.xx), select(condition, p.xy, q.xy), select(condition, p.xz, q.xz),
           select(condition, p.yy, q.yy), select(condition, p.yz, q.yz), select(condition, p.zz, q.zz)}};
}

/// Adds to `sum` in the lanes where the condition holds; the sums of other lanes keep their bits. add(sum) computes all
/// lanes.
template <int N, class Add>
void add_where(PackMaskOf<N> condition, ForceAndBlockOf<PackOf<N>>& sum, Add add) {
  if (is_false(condition)) return;
  ForceAndBlockOf<PackOf<N>> with = sum;
  add(with);
  sum = selected<PackOf<N>>(condition, with, sum);
}
}  // namespace OGC_PACKS
}  // namespace ogc::fast
