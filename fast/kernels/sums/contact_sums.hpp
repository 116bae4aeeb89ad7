// Sums the contacts of each vertex for fast/contact_forces.hpp. Conversion and formulas are those of the sweep. A
// contact is converted when its term is computed, so no stream is stored.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/sums/step_sums.hpp"
#include "fast/kernels/sweep/contacts.hpp"

namespace ogc::fast {

/// Copies positions and start positions into aligned vectors. Runs once for each vertex.
struct PadPositions {
  const Vec *position, *start;  ///< by vertex [m]; `start` may be null
  PaddedVec *padded, *padded_start;

  OGC_HD void operator()(int v) const {
    padded[v] = PaddedVec(position[v]);
    if (start != nullptr) padded_start[v] = PaddedVec(start[v]);
  }
};

/// Holds force and block of contacts with friction, and the force of friction alone.
struct ContactSum {
  ForceAndBlock all;
  Vec friction;  ///< [N]

  /// Adds another sum; each addition is rounded separately (ForceAndBlockOf).
  OGC_HD ContactSum& operator+=(const ContactSum& other) {
    all += other.all;
    friction = {add(friction.x, other.friction.x), add(friction.y, other.friction.y),
                add(friction.z, other.friction.z)};
    return *this;
  }
};

/// Returns the force of a contact's friction alone. A difference of two sums would have the rounding errors of both.
template <PairKind pairs, class Activation>
OGC_HD Vec friction_alone(const SweepShared& view, const Activation& activation, const ContactIncidence& contact) {
  const auto at = contacts_at<pairs>(view, OneItem<ContactIncidence>{contact});
  ForceAndBlock normal, friction;
  if (!at.acts()) return {};
  const float normal_force = add_contact(activation, at.shape, at.weight, at.majorant, view.contact_radius,
                                         contact.stiffness, normal);
  add_contact_friction(at, normal_force, view.friction_limit, friction);
  return friction.force;
}

/// Sums the contacts of a vertex as the sweep does: vertex–facet contacts, then edge–edge contacts. One team runs for
/// each vertex.
struct SumContacts {
  /// number of parts of the sum; the first one is empty, because a device's teams need one that is not pooled
  static constexpr int parts = 3;
  ResolveContact resolve;  ///< its stream is not used
  const ContactRow* rows;  ///< by vertex
  SweepShared at;          ///< positions, xᵗ, r and ε_v h
  AnyActivation activation;
  Vec *force, *friction;  ///< by vertex, written if not null [N]
  Symmetric3* block;      ///< by vertex, written if not null [N/m]

  template <class Team>
  OGC_HD void operator()(int v, const Team& team) const {
    const ContactRow row = rows[v];
    const auto nothing = part(
        0, [](int k) { return k; }, [](int, ContactSum&) {});
    const ContactSum sum = team.template sum<ContactSum>(
        nothing, part_of<PairKind::vertex_facet>(row.vertex_facet.begin, row.vertex_facet.count),
        part_of<PairKind::edge_edge>(row.edge_edge.begin, row.edge_edge.count));
    if (!team.leader()) return;
    if (force != nullptr) force[v] = sum.all.force;
    if (friction != nullptr) friction[v] = sum.friction;
    if (block != nullptr) block[v] = sum.all.block;
  }

 private:
  template <PairKind pairs>
  OGC_HD auto part_of(int begin, int count) const {
    return pooled_part(
        begin, count, [incidences = resolve.view.incidences](int i) { return incidences[i]; },
        [own = this](Incidence incidence) { return own->template term<pairs>(incidence); });
  }
  template <PairKind pairs>
  OGC_HD ContactSum term(Incidence incidence) const {
    ContactIncidence contact;
    ResolveContact here = resolve;
    here.stream = &contact;
    here(0, incidence, here.record(incidence));
    ContactSum sum{contact_term<pairs>(at, activation, OneItem<ContactIncidence>{contact}), {}};
    if (friction != nullptr && contact.friction > 0) sum.friction = friction_alone<pairs>(at, activation, contact);
    return sum;
  }
};

/// Columns of the sums of energies [J].
enum ContactColumn : int { contact_vertex_facet, contact_edge_edge, contact_columns };

/// Sums the energies of all contacts as the report of a step does.
struct ContactEnergies {
  VertexFacetTerm vertex_facet;
  EdgeEdgeTerm edge_edge;

  /// Adds every `chunks`-th term, beginning with term `chunk`, to `sums`, which ContactColumn indexes.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    double all[sum_columns] = {};
    add_terms(vertex_facet, *vertex_facet.view.vertex_facet_count, chunk, chunks, all);
    add_terms(edge_edge, *edge_edge.view.edge_edge_count, chunk, chunks, all);
    sums[contact_vertex_facet] += all[sum_vertex_facet];
    sums[contact_edge_edge] += all[sum_edge_edge];
  }
};

}  // namespace ogc::fast
