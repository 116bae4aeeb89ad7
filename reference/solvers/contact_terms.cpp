#include <array>

#include "reference/energies/contact_force.hpp"
#include "reference/energies/friction_force.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {
namespace {

using compare::ContactSides;
using compare::Index;

/// A contact as its stages ask for it: sides and vertices, which edges are mollified, which bodies meet.
struct Meeting {
  ContactSides sides = ContactSides::point_point;
  std::array<Index, 4> vertex{-1, -1, -1, -1};
  std::array<Index, 2> mollified{-1, -1};
};

Meeting meeting_of(const compare::SweepIn& in, const compare::VertexFacetContact& contact) {
  const auto facet = vertices_of(*in.topology, contact.face);
  constexpr std::array sides{ContactSides::point_point, ContactSides::point_edge, ContactSides::point_triangle};
  return {sides[static_cast<std::size_t>(contact.face.kind)], {contact.vertex, facet[0], facet[1], facet[2]}, {-1, -1}};
}

/// first < second as faces, so an edge is never followed by a vertex.
Meeting meeting_of(const compare::SweepIn& in, const compare::EdgeEdgeContact& contact) {
  const auto p = vertices_of(*in.topology, contact.first), q = vertices_of(*in.topology, contact.second);
  if (p[1] >= 0) return {ContactSides::edge_edge, {p[0], p[1], q[0], q[1]}, {contact.first.index, contact.second.index}};
  return {q[1] >= 0 ? ContactSides::point_edge : ContactSides::point_point, {p[0], q[0], q[1], -1}, {-1, -1}};
}

compare::FrictionForceCase question_of(const compare::SweepIn& in, const std::vector<Index>& body, const Meeting& meeting, std::size_t own,
                                       const SweepPositions& x) {
  compare::FrictionForceCase question;
  compare::ContactForceCase& contact = question.contact;
  contact.sides = meeting.sides;
  contact.own = static_cast<std::int32_t>(own);
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(meeting.sides)); ++k) {
    const auto v = static_cast<std::size_t>(meeting.vertex[k]);
    contact.vertex[k] = x[meeting.vertex[k]];
    contact.detected[k] = in.previous[v];
    question.start[k] = in.start[v];
  }
  if (meeting.mollified[0] >= 0 && !in.topology->triangles.empty())
    for (std::size_t k = 0; k < 2; ++k) contact.rest_squared[k] = in.rest->edge_length_squared[static_cast<std::size_t>(meeting.mollified[k])];
  const std::size_t other = meeting.sides == ContactSides::edge_edge ? 2 : 1;
  const auto a = static_cast<std::size_t>(body[static_cast<std::size_t>(meeting.vertex[0])]);
  const auto b = static_cast<std::size_t>(body[static_cast<std::size_t>(meeting.vertex[other])]);
  const compare::MeetingMaterial& material = in.rest->meetings[a * in.scene->bodies.size() + b];
  const compare::Settings& settings = in.scene->settings;
  contact.contact_radius = static_cast<float>(settings.contact_radius);
  contact.stiffness = material.stiffness;
  question.friction = material.friction;
  question.slip_limit = static_cast<float>(settings.friction_velocity * settings.time_step);
  return question;
}

void add_terms(const compare::FrictionForceCase& question, VertexTerms& sum) {
  constexpr double inputs = compare::sweep_input_tolerance;
  sum.terms.push_back(term_of(contact_force(question.contact), compare::contact_force_tolerance, compare::contact_block_tolerance));
  if (question.friction > 0)
    sum.terms.push_back(term_of(friction_force(question), compare::friction_force_tolerance + inputs, compare::friction_block_tolerance + inputs));
}

}  // namespace

void add_contact_terms(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions, Index vertex, VertexTerms& sum) {
  const auto v = static_cast<std::size_t>(vertex);
  for (const auto& [contact, own] : stencils.vertex_facet[v])
    add_terms(question_of(in, stencils.body, meeting_of(in, in.vertex_facet[contact]), own, positions), sum);
  for (const auto& [contact, own] : stencils.edge_edge[v])
    add_terms(question_of(in, stencils.body, meeting_of(in, in.edge_edge[contact]), own, positions), sum);
}

}  // namespace ogc::reference
