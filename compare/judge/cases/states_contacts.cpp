// Takes pairs and contacts from real states. The authority computes the contact sets of a frame at the run's radius.
#include <algorithm>
#include <array>

#include "compare/judge/cases/states.hpp"
#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"

namespace ogc::compare {

namespace {

/// Returns the vertices of a face; missing ones are −1.
std::array<Index, 3> vertices_of(const Topology& topology, const Face& face) {
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case FaceKind::vertex: return {face.index, -1, -1};
    case FaceKind::edge: return {topology.edges[i][0], topology.edges[i][1], -1};
    case FaceKind::triangle: return topology.triangles[i];
  }
  return {};
}

/// Two sides in contact, with vertices in the order of ContactForceCase. If the interiors of two edges are in contact,
/// `edge` holds their indices, otherwise −1.
struct Stencil {
  ContactSides sides = ContactSides::point_point;
  std::array<Index, 4> vertex{-1, -1, -1, -1};
  std::array<Index, 2> edge{-1, -1};
};

Stencil stencil_of(const Topology& topology, const VertexFacetContact& contact) {
  const auto [a, b, c] = vertices_of(topology, contact.face);
  const ContactSides sides = c >= 0   ? ContactSides::point_triangle
                             : b >= 0 ? ContactSides::point_edge
                                      : ContactSides::point_point;
  return {sides, {contact.vertex, a, b, c}, {-1, -1}};
}

/// Returns the stencil of a contact. Vertices precede edges, so the first face is an edge only if both are.
Stencil stencil_of(const Topology& topology, const EdgeEdgeContact& contact) {
  const std::array<Index, 3> p = vertices_of(topology, contact.first), q = vertices_of(topology, contact.second);
  if (contact.first.kind == FaceKind::edge)
    return {ContactSides::edge_edge, {p[0], p[1], q[0], q[1]}, {contact.first.index, contact.second.index}};
  return {q[1] >= 0 ? ContactSides::point_edge : ContactSides::point_point, {p[0], q[0], q[1], -1}, {-1, -1}};
}

}  // namespace

const States::Contacts& States::contacts(std::size_t frame) const {
  const std::lock_guard lock(filling_);
  std::optional<Contacts>& found = contacts_[frame];
  if (!found) {
    const DetectIn in{topology_.get(),
                      {groups_, partners_.rows() > 0 ? &partners_ : nullptr},
                      states_[frame].positions,
                      contact_radius_,
                      contact_radius_};
    found = Contacts{authority_.detect_vertex_facet(in).exact.contacts, authority_.detect_edge_edge(in).exact.contacts};
  }
  return *found;
}

std::optional<std::size_t> States::frame_with_contact(std::size_t frame) const {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (const std::size_t at = (frame + i) % states_.size(); contacts(at).size() > 0) return at;
  return std::nullopt;
}

std::array<Index, 4> States::vertex_and_triangle(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
  Index v = random.below(topology_->vertex_count);
  const auto candidates = topology_->vertex_triangles[static_cast<std::size_t>(neighbour(state, v, random))];
  auto t = candidates.empty() ? static_cast<Index>(random.bits() % topology_->triangles.size())
                              : random.pick(candidates);
  if (const Contacts& found = contacts(frame); random.one_in(2) && !found.vertex_facet.empty()) {
    const VertexFacetContact& contact = found.vertex_facet[random.bits() % found.vertex_facet.size()];
    v = contact.vertex;
    t = contact.owner;
  }
  const Triangle& corner = topology_->triangles[static_cast<std::size_t>(t)];
  return {v, corner[0], corner[1], corner[2]};
}

std::array<Index, 4> States::pair_of_edges(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
  const Index v = random.below(topology_->vertex_count);
  const auto edge_of = [&](Index vertex) {
    const auto candidates = topology_->vertex_edges[static_cast<std::size_t>(vertex)];
    return candidates.empty() ? static_cast<Index>(random.bits() % topology_->edges.size()) : random.pick(candidates);
  };
  Index a = edge_of(v), b = edge_of(neighbour(state, v, random));
  if (const Contacts& found = contacts(frame); random.one_in(2) && !found.edge_edge.empty()) {
    const EdgeEdgeContact& contact = found.edge_edge[random.bits() % found.edge_edge.size()];
    a = contact.first_edge;
    b = contact.second_edge;
  }
  const Edge e = topology_->edges[static_cast<std::size_t>(std::min(a, b))],
             f = topology_->edges[static_cast<std::size_t>(std::max(a, b))];
  return {e[0], e[1], f[0], f[1]};
}

