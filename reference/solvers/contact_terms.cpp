#include "reference/energies/contact_force.hpp"
#include "reference/energies/friction_force.hpp"
#include "reference/energies/volume_force.hpp"
#include "reference/solvers/contacts.hpp"
#include "reference/solvers/vertex_terms.hpp"

namespace ogc::reference {
namespace {

using compare::Index;

compare::FrictionForceCase question_of(const compare::SweepIn& in, const std::vector<Index>& body,
                                       const ContactStencil& stencil, std::size_t own, const SweepPositions& x) {
  compare::FrictionForceCase question;
  compare::ContactForceCase& contact = question.contact;
  contact.sides = stencil.sides;
  contact.own = static_cast<std::int32_t>(own);
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(stencil.sides)); ++k) {
    const auto v = static_cast<std::size_t>(stencil.vertex[k]);
    contact.vertex[k] = x[stencil.vertex[k]];
    contact.previous[k] = in.previous[v];
    question.start[k] = in.start[v];
    if (in.colour[v] == in.colour[static_cast<std::size_t>(stencil.vertex[own])])
      contact.together |= static_cast<std::uint8_t>(1u << k);
  }
  contact.rest_squared = mollified_rest_squared(*in.topology, *in.rest, stencil);
  const compare::MeetingMaterial& material = material_of(*in.rest, in.scene->bodies.size(), body, stencil);
  const compare::Settings& settings = in.scene->settings;
  contact.contact_radius = static_cast<float>(settings.contact_radius);
  contact.stiffness = material.stiffness;
  contact.activation = settings.contact_activation;
  question.friction = material.friction;
  question.slip_limit = static_cast<float>(settings.friction_velocity * settings.time_step);
  return question;
}

void add_terms(const compare::FrictionForceCase& question, VertexTerms& sum) {
  constexpr double inputs = compare::sweep_input_tolerance;
  sum.terms.push_back(
      term_of(contact_force(question.contact), compare::contact_force_tolerance, compare::contact_block_tolerance));
  if (question.friction > 0)
    sum.terms.push_back(term_of(friction_force(question), compare::friction_force_tolerance + inputs,
                                compare::friction_block_tolerance + inputs));
}

compare::VolumeForceCase question_of(const compare::SweepIn& in, const std::vector<Index>& body,
                                     const compare::VolumeContact& contact, std::size_t own, const SweepPositions& x) {
  const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(contact.triangle)];
  const std::array<Index, 4> vertex{contact.point, corners[0], corners[1], corners[2]};
  compare::VolumeForceCase question;
  question.own = static_cast<std::int32_t>(own);
  for (std::size_t k = 0; k < 4; ++k) {
    question.vertex[k] = x[vertex[k]];
    question.start[k] = in.start[static_cast<std::size_t>(vertex[k])];
  }
  question.weights = contact.weights;
  question.direction = {contact.direction.x, contact.direction.y, contact.direction.z};
  const auto body_of = [&](Index v) { return static_cast<std::size_t>(body[static_cast<std::size_t>(v)]); };
  const compare::MeetingMaterial& material =
      in.rest->meetings[body_of(contact.point) * in.scene->bodies.size() + body_of(corners[0])];
  const compare::Settings& settings = in.scene->settings;
  question.contact_radius = static_cast<float>(settings.contact_radius);
  question.stiffness = material.stiffness;
  question.friction = material.friction;
  question.slip_limit = static_cast<float>(settings.friction_velocity * settings.time_step);
  return question;
}

/// Returns Σ |w_u|/|w|, where w is the weight of the updated vertex. The sum is over the contact's vertices of the same
/// colour, including the updated vertex (method.md §7.4).
double majorant(const compare::SweepIn& in, const compare::VolumeContact& contact, std::size_t own) {
  const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(contact.triangle)];
  const std::array<Index, 4> vertex{contact.point, corners[0], corners[1], corners[2]};
  const std::array<double, 4> weight{1, contact.weights[0], contact.weights[1], contact.weights[2]};
  const auto colour = [&](std::size_t k) { return in.colour[static_cast<std::size_t>(vertex[k])]; };
  double sum = weight[own];
  for (std::size_t k = 0; k < 4; ++k) sum += k != own && colour(k) == colour(own) ? weight[k] : 0;
  return sum / weight[own];
}

std::vector<compare::ForceAnswer> majorised(std::vector<compare::ForceAnswer> answers, double factor) {
  for (compare::ForceAnswer& answer : answers) {
    for (double& entry : answer.block) entry *= factor;
    answer.block_scale *= factor;
  }
  return answers;
}

/// Roundings that the factor of `majorant` adds to a block: up to three additions of moduli. The block has the factor
/// |w| in place of w², which adds no rounding.
constexpr double majorant_tolerance = 3;

}  // namespace

void add_contact_terms(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                       Index vertex, VertexTerms& sum) {
  const auto v = static_cast<std::size_t>(vertex);
  const auto add = [&](const ContactStencil& stencil, std::size_t own) {
    add_terms(question_of(in, stencils.body, stencil, own, positions), sum);
  };
  for (const auto& [contact, own] : stencils.vertex_facet[v])
    add(stencil_of(*in.topology, in.vertex_facet[contact]), own);
  for (const auto& [contact, own] : stencils.edge_edge[v]) add(stencil_of(*in.topology, in.edge_edge[contact]), own);
  for (const auto& [contact, own] : stencils.volumes[v]) {
    constexpr double inputs = compare::sweep_input_tolerance;
    const double factor = majorant(in, in.volumes[contact], own);
    sum.terms.push_back(
        term_of(majorised(volume_force(question_of(in, stencils.body, in.volumes[contact], own, positions)), factor),
                compare::volume_force_tolerance + inputs,
                compare::volume_block_tolerance + inputs + (factor > 1 ? majorant_tolerance : 0)));
  }
}

}  // namespace ogc::reference
