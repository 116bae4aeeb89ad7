// Sums force and block over the stencils of a vertex, without inertia. The template parameters are the parts, one for
// each kind of element. A part without items changes no bit (team.hpp), so a scene may use any sum that has all of its
// kinds: the choice only changes the time.
#pragma once

#include <type_traits>

#include "fast/kernels/kinds/kinds.hpp"
#include "fast/kernels/sweep/contacts.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Adds the parts in this order, then vertex–facet contacts, then edge–edge contacts. Each type in `Parts` has the bits
/// of the features that it computes (`gives`) and a function `part_of` that makes the part of a vertex.
template <class Activation, class... Parts>
struct Gather {
  /// number of parts, and so of warps in a block if each part has its own warp (fast/cuda/team.cuh)
  static constexpr int parts = sizeof...(Parts) + 2;
  /// Features that this sum computes (bits of sweep_view.hpp). It has asks_any_model only if all parts have it.
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
  /// Prefetches the incidences that the sum reads next.
  template <class Team, class AnyPart>
  OGC_HD static void prefetch(const Team& team, const AnyPart& part) {
    if constexpr (requires { part.load.first; })
      team.prefetch(part.load.first, part.count * static_cast<int>(sizeof(*part.load.first)));
  }
};

/// The sum for any scene.
using GatherAll = Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts, Segments>;

}  // namespace ogc::fast