ClosestFaceCase States::vertex_triangle(std::size_t frame, Random& random) const {
  const auto [v, a, b, c] = vertex_and_triangle(frame, random);
  const std::vector<Vec3f>& x = states_[frame].positions;
  return {x[v], {x[a], x[b], x[c]}};
}

ClosestPointsCase States::edge_edge(std::size_t frame, Random& random) const {
  const auto [a, b, c, d] = pair_of_edges(frame, random);
  const std::vector<Vec3f>& x = states_[frame].positions;
  return {{x[a], x[b]}, {x[c], x[d]}};
}

MeetingMaterial States::meeting(Index v, Index w) const {
  const auto body = [&](Index vertex) { return static_cast<std::size_t>(body_[static_cast<std::size_t>(vertex)]); };
  return rest_.meetings[body(v) * scene_->bodies.size() + body(w)];
}

FrictionForceCase States::contact(std::size_t frame, Random& random) const {
  const Contacts& found = contacts(frame);
  const State& state = states_[frame];
  const std::size_t which = random.bits() % found.size(), count = found.vertex_facet.size();
  const Stencil met = which < count ? stencil_of(*topology_, found.vertex_facet[which])
                                    : stencil_of(*topology_, found.edge_edge[which - count]);
  const double part = random.one_in(4) ? 0 : random.one_in(2) ? 1 : random.unit();
  FrictionForceCase c;
  c.contact.sides = met.sides;
  c.contact.own = random.below(vertex_count(met.sides));
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(met.sides)); ++k) {
    c.contact.vertex[k] = moved(state, met.vertex[k], part);
    c.contact.previous[k] = c.start[k] = state.positions[static_cast<std::size_t>(met.vertex[k])];
  }
  if (met.sides == ContactSides::edge_edge)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto e = static_cast<std::size_t>(met.edge[k]);
      c.contact.rest_squared[k] = topology_->edge_triangles[e].empty() ? 0 : rest_.edge_length_squared[e];
    }
  const MeetingMaterial material = meeting(met.vertex[0], met.vertex[met.sides == ContactSides::edge_edge ? 2 : 1]);
  c.contact.contact_radius = contact_radius_;
  c.contact.stiffness = material.stiffness;
  c.contact.activation = scene_->settings.contact_activation;
  c.friction = material.friction;
  c.slip_limit = static_cast<float>(scene_->settings.friction_velocity * scene_->settings.time_step);
  return c;
}

ActivationCase States::contact_distance(std::size_t frame, Random& random) const {
  const Contacts& found = contacts(frame);
  const std::vector<Vec3f>& x = states_[frame].positions;
  const std::size_t which = random.bits() % found.size(), count = found.vertex_facet.size();
  double distance = 0;
  if (which < count) {
    const Triangle& t = topology_->triangles[static_cast<std::size_t>(found.vertex_facet[which].owner)];
    distance =
        authority_.closest_face({{x[found.vertex_facet[which].vertex]}, {{x[t[0]], x[t[1]], x[t[2]]}}}).distance[0];
  } else {
    const EdgeEdgeContact& contact = found.edge_edge[which - count];
    const Edge &e = topology_->edges[static_cast<std::size_t>(contact.first_edge)],
               &f = topology_->edges[static_cast<std::size_t>(contact.second_edge)];
    distance = authority_.closest_points({{{x[e[0]], x[e[1]]}}, {{x[f[0]], x[f[1]]}}}).contact_distance[0];
  }
  ActivationCase c{std::max(static_cast<float>(distance), 0x1p-23f * contact_radius_), contact_radius_, 1,
                   scene_->settings.contact_activation};
  const float stiffness = rest_.meetings[random.bits() % rest_.meetings.size()].stiffness;
  if (stiffness > 0) c.stiffness = stiffness;
  return c;
}

}  // namespace ogc::compare
