// Computes the sum over a vertex's stencils, a pack of team lanes at a time. Team lanes, their items and the order of
// all additions are those of SerialTeam, so the bits are the same (tests/fast/stages/sweep.cpp).
#pragma once

#include "fast/cpu/pack_kernels.hpp"
#include "fast/cpu/packed_contact.hpp"
#include "fast/cpu/packed_items.hpp"

namespace ogc::fast {
inline namespace OGC_PACKS {
namespace packed {

/// Returns P::width sums as one sum of packs, with sum k in lane k.
template <class P>
ForceAndBlockOf<P> together(const ForceAndBlock* a) {
  const auto each = [a](auto number) { return P::of_each([&](int k) { return number(a[k]); }); };
  using Sum = const ForceAndBlock&;
  return {{each([](Sum s) { return s.force.x; }), each([](Sum s) { return s.force.y; }),
           each([](Sum s) { return s.force.z; })},
          {each([](Sum s) { return s.block.xx; }), each([](Sum s) { return s.block.xy; }),
           each([](Sum s) { return s.block.xz; }), each([](Sum s) { return s.block.yy; }),
           each([](Sum s) { return s.block.yz; }), each([](Sum s) { return s.block.zz; })}};
}

/// Holds the W lanes of a team, P::width of them in a pack.
template <int W, class P>
struct TeamLanes {
  static_assert(W >= P::width);
  using Position = Vector<P>;              ///< of the vertex, the same in every lane
  ForceAndBlockOf<P> packs[W / P::width];  ///< team lane l in lane l mod P::width of pack l / P::width

  /// Adds a part of `count` items; add(items, sum) adds P::width of them at a time.
  template <class Item, class Add>
  void add_part(const Item* first, int count, Add add) {
    for (int lane = 0; lane < W && lane < count; lane += P::width) {
      ForceAndBlockOf<P> own;
      for (int k = lane; k < count; k += W) {
        const Items<Item, P> items(first + k, count - k);
        add_where(items.counted, own, [&](ForceAndBlockOf<P>& sum) { add(items, sum); });
      }
      packs[lane / P::width] += own;
    }
  }

  /// Adds a part that was computed item by item.
  void add_part(const TeamLaneSums& part) {
    for (int first = 0; first < W && first < part.count; first += P::width)
      packs[first / P::width] += together<P>(part.sums + first);
  }

  /// Returns the sum of all team lanes, added by the tree of SerialTeam.
  ForceAndBlock total() {
    for (int s = W / P::width / 2; s > 0; s /= 2) {
      for (int l = 0; l < s; ++l) packs[l] += packs[l + s];
    }
    const Vector<P>& f = packs[0].force;
    const Symmetric3Of<P>& b = packs[0].block;
    return {{whole(f.x), whole(f.y), whole(f.z)},
            {whole(b.xx), whole(b.xy), whole(b.xz), whole(b.yy), whole(b.yz), whole(b.zz)}};
  }

 private:
  static float whole(const P& a) {
    if constexpr (P::width == 4)
      return (a[0] + a[2]) + (a[1] + a[3]);
    else
      return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
  }
};

/// Adds the contacts of a slot, vertex–facet contacts first.
template <int W, class P>
void add_contact_parts(const SweepView& view, int slot, TeamLanes<W, P>& lanes) {
  const ContactRow row = view.contact_rows[slot];
  const auto add = [&](const Items<ContactIncidence, P>& items, ForceAndBlockOf<P>& sum) {
    sum += contact_term<PairKind::any>(view, OgcActivation{}, items);
  };
  lanes.add_part(view.contacts + row.vertex_facet.begin, row.vertex_facet.count, add);
  lanes.add_part(view.contacts + row.edge_edge.begin, row.edge_edge.count, add);
}

/// Returns the sum over a vertex's stencils. Adds the sums of a part if `alone` has them; otherwise computes the part
/// in packs.
template <int W, class Activation, class... Parts>
[[gnu::flatten]] ForceAndBlock gather(Gather<Activation, Parts...>, const SweepView& view, int slot,
                                      const SweepVertex& vertex, const Vec& own, const TeamLaneSums* alone) {
  using P = std::conditional_t<(W >= WidePack::width), WidePack, Pack>;
  const Vector<P> here = everywhere<P>(own);
  TeamLanes<W, P> lanes;
  const auto add = [&]<class Part>(Part, const TeamLaneSums& sums) {
    if (sums.sums != nullptr)
      lanes.add_part(sums);
    else if constexpr (has_packs<Part>)
      Part::add_packs(view, slot, vertex, here, lanes);
  };
  (add(Parts{}, *alone++), ...);
  add_contact_parts(view, slot, lanes);
  return lanes.total();
}

/// Implements GatherInPacks.
template <int W>
ForceAndBlock gather_all(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                         const TeamLaneSums* alone) {
  return gather<W>(GatherAll{}, view, slot, vertex, own, alone);
}

}  // namespace packed
}  // namespace OGC_PACKS
}  // namespace ogc::fast
