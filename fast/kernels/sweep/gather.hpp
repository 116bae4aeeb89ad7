// The sum over the stencils of a vertex without inertia: one template over kinds of elements. A part without items
// changes no bit (team.hpp), so the choice of a scene's sum only changes the time.
#pragma once

#include <type_traits>

#include "fast/kernels/kinds/kinds.hpp"
#include "fast/kernels/sweep/contacts.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Adds up these parts in this order, then vertex–facet contacts, then edge–edge contacts. A part's `gives` has the
/// bits of what it adds; `part_of` makes the part of a vertex.
template <class Activation, class... Parts>
struct Gather {
  /// number of parts: warps of a block if teams are spread (fast/cuda/team.cuh)
  static constexpr int parts = sizeof...(Parts) + 2;
  /// The features that this sum gives (bits of sweep_view.hpp). It gives `any_model` only if all of its parts do.
  static constexpr unsigned gives = ((Parts::gives | ...) & ~asks_any_model) | (Parts::gives & ... & asks_any_model) |
                                    (std::is_same_v<Activation, AnyActivation> ? asks_any_activation : 0u);
  /// Whether the sum adds contacts with volumes.
  static constexpr bool has_volumes = (gives & asks_volumes) != 0;

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    Activation activation;
    if constexpr (std::is_same_v<Activation, AnyActivation>) activation.activation = view.activation;
    const ContactParts<Activation> contacts{view, view.contact_rows[slot], activation};
    team.prefetch(view.contacts + contacts.row.begin, contacts.row.count * static_cast<int>(sizeof(ContactIncidence)));
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    return total(team, Parts::part_of(view, slot, vertex, at)..., contacts.vertex_facet(), contacts.edge_edge());
  }

 private:
  template <class Team, class... Own>
  OGC_HD static ForceAndBlock total(const Team& team, const Own&... parts) {
    (prefetch(team, parts), ...);
    return team.template sum<ForceAndBlock>(parts...);
  }
  /// Prefetches the row of a vertex, which the sum reads next.
  template <class Team, class AnyPart>
  OGC_HD static void prefetch(const Team& team, const AnyPart& part) {
    if constexpr (requires { part.load.first; })
      team.prefetch(part.load.first, part.count * static_cast<int>(sizeof(*part.load.first)));
  }
};

/// The sum that serves any scene.
using GatherAll = Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts, Segments>;

}  // namespace ogc::fast
