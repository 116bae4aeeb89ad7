// Sums force and block over the stencils of a vertex, without inertia. The template parameters are the parts, one for
// each kind of element. A part without items changes no bit (team.hpp). So all sums that have the kinds of a scene give
// the same bits; the choice of a sum only changes the time.
#pragma once

#include <type_traits>

#include "fast/kernels/kinds/kinds.hpp"
#include "fast/kernels/sweep/contacts.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Adds the parts in the order of `Parts`, then vertex–facet contacts, then edge–edge contacts. Each type in `Parts`
/// has the bits of the features that it computes (`gives`) and a function `part_of` that makes the part of a vertex.
template <class Activation, class... Parts>
struct Gather {
  /// number of parts of the sum; a block has a warp for each part if teams are spread (fast/cuda/team.cuh)
  static constexpr int parts = sizeof...(Parts) + 2;
  /// Bits of all features that this sum computes. It has a bit of `asks_any_model` only if all of its parts have this
  /// bit.
  static constexpr unsigned gives = ((Parts::template gives<Kinds> | ...) & ~asks_any_model) |
                                    (Parts::template gives<Kinds> & ... & asks_any_model) |
                                    (std::is_same_v<Activation, AnyActivation> ? asks_any_activation : 0u);
  static constexpr bool has_volumes = (gives & asks_volumes) != 0;

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    Activation activation;
    if constexpr (std::is_same_v<Activation, AnyActivation>) activation.activation = view.activation;
    const ContactParts<Activation> contacts{view, view.contact_rows[slot], activation};
    const auto prefetch_row = [&](const Row& row) {
      team.prefetch(view.contacts + row.begin, row.count * static_cast<int>(sizeof(ContactIncidence)));
    };
    prefetch_row(contacts.row.vertex_facet), prefetch_row(contacts.row.edge_edge);
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    return total(team, Parts::part_of(view, slot, vertex, at)..., contacts.vertex_facet(), contacts.edge_edge());
  }

 private:
  template <class Team, class... Own>
  OGC_HD static ForceAndBlock total(const Team& team, const Own&... parts) {
    (prefetch(team, parts), ...);
    return team.template sum<ForceAndBlock>(parts...);
  }
  /// Prefetches the incidences that the sum reads next.
  template <class Team, class AnyPart>
  OGC_HD static void prefetch(const Team& team, const AnyPart& part) {
    if constexpr (requires { part.load.first; })
      team.prefetch(part.load.first, part.count * static_cast<int>(sizeof(*part.load.first)));
  }
};

/// The sum that adds the part `Whole` of each kind in a list. The part for contacts with volumes precedes the part of
/// the last kind.
template <class Kinds, class... Before>
struct WholeSum;
template <class Last, class... Before>
struct WholeSum<KindList<Last>, Before...> {
  using Sum = Gather<AnyActivation, Before..., VolumeContacts, typename Last::Whole>;
};
template <class Next, class... More, class... Before>
struct WholeSum<KindList<Next, More...>, Before...> : WholeSum<KindList<More...>, Before..., typename Next::Whole> {};

/// The sum that serves every scene.
using GatherAll = WholeSum<Kinds>::Sum;

}  // namespace ogc::fast
