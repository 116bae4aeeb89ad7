#include "reference/solvers/vertex_terms.hpp"

#include <algorithm>
#include <cmath>

#include "reference/energies/bending.hpp"
#include "reference/energies/membrane.hpp"
#include "reference/energies/rods/rod.hpp"
#include "reference/energies/spring.hpp"
#include "reference/energies/tetrahedron.hpp"
#include "reference/solvers/contacts.hpp"
#include "reference/solvers/rods/segment_questions.hpp"
#include "reference/solvers/symmetric3.hpp"

namespace ogc::reference {
namespace {

using compare::Index;

template <class Vertices>
void add_element(ElementsOfVertex& rows, std::size_t element, const Vertices& vertices) {
  std::size_t place = 0;
  for (const Index v : vertices) {
    if (v >= 0) rows[static_cast<std::size_t>(v)].emplace_back(element, place);
    ++place;
  }
}

float rounded(double x) { return static_cast<float>(x); }

/// Seen from one corner; the other two follow in the order of the mesh. ∇N₀ is not stored and is rounded here.
compare::MembraneCase membrane_question(const compare::SweepIn& in, const compare::RestTriangle& triangle,
                                        std::size_t corner, const SweepPositions& x) {
  const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(triangle.body)].material;
  const auto& g = triangle.gradient;
  const std::array<std::array<float, 2>, 3> gradient{
      {{rounded(-double{g[0][0]} - double{g[1][0]}), rounded(-double{g[0][1]} - double{g[1][1]})}, g[0], g[1]}};
  compare::MembraneCase question;
  for (std::size_t k = 0; k < 3; ++k) {
    const Index v = triangle.corner[(corner + k) % 3];
    question.corner[k] = x[v];
    question.start[k] = in.start[static_cast<std::size_t>(v)];
    if (k > 0) question.gradient[k - 1] = gradient[(corner + k) % 3];
  }
  question.area = triangle.area;
  question.lame_lambda = rounded(material.lame_lambda);
  question.lame_mu = rounded(material.lame_mu);
  question.damping = rounded(material.membrane_damping / in.scene->settings.time_step);
  question.model = material.membrane;
  question.damping_form = in.scene->settings.damping;
  return question;
}

compare::BendingCase bending_question(const compare::SweepIn& in, const compare::RestHinge& hinge, std::size_t role,
                                      const SweepPositions& x) {
  compare::BendingCase question;
  for (std::size_t k = 0; k < 4; ++k) {
    question.vertex[k] = x[hinge.vertex[k]];
    question.start[k] = in.start[static_cast<std::size_t>(hinge.vertex[k])];
  }
  question.stiffness = hinge.stiffness;
  question.rest_angle = hinge.rest_angle;
  const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(hinge.body)].material;
  question.damping = rounded(material.bending_damping / in.scene->settings.time_step);
  question.model = material.bending;
  question.weight = hinge.weight;
  question.damping_form = in.scene->settings.damping;
  question.own = static_cast<std::int32_t>(role);
  return question;
}

/// The second vertex for a third one that is not there.
std::array<Index, 3> ends_of(const compare::Spring& spring) {
  return {spring.first, spring.second, spring.third < 0 ? spring.second : spring.third};
}

compare::SpringCase spring_question(const compare::SweepIn& in, const compare::Spring& spring, std::size_t place,
                                    const SweepPositions& x) {
  const std::array<Index, 3> ends = ends_of(spring);
  compare::SpringCase question;
  question.own = static_cast<std::int32_t>(place);
  question.ratio = rounded(spring.ratio);
  for (std::size_t k = 0; k < 3; ++k) {
    question.vertex[k] = x[ends[k]];
    question.start[k] = in.start[static_cast<std::size_t>(ends[k])];
  }
  question.stiffness = rounded(spring.stiffness);
  question.rest_length = rounded(spring.rest_length);
  question.damping = rounded(spring.damping / in.scene->settings.time_step);
  question.damping_form = in.scene->settings.damping;
  return question;
}

/// The other corners in the order in which a corner sees a positive volume at rest: those of the face opposite to it.
constexpr std::array<std::array<std::size_t, 3>, 4> seen_from{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The index of V ∇N_k·∇N_l among the weights of a tetrahedron.
std::size_t index_of_pair(std::size_t k, std::size_t l) {
  const auto [low, high] = std::minmax(k, l);
  return low == 0 ? high - 1 : low + high;
}

/// ∇N₀ is not stored and is rounded here.
std::array<float, 3> gradient_of(const compare::RestTetrahedron& rest, std::size_t corner) {
  if (corner > 0) return rest.gradient[corner - 1];
  std::array<float, 3> own;
  for (std::size_t axis = 0; axis < 3; ++axis)
    own[axis] = rounded(-double{rest.gradient[0][axis]} - double{rest.gradient[1][axis]} -
                        double{rest.gradient[2][axis]});
  return own;
}

compare::TetrahedronCase tetrahedron_question(const compare::SweepIn& in, const compare::RestTetrahedron& rest,
                                              std::size_t corner, const SweepPositions& x) {
  const compare::Material& material = in.scene->bodies[static_cast<std::size_t>(rest.body)].material;
  compare::TetrahedronCase question;
  question.corner[0] = x[rest.corner[corner]];
  question.start[0] = in.start[static_cast<std::size_t>(rest.corner[corner])];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t other = seen_from[corner][k];
    question.corner[k + 1] = x[rest.corner[other]];
    question.start[k + 1] = in.start[static_cast<std::size_t>(rest.corner[other])];
    question.weight[k] = rest.weight[index_of_pair(corner, other)];
    question.gradient[k] = gradient_of(rest, other);
  }
  question.inverse = rest.inverse;
  question.volume = rest.volume;
  question.lame_lambda = rounded(material.solid_lambda);
  question.lame_mu = rounded(material.solid_mu);
  question.damping = rounded(material.solid_damping / in.scene->settings.time_step);
  question.damping_form = in.scene->settings.damping;
  return question;
}

}  // namespace

