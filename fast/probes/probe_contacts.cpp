#include "fast/probes/probe_contacts.hpp"

namespace ogc::fast {

void append(ContactBatch& batch, const compare::ContactForceCase& contact, const std::array<compare::Vec3f, 4>& start,
            float friction, float slip_limit) {
  const int i = static_cast<int>(batch.role.size()), v = 4 * i;
  const int count = compare::vertex_count(contact.sides);
  const bool edge_edge = contact.sides == compare::ContactSides::edge_edge;
  batch.vertex_facet.push_back({v, {v + 1, count > 2 ? v + 2 : -1, count > 3 ? v + 3 : -1}});
  batch.edge_edge.push_back({{v, v + 1}, {v + 2, v + 3}, 2 * i, 2 * i + 1});
  batch.materials.push_back({contact.stiffness, friction});
  for (std::size_t k = 0; k < 4; ++k) {
    batch.positions.push_back(contact.vertex[k]);
    batch.previous.push_back(contact.previous[k]);
    batch.start.push_back(start[k]);
    batch.body.push_back(i);
  }
  batch.rest_squared.insert(batch.rest_squared.end(), contact.rest_squared.begin(), contact.rest_squared.end());
  batch.contact_radius.push_back(contact.contact_radius);
  batch.slip_limit.push_back(slip_limit);
  batch.role.push_back(contact.own);
  batch.is_edge_edge.push_back(edge_edge);
  batch.together.push_back(contact.together);
  batch.activation.push_back({contact.activation});
}

}  // namespace ogc::fast
