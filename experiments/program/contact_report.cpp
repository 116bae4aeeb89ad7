#include "experiments/program/contact_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "compare/problem/scene.hpp"
#include "compare/stages/bound.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::Face;
using compare::FaceKind;
using compare::Topology;
using compare::Vec3f;

/// Returns one case of closest_face for each contact, to obtain the contact's distance.
compare::ClosestFaceIn vertex_facet_cases(const ContactReport& report, const std::vector<Vec3f>& positions) {
  compare::ClosestFaceIn cases;
  for (const compare::VertexFacetContact& contact : report.vertex_facet.contacts) {
    const compare::Triangle& corners = report.topology.triangles[static_cast<std::size_t>(contact.owner)];
    cases.point.push_back(positions[static_cast<std::size_t>(contact.vertex)]);
    cases.triangle.push_back({positions[static_cast<std::size_t>(corners[0])],
                              positions[static_cast<std::size_t>(corners[1])],
                              positions[static_cast<std::size_t>(corners[2])]});
  }
  return cases;
}

compare::ClosestPointsIn edge_edge_cases(const ContactReport& report, const std::vector<Vec3f>& positions) {
  const auto ends = [&](compare::Index edge) {
    const compare::Edge& vertices = report.topology.edges[static_cast<std::size_t>(edge)];
    return std::array<Vec3f, 2>{positions[static_cast<std::size_t>(vertices[0])],
                                positions[static_cast<std::size_t>(vertices[1])]};
  };
  compare::ClosestPointsIn cases;
  for (const compare::EdgeEdgeContact& contact : report.edge_edge.contacts) {
    cases.first.push_back(ends(std::min(contact.first_edge, contact.second_edge)));
    cases.second.push_back(ends(std::max(contact.first_edge, contact.second_edge)));
  }
  return cases;
}

ExactGeometry exact_geometry(const ContactReport& report, FurtherSets further) {
  const reference::Complex mesh{report.topology, report.positions};
  ExactGeometry exact;
  for (compare::Index v = 0; v < report.topology.vertex_count; ++v) {
    exact.vertex_kind.push_back(reference::classify(mesh, v));
    if (further.ipc) exact.ipc.push_back(reference::ipc_face_set(mesh, v, report.contact_radius));
    if (further.sdf) exact.sdf.push_back(reference::sdf_face_set(mesh, mesh.at(v), report.contact_radius));
  }
  return exact;
}

void fill_exact(ContactReport& report, const compare::DetectIn& in, const std::vector<Vec3f>& positions,
                float bounds_relaxation, FurtherSets further) {
  const compare::Authority authority = reference::authority();
  const reference::FilterCounts before = reference::filter_counts();
  report.vertex_facet = authority.detect_vertex_facet(in).exact;
  report.edge_edge = authority.detect_edge_edge(in).exact;
  report.bound = authority
                     .bound({&report.topology, report.vertex_facet.d_min_vertex, report.edge_edge.d_min_edge,
                             report.vertex_facet.d_min_triangle, bounds_relaxation})
                     .exact.bound;
  report.vertex_facet_distance = authority.closest_face(vertex_facet_cases(report, positions)).distance;
  report.edge_edge_distance = authority.closest_points(edge_edge_cases(report, positions)).contact_distance;
  report.exact = exact_geometry(report, further);
  report.filters = reference::filter_counts().since(before);
}

void fill_fast(ContactReport& report, const compare::DetectIn& in, const std::vector<Vec3f>& positions,
               float bounds_relaxation, fast::Backend backend) {
  const compare::Contestant contestant = fast::contestant(backend);
  report.vertex_facet = contestant.detect_vertex_facet(in);
  report.edge_edge = contestant.detect_edge_edge(in);
  report.bound = contestant
                     .bound({&report.topology, report.vertex_facet.d_min_vertex, report.edge_edge.d_min_edge,
                             report.vertex_facet.d_min_triangle, bounds_relaxation})
                     .bound;
  const std::vector<float> facets = contestant.closest_face(vertex_facet_cases(report, positions)).distance;
  const std::vector<float> edges = contestant.closest_points(edge_edge_cases(report, positions)).contact_distance;
  report.vertex_facet_distance.assign(facets.begin(), facets.end());
  report.edge_edge_distance.assign(edges.begin(), edges.end());
}

std::string name(const Face& face, const Topology& topology, const compare::ElementNames& names) {
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case FaceKind::vertex: return names.vertex(face.index);
    case FaceKind::edge: return names.edge(topology.edges[i]);
    case FaceKind::triangle: return names.triangle(face.index, topology.triangles[i]);
  }
  return {};
}

/// Returns a histogram of the distances in tenths of r_q, and the number of primitives that have no neighbour within
/// r_q.
std::string distribution(const std::vector<float>& distances, float query_radius) {
  constexpr std::size_t parts = 10;
  std::array<std::size_t, parts + 1> counts{};
  for (const float d : distances)
    ++counts[d >= query_radius
                 ? parts
                 : std::min(parts - 1, static_cast<std::size_t>(static_cast<double>(d) / query_radius * parts))];
  const std::size_t most = std::max<std::size_t>(1, std::ranges::max(counts));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k <= parts; ++k) {
    const std::string range = k == parts ? "nothing within r_q"
                                         : number(static_cast<double>(k) * query_radius / parts) + " … " +
                                               number(static_cast<double>(k + 1) * query_radius / parts) + " m";
    rows.push_back({"  " + range, std::string(counts[k] * 40 / most, '#'), std::to_string(counts[k])});
  }
  return table(rows, 2);
}