SweepStencils::SweepStencils(const compare::SweepIn& in) : body(body_of_vertex(*in.scene)) {
  const std::size_t count = in.old.size();
  for (ElementsOfVertex* rows :
       {&triangles, &hinges, &springs, &tetrahedra, &segments, &vertex_facet, &edge_edge, &volumes})
    rows->resize(count);
  for (std::size_t i = 0; i < in.rest->triangles.size(); ++i) add_element(triangles, i, in.rest->triangles[i].corner);
  for (std::size_t i = 0; i < in.rest->hinges.size(); ++i) add_element(hinges, i, in.rest->hinges[i].vertex);
  for (std::size_t i = 0; i < in.scene->springs.size(); ++i) {
    const compare::Spring& spring = in.scene->springs[i];
    if (spring.ratio > 0)
      add_element(springs, i, ends_of(spring));
    else
      add_element(springs, i, std::array{spring.first, spring.second});
  }
  for (std::size_t i = 0; i < in.rest->tetrahedra.size(); ++i)
    add_element(tetrahedra, i, in.rest->tetrahedra[i].corner);
  for (std::size_t i = 0; i < in.rest->segments.size(); ++i) add_element(segments, i, in.rest->segments[i].end);
  for (std::size_t i = 0; i < in.vertex_facet.size(); ++i)
    add_element(vertex_facet, i, stencil_of(*in.topology, in.vertex_facet[i]).vertex);
  for (std::size_t i = 0; i < in.edge_edge.size(); ++i)
    add_element(edge_edge, i, stencil_of(*in.topology, in.edge_edge[i]).vertex);
  for (std::size_t i = 0; i < in.volumes.size(); ++i) {
    const compare::VolumeContact& contact = in.volumes[i];
    const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(contact.triangle)];
    // where c is on the edge opposite to the point itself, the point is a corner that has no part in c
    const auto corner = [&](std::size_t k) { return contact.weights[k] == 0 ? -1 : corners[k]; };
    add_element(volumes, i, std::array{contact.point, corner(0), corner(1), corner(2)});
  }
}

Term term_of(std::vector<compare::ForceAnswer> accepted, double force_tolerance, double block_tolerance) {
  const compare::ForceAnswer exact = accepted.front();
  Term term{{exact}, force_tolerance, block_tolerance};
  for (std::size_t i = 1; i < accepted.size(); ++i) {
    const compare::ForceAnswer& other = accepted[i];
    Symmetric3 difference;
    for (std::size_t k = 0; k < 6; ++k) difference[k] = other.block[k] - exact.block[k];
    const double force = std::hypot(other.force.x - exact.force.x, other.force.y - exact.force.y,
                                    other.force.z - exact.force.z),
                 block = norm(difference);
    const double near_force = compare::unit_roundoff * force_tolerance * exact.force_scale;
    const double near_block = compare::unit_roundoff * block_tolerance * exact.block_scale;
    if (force > near_force || block > near_block || other.force_scale > 2 * exact.force_scale ||
        other.block_scale > 2 * exact.block_scale) {
      term.accepted.push_back(other);
      continue;
    }
    term.force_spread = std::max(term.force_spread, force + near_force);
    term.block_spread = std::max(term.block_spread, block + near_block);
  }
  return term;
}

VertexTerms terms_of_vertex(const compare::SweepIn& in, const SweepStencils& stencils, const SweepPositions& positions,
                            Index vertex) {
  const auto v = static_cast<std::size_t>(vertex);
  constexpr double inputs = compare::sweep_input_tolerance;
  VertexTerms sum;
  for (const auto& [triangle, corner] : stencils.triangles[v]) {
    const auto question = membrane_question(in, in.rest->triangles[triangle], corner, positions);
    sum.terms.push_back(term_of(membrane(question), compare::membrane_force_tolerance + inputs,
                                compare::membrane_block_tolerance + inputs));
  }
  for (const auto& [hinge, role] : stencils.hinges[v]) {
    const auto question = bending_question(in, in.rest->hinges[hinge], role, positions);
    sum.terms.push_back(term_of(bending(question), compare::bending_force_tolerance + inputs,
                                compare::bending_block_tolerance + inputs));
  }
  for (const auto& [spring, place] : stencils.springs[v]) {
    const auto question = spring_question(in, in.scene->springs[spring], place, positions);
    sum.terms.push_back(term_of({reference::spring(question)}, compare::spring_force_tolerance + inputs,
                                compare::spring_block_tolerance + inputs));
  }
  for (const auto& [tetrahedron, corner] : stencils.tetrahedra[v]) {
    const auto question = tetrahedron_question(in, in.rest->tetrahedra[tetrahedron], corner, positions);
    sum.terms.push_back(term_of({reference::tetrahedron(question)}, compare::tetrahedron_force_tolerance + inputs,
                                compare::tetrahedron_block_tolerance + inputs));
  }
  for (const auto& [segment, end] : stencils.segments[v]) {
    const compare::Edge& ends = in.rest->segments[segment].end;
    const auto question = rod_question(in, positions.answer(), segment, end, {positions[ends[0]], positions[ends[1]]});
    sum.terms.push_back(term_of({reference::rod(question)}, compare::rod_force_tolerance + inputs,
                                compare::rod_block_tolerance + inputs));
  }
  add_contact_terms(in, stencils, positions, vertex, sum);
  return sum;
}

}  // namespace ogc::reference
