// Writes the keys of contacts.schema.json, which explains them; a test validates the output against the schema.
// Contacts are printed as they are computed, because one JSON value for 245,000 crowded vertices with margins exceeds
// 20 GB.
#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiments/program/contact_report.hpp"

namespace ogc::experiments {

namespace {

using compare::at, compare::Index;
using compare::Face;
using compare::FaceKind;
using compare::Topology;

const char* name(FaceKind kind) {
  return kind == FaceKind::vertex ? "vertex" : kind == FaceKind::edge ? "edge" : "triangle";
}

Json to_json(const Face& face) { return {{"kind", name(face.kind)}, {"index", face.index}}; }

Json to_json(const Face& face, const Topology& topology) {
  Json json = to_json(face);
  json["vertices"] = {face.index};
  if (face.kind == FaceKind::edge) json["vertices"] = topology.edges[at(face.index)];
  if (face.kind == FaceKind::triangle) json["vertices"] = topology.triangles[at(face.index)];
  return json;
}

Json to_json(const std::vector<reference::BlockMargin>& margins) {
  constexpr std::array<const char*, 3> kinds{"sphere", "end", "wall"};
  Json json = Json::array();
  for (const reference::BlockMargin& margin : margins)
    json.push_back({{"boundary", kinds[static_cast<std::size_t>(margin.kind)]},
                    {"across", to_json(margin.across)},
                    {"sign", margin.sign},
                    {"length", margin.length},
                    {"closed", margin.closed}});
  return json;
}

/// Writes to standard output in large pieces.
class Printer {
 public:
  void member(const std::string& key, const Json& value) {
    add(begin(key) + value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

  /// Writes an array of `count` items, one line each.
  template <class Item>
  void list(const std::string& key, std::size_t count, Item item) {
    add(begin(key) + "[");
    for (std::size_t i = 0; i < count; ++i) add((i == 0 ? "\n    " : ",\n    ") + item(i).dump());
    add(count == 0 ? "]" : "\n  ]");
  }

  void finish() { print_result(std::exchange(text_, {}) + "\n}\n"); }

 private:
  std::string begin(const std::string& key) { return std::exchange(separator_, ",\n  ") + Json(key).dump() + ": "; }
  void add(const std::string& piece) {
    constexpr std::size_t enough = 1 << 20;
    text_ += piece;
    if (text_.size() > enough) print_result(std::exchange(text_, {}));
  }
  std::string text_, separator_ = "{\n  ";
};

/// Returns the counts of each predicate that was evaluated.
Json to_json(const reference::FilterCounts& filters) {
  Json json = Json::object();
  for (std::size_t k = 0; k < reference::filtered_predicates; ++k) {
    const reference::FilterCount& count = filters.of[k];
    if (count.calls > 0)
      json[std::string(name(static_cast<reference::Filtered>(k)))] = {{"calls", count.calls},
                                                                      {"undecided", count.undecided}};
  }
  return json;
}

Json vertex_facet(const ContactReport& report, bool with_margins, std::size_t i) {
  const compare::VertexFacetContact& contact = report.vertex_facet.contacts[i];
  const double distance = report.vertex_facet_distance[i];
  Json json{{"vertex", contact.vertex},
            {"face", to_json(contact.face, report.topology)},
            {"owner", contact.owner},
            {"distance", distance},
            {"penetration", static_cast<double>(report.contact_radius) - distance}};
  if (!with_margins) return json;
  const reference::Complex mesh{report.topology, report.positions};
  const auto margins = reference::block_margins(mesh, contact.face, mesh.at(contact.vertex), report.contact_radius);
  json["penetration"] = margins.front().length;
  json["margins"] = to_json(margins);
  return json;
}

Json edge_edge(const ContactReport& report, bool with_margins, std::size_t i) {
  const compare::EdgeEdgeContact& contact = report.edge_edge.contacts[i];
  const double distance = report.edge_edge_distance[i];
  Json json{{"first", to_json(contact.first, report.topology)},
            {"second", to_json(contact.second, report.topology)},
            {"first_edge", contact.first_edge},
            {"second_edge", contact.second_edge},
            {"distance", distance},
            {"penetration", static_cast<double>(report.contact_radius) - distance}};
  if (!with_margins) return json;
  const reference::PairMargins margins = reference::pair_margins({report.topology, report.positions}, contact,
                                                                 report.contact_radius);
  json["first_margins"] = to_json(margins.first);
  json["second_margins"] = to_json(margins.second);
  return json;
}

Json sets_by_primitive(const ContactReport& report) {
  const auto& facets = report.vertex_facet.contacts;
  std::vector<std::vector<std::size_t>> of_vertex(at(report.topology.vertex_count));
  for (std::size_t i = 0; i < facets.size(); ++i) of_vertex[at(facets[i].vertex)].push_back(i);
  Json json{{"faces_near_vertex", of_vertex},
            {"vertices_near_facet", reference::vertices_near_facets(report.topology, facets)},
            {"edges_near_edge", reference::contacts_of_edges(report.topology, report.edge_edge.contacts)},
            {"layers", reference::layers(report.topology, facets)}};
  if (report.exact && !report.exact->ipc.empty()) json["ipc"] = report.exact->ipc;
  if (report.exact && !report.exact->sdf.empty()) json["sdf"] = report.exact->sdf;
  return json;
}

/// Returns "loose", "boundary", "inner" or "non_manifold" for each edge: it has 0, 1, 2 or more triangles.
std::vector<std::string> edge_places(const Topology& topology) {
  constexpr std::array<const char*, 3> places{"loose", "boundary", "inner"};
  std::vector<std::string> all;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const std::size_t count = topology.edge_triangles[e].size();
    all.emplace_back(count < places.size() ? places[count] : "non_manifold");
  }
  return all;
}

/// Returns one of the words of edge_places for each vertex, derived from the words of its edges (contacts.schema.json).
/// In a valid mesh each vertex has an edge.
std::vector<std::string> vertex_places(const Topology& topology) {
  const std::vector<std::string> edges = edge_places(topology);
  std::vector<std::string> all;
  for (std::size_t v = 0; v < at(topology.vertex_count); ++v) {
    const auto has = [&](const char* place) {
      return std::ranges::any_of(topology.vertex_edges[v], [&](Index e) { return edges[at(e)] == place; });
    };
    const bool on_triangle = has("inner") || has("boundary");
    const bool odd = has("non_manifold") || (has("loose") && on_triangle);
    all.emplace_back(odd ? "non_manifold" : has("boundary") ? "boundary" : on_triangle ? "inner" : "loose");
  }
  return all;
}

}  // namespace

void print_json(const Json& head, const ContactReport& report, bool with_margins) {
  constexpr std::array<const char*, 3> kinds{"convex", "mixed", "saddle"};
  with_margins = with_margins && report.exact;
  Printer printer;
  for (const auto& [key, value] : head.items()) printer.member(key, value);
  printer.member("contact_radius", report.contact_radius);
  printer.member("query_radius", report.query_radius);
  printer.member("vertices", report.topology.vertex_count);
  printer.member("edges", report.topology.edges);
  printer.member("triangles", report.topology.triangles);
  printer.list("vertex_facet", report.vertex_facet.contacts.size(),
               [&](std::size_t i) { return vertex_facet(report, with_margins, i); });
  printer.list("edge_edge", report.edge_edge.contacts.size(),
               [&](std::size_t i) { return edge_edge(report, with_margins, i); });
  printer.member("sets", sets_by_primitive(report));
  printer.member("d_min_vertex", report.vertex_facet.d_min_vertex);
  printer.member("d_min_edge", report.edge_edge.d_min_edge);
  printer.member("d_min_triangle", report.vertex_facet.d_min_triangle);
  printer.member("bound", report.bound);
  printer.member("vertex_place", vertex_places(report.topology));
  printer.member("edge_place", edge_places(report.topology));
  if (report.filters.total().calls > 0) printer.member("filters", to_json(report.filters));
  if (report.exact) {
    Json names = Json::array();
    for (const reference::VertexKind kind : report.exact->vertex_kind)
      names.push_back(kinds[static_cast<std::size_t>(kind)]);
    printer.member("vertex_kind", names);
  }
  printer.finish();
}

}  // namespace ogc::experiments