/// Returns one line for each of the `limit` closest contacts, the closest contact first.
template <class Contacts, class Line>
std::string closest(const Contacts& contacts, const std::vector<double>& distances, Line line, std::size_t limit = 5) {
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return distances[i]; });
  order.resize(std::min(order.size(), limit));
  std::string text;
  for (const std::size_t i : order) text += "  " + number(distances[i], 6) + " m: " + line(contacts[i]) + "\n";
  return text;
}

std::string describe(const reference::FilterCounts& filters) {
  const reference::FilterCount total = filters.total();
  if (total.calls == 0) return {};
  std::vector<std::vector<std::string>> rows{{"  interval filter", "calls", "undecided", "share"}};
  const auto add = [&](std::string_view predicate, const reference::FilterCount& count) {
    if (count.calls == 0) return;
    const double share = static_cast<double>(count.undecided) / static_cast<double>(count.calls);
    rows.push_back({"  " + std::string(predicate), std::to_string(count.calls), std::to_string(count.undecided),
                    number(share, 2)});
  };
  for (std::size_t k = 0; k < reference::filtered_predicates; ++k)
    add(name(static_cast<reference::Filtered>(k)), filters.of[k]);
  add("all", total);
  return "\nexact predicates, and how many of them intervals left to exact numbers\n" + table(rows, 1);
}

}  // namespace

ContactReport find_contacts(const compare::Mesh& mesh, Engine engine, float contact_radius, float query_radius,
                            float bounds_relaxation, FurtherSets further) {
  ContactReport report;
  report.topology = compare::build_topology(mesh);
  report.contact_radius = contact_radius;
  report.query_radius = query_radius;
  const std::vector<Vec3f>& positions = report.positions = compare::to_single(mesh.positions);
  const std::vector<compare::Index> groups(positions.size(), -1);
  const compare::DetectIn in{&report.topology, groups, positions, contact_radius, query_radius};
  if (engine == Engine::exact) {
    fill_exact(report, in, positions, bounds_relaxation, further);
  } else {
    fill_fast(report, in, positions, bounds_relaxation,
              engine == Engine::cpu ? fast::Backend::cpu : fast::Backend::cuda);
  }
  return report;
}

double mean_edge_length(const compare::Mesh& mesh) {
  const Topology topology = compare::build_topology(mesh);
  double sum = 0;
  for (const compare::Edge& edge : topology.edges) {
    const compare::Vec3 &a = mesh.positions[static_cast<std::size_t>(edge[0])],
                        &b = mesh.positions[static_cast<std::size_t>(edge[1])];
    sum += std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  }
  return topology.edges.empty() ? 0 : sum / static_cast<double>(topology.edges.size());
}

Json exact_squares(const ContactReport& report, float bounds_relaxation) {
  const compare::DetectIn in{&report.topology, {}, report.positions, report.contact_radius, report.query_radius};
  reference::ExactSquares squares = reference::exact_squares(in, bounds_relaxation);
  return {{"d_min_vertex_squared", std::move(squares.vertex)},
          {"d_min_edge_squared", std::move(squares.edge)},
          {"d_min_triangle_squared", std::move(squares.triangle)},
          {"bound_squared", std::move(squares.bound)}};
}

std::string describe(const ContactReport& report, const compare::ElementNames& names) {
  const Topology& topology = report.topology;
  const auto [least, most] = std::ranges::minmax(report.bound);
  std::string text = std::to_string(topology.vertex_count) + " vertices, " + std::to_string(topology.edges.size()) +
                     " edges, " + std::to_string(topology.triangles.size()) +
                     " triangles; r = " + number(report.contact_radius, 6) +
                     " m, r_q = " + number(report.query_radius, 6) + " m\n\n" +
                     counted(report.vertex_facet.contacts.size(), "vertex-facet contact") + "\n";
  text += closest(report.vertex_facet.contacts, report.vertex_facet_distance,
                  [&](const compare::VertexFacetContact& contact) {
                    return names.vertex(contact.vertex) + " and " + name(contact.face, topology, names);
                  });
  text += counted(report.edge_edge.contacts.size(), "edge-edge contact") + "\n";
  text += closest(report.edge_edge.contacts, report.edge_edge_distance, [&](const compare::EdgeEdgeContact& contact) {
    return name(contact.first, topology, names) + " and " + name(contact.second, topology, names);
  });
  text += "\nsmallest distance of a vertex to a triangle without it\n" +
          distribution(report.vertex_facet.d_min_vertex, report.query_radius);
  text += "smallest distance of an edge to an edge without its ends\n" +
          distribution(report.edge_edge.d_min_edge, report.query_radius);
  return text + "\nbounds from " + number(least, 6) + " m to " + number(most, 6) + " m\n" + describe(report.filters);
}

}  // namespace ogc::experiments
