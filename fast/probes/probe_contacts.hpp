// Lets the judge test contacts. Each case becomes one record of a detection. The sweep's functions make its incidence,
// including the mollifier, and compute its force and block. Friction is computed alone, because a difference of two
// sums would contain the rounding errors of both.
#pragma once

#include <array>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "compare/stages/friction_force.hpp"
#include "fast/kernels/contact_stream.hpp"
#include "fast/probes/probe_forces.hpp"
#include "fast/probes/probe_memory.hpp"

namespace ogc::fast {

/// Holds cases as records. Case i has the vertices 4 i … 4 i + 3, body i and the edges 2 i and 2 i + 1.
struct ContactBatch {
  /// by case; is_edge_edge selects which of the two records is used
  std::vector<VertexFacetRecord> vertex_facet;
  std::vector<EdgeEdgeRecord> edge_edge;
  std::vector<ContactMaterial> materials;                       ///< by body: k_c [N/m], μ [1]
  std::vector<compare::Vec3f> positions, previous, start;       ///< by vertex: x, X_prev, xᵗ [m]
  std::vector<float> rest_squared, contact_radius, slip_limit;  ///< by edge [m²]; by case: r, ε_v h [m]
  std::vector<int> body, role;  ///< `body`: by vertex; `role`: by case (contact_view.hpp)
  /// by case; bit k of `together` is set if the vertex of role k has the colour of the case's own vertex
  std::vector<std::uint8_t> is_edge_edge, together;
  std::vector<AnyActivation> activation;  ///< by case
};

/// Adds a case with its coefficient of friction.
void append(ContactBatch& batch, const compare::ContactForceCase& contact, const std::array<compare::Vec3f, 4>& start,
            float friction, float slip_limit);

/// Computes force and block of a contact. Runs once for each case.
struct ProbeContact {
  SweepView view;  ///< positions and xᵗ; radius and slip limit are set for each case
  ContactTables tables;
  /// arrays of a ContactBatch, on the backend
  const VertexFacetRecord* vertex_facet;
  const EdgeEdgeRecord* edge_edge;
  const float *contact_radius, *slip_limit;
  const int* role;
  const std::uint8_t *is_edge_edge, *together;
  const AnyActivation* activation;
  bool friction;    ///< true: friction only; false: the normal force only
  ForceArrays out;  ///< by case, written

  OGC_HD void operator()(int i) const {
    SweepView here = view;
    here.contact_radius = contact_radius[i];
    here.friction_limit = slip_limit[i];
    ContactIncidence incidence = is_edge_edge[i] != 0 ? contact_of(tables, edge_edge[i])
                                                      : contact_of(tables, vertex_facet[i]);
    incidence.own = slot_of_role(is_edge_edge[i] != 0, incidence.kind, role[i]);
    for (int k = 0; k < 4; ++k) {
      const int slot = slot_of_role(is_edge_edge[i] != 0, incidence.kind, k);
      if (k != role[i] && (together[i] >> k & 1) != 0) incidence.together |= static_cast<std::uint8_t>(1 << slot);
    }
    ForceAndBlock sum;
    const auto at = contacts_at<PairKind::any>(here, OneItem<ContactIncidence>{incidence});
    if (at.acts()) {
      ForceAndBlock normal;
      const float normal_force = add_contact(activation[i], at.shape, at.weight, at.majorant, here.contact_radius,
                                             incidence.stiffness, normal);
      if (friction)
        add_contact_friction(at, normal_force, here.friction_limit, sum);
      else
        sum = normal;
    }
    out.store(i, sum);
  }
};

/// Returns the forces of all cases of a batch: only friction, or only normal forces.
template <class Backend>
compare::ForceOut probe_contacts(Backend& backend, const ContactBatch& batch, bool friction) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  SweepView view;
  view.old = memory.padded(batch.positions);
  view.start = {memory.padded(batch.start)};
  // With a body count of 0, the material of a pair is that of its second body. Each case has its own second body.
  const ContactTables tables{memory.template in<int>(batch.body), memory.template in<ContactMaterial>(batch.materials),
                             0, memory.template in<float>(batch.rest_squared), memory.template in<Vec>(batch.previous)};
  const std::size_t n = batch.role.size();
  backend.for_each(static_cast<int>(n),
                   ProbeContact{.view = view,
                                .tables = tables,
                                .vertex_facet = memory.template in<VertexFacetRecord>(batch.vertex_facet),
                                .edge_edge = memory.template in<EdgeEdgeRecord>(batch.edge_edge),
                                .contact_radius = memory.template in<float>(batch.contact_radius),
                                .slip_limit = memory.template in<float>(batch.slip_limit),
                                .role = memory.template in<int>(batch.role),
                                .is_edge_edge = memory.template in<std::uint8_t>(batch.is_edge_edge),
                                .together = memory.template in<std::uint8_t>(batch.together),
                                .activation = memory.template in<AnyActivation>(batch.activation),
                                .friction = friction,
                                .out = force_arrays(memory, out, n)});
  memory.fetch();
  return out;
}

/// Answers the stage `contact_force`.
template <class Backend>
compare::ForceOut probe_contact_force(Backend& backend, const compare::ContactForceIn& in) {
  ContactBatch batch;
  for (const compare::ContactForceCase& c : in.cases) append(batch, c, c.vertex, 0, 1);
  return probe_contacts(backend, batch, false);
}

/// Answers the stage `friction_force`.
template <class Backend>
compare::ForceOut probe_friction_force(Backend& backend, const compare::FrictionForceIn& in) {
  ContactBatch batch;
  for (const compare::FrictionForceCase& c : in.cases) append(batch, c.contact, c.start, c.friction, c.slip_limit);
  return probe_contacts(backend, batch, true);
}

}  // namespace ogc::fast
