#include "compare/judge/stages/contact_stencil.hpp"

namespace ogc::compare {

std::vector<std::string> contact_roles(ContactSides sides) {
  switch (sides) {
    case ContactSides::point_point: return {"vertex 0, the first point", "vertex 1, the second point"};
    case ContactSides::point_edge: return {"vertex 0, the point", "vertex 1, of the edge", "vertex 2, of the edge"};
    case ContactSides::edge_edge:
      return {"vertex 0, of the first edge", "vertex 1, of the first edge", "vertex 2, of the second edge",
              "vertex 3, of the second edge"};
    case ContactSides::point_triangle:
      return {"vertex 0, the point", "vertex 1, of the triangle", "vertex 2, of the triangle",
              "vertex 3, of the triangle"};
  }
  return {};
}

void check_contact(const ContactForceCase& c, FirstProblem& problem) {
  problem.require(c.own >= 0 && c.own < vertex_count(c.sides), "no such vertex is asked about");
  problem.require(c.together < 16, "bits of more than four vertices are set");
  problem.vectors("a coordinate", c.vertex);
  problem.vectors("a coordinate at the detection", c.previous);
  const auto count = static_cast<std::size_t>(vertex_count(c.sides));
  // Fourth powers of lengths occur only for triangles and pairs of edges (compare/stages/force.hpp).
  const float least_longest = count < 4 ? 0x1p-63f : 0x1p-30f;
  check_lengths(problem, std::span(c.vertex).first(count), 0x1p-63f, least_longest);
  check_lengths(problem, std::span(c.previous).first(count), 0x1p-63f, least_longest);
  problem.number("a contact radius", c.contact_radius, least_length, most_length);
  problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
  for (const float squared : c.rest_squared) problem.number("a squared rest length", squared, 0, 0x1p42f);
}

Shape contact_shape(const ContactForceCase& c) {
  Shape shape;
  shape.add_all(vertices_of(c.vertex, c.sides));
  if (c.sides == ContactSides::point_edge) shape.lines = {{1, 2}};
  if (c.sides == ContactSides::edge_edge) shape.lines = {{0, 1}, {2, 3}};
  if (c.sides == ContactSides::point_triangle) shape.triangles = {{1, 2, 3}};
  shape.dots.push_back(c.own);
  return shape;
}

void check_own(const ContactForceCase& c) {
  if (c.own >= vertex_count(c.sides))
    throw InputError("own: " + std::to_string(c.own) + " is not a vertex of these sides");
}

}  // namespace ogc::compare
