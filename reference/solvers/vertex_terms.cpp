#include "reference/solvers/vertex_terms.hpp"

#include <algorithm>
#include <cmath>

#include "reference/solvers/contacts.hpp"
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

/// Returns the vertices on which an element exerts forces, in the order of their places in the element.
template <class Kind, class Element>
auto acting(const Element& element) {
  if constexpr (requires { Kind::pulled(element); })
    return Kind::pulled(element);
  else
    return Kind::vertices(element);
}

}  // namespace

SweepStencils::SweepStencils(const compare::SweepIn& in) : body(body_of_vertex(*in.scene)) {
  const std::size_t count = in.old.size();
  for (ElementsOfVertex& rows : elements) rows.resize(count);
  for (ElementsOfVertex* rows : {&vertex_facet, &edge_edge, &volumes}) rows->resize(count);
  for_each_kind([&]<class Kind, std::size_t number>() {
    for (std::size_t i = 0; const auto& element : Kind::elements(*in.scene, *in.rest))
      add_element(elements[number], i++, acting<Kind>(element));
  });
  for (std::size_t i = 0; i < in.vertex_facet.size(); ++i)
    add_element(vertex_facet, i, stencil_of(*in.topology, in.vertex_facet[i]).vertex);
  for (std::size_t i = 0; i < in.edge_edge.size(); ++i)
    add_element(edge_edge, i, stencil_of(*in.topology, in.edge_edge[i]).vertex);
  for (std::size_t i = 0; i < in.volumes.size(); ++i) {
    const compare::VolumeContact& contact = in.volumes[i];
    const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(contact.triangle)];
    // If the point is a corner of the triangle and the closest point c is on the opposite edge, this corner has weight
    // 0.
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
  for_each_kind([&]<class Kind, std::size_t number>() {
    for (const auto& [element, place] : stencils.elements[number][v])
      sum.terms.push_back(term_of(Kind::answers(Kind::question(in, element, place, positions)),
                                  Kind::force_tolerance + inputs, Kind::block_tolerance + inputs));
  });
  add_contact_terms(in, stencils, positions, vertex, sum);
  return sum;
}

}  // namespace ogc::reference
