// Which vertices the guess loop holds: those of an active contact. A round asks no more of its contacts than that, so
// marks stand in place of lists.
#pragma once

#include "fast/kernels/collect_contacts.hpp"
#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/control.hpp"

namespace ogc::fast {

/// Marks the vertices of each active contact among the noted pairs. Index over these pairs. Nothing is held in the
/// first round, and nothing marked.
struct MarkTouched {
  static constexpr int resident_blocks = CollectContacts::resident_blocks;
  CollectContacts collect;     ///< decides which pairs are contacts; up to r and the margin
  const Vec* position;         ///< X_prev by vertex [m]
  float radius;                ///< r [m]
  const StepControl* control;  ///< its rounds are read
  int* touched;                ///< by vertex, 0 before; 1 where a contact acts on it

  OGC_HD void operator()(int i) const {
    if (control->rounds == 0 || *collect.lists.overflow != 0) return;
    if (are_marked(collect.vertices(i))) return;  // whatever the pair is, it marks no other
    const RawContact contact = collect.contact(i);
    if (contact.bucket < 0) return;
    const ContactFaces faces{collect.edge_edge.surface};
    const RoleVertices of = faces.vertices(contact.bucket, contact.second);
    const bool has_margin = radius < collect.edge_edge.contact_radius;
    if (has_margin && !acts(faces.is_vertex_facet(contact.bucket), of.role)) return;
    for (const int v : of.role)
      if (v >= 0) raise(&touched[v]);
  }

 private:
  OGC_HD bool are_marked(const RoleVertices& vertices) const {
    bool all = true;
    for (const int v : vertices.role) all = all && atomic_load(&touched[v]) != 0;
    return all;
  }

  OGC_HD static void raise(int* mark) {
    if (atomic_load(mark) == 0) atomic_max(mark, 1);
  }

  OGC_HD bool acts(bool is_vertex_facet, const int* role) const {
    ContactIncidence contact;
    if (is_vertex_facet)
      set_slots(contact, VertexFacetRecord{role[0], {role[1], role[2], role[3]}});
    else
      set_slots(contact, EdgeEdgeRecord{{role[0], role[1]}, {role[2], role[3]}, -1, -1});
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = position[contact.index[k]];
    return contact_shape(weighted_sum(contact_weights(contact.kind, x), x), radius).acts;
  }
};

}  // namespace ogc::fast
