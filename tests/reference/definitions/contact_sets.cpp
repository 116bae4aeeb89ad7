// Tests that three ways to find the contact sets agree: by definition over all faces, by the algorithms over all pairs,
// and by the detections, which have a tree and a grey zone.
#include "reference/definitions/contact_sets.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::VertexFacetContact;
using reference::Complex;

namespace {

/// Returns a valley over the x axis, or a ridge if `height` < 0: two triangles on the edge from vertex 0 to vertex 1.
Surface valley(float height) {
  return {{{-2, 0, 0}, {2, 0, 0}, {0, 2, height}, {0, -2, height}}, {{0, 1, 2}, {1, 0, 3}}, {}, {}};
}

}  // namespace

TEST_CASE(
    "contact_sets: definition, Algorithm 1 over all pairs, and the detection give one F_OGC on every mesh of the zoo",
    "[property]") {
  std::size_t contacts = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    for (const float r : {specimen.radius, 2 * specimen.radius}) {
      const compare::DetectIn in = question(specimen.surface, topology, r, 1.25f * r);
      const auto over_pairs = reference::vertex_facet_over_all_pairs(in);
      const bool detection_agrees = reference::detect_vertex_facet(in).exact.contacts == over_pairs;
      if (!specimen.collapsed) CHECK(detection_agrees);
      const bool definition_agrees = reference::vertex_facet_by_definition(in) == over_pairs;
      if (!specimen.collapsed) CHECK(definition_agrees);
      contacts += over_pairs.size();
    }
  }
  CHECK(contacts > 3000);
}

TEST_CASE(
    "contact_sets: definition, Algorithm 2 over all pairs, and the detection give one E_OGC on every mesh of the zoo",
    "[property]") {
  std::size_t contacts = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const compare::DetectIn in = question(specimen.surface, topology, specimen.radius, 1.25f * specimen.radius);
    const auto over_pairs = reference::edge_edge_over_all_pairs(in);
    const bool detection_agrees = reference::detect_edge_edge(in).exact.contacts == over_pairs;
    const bool definition_agrees = reference::edge_edge_by_definition(in) == over_pairs;
    CHECK(detection_agrees);
    CHECK(definition_agrees);
    contacts += over_pairs.size();
  }
  CHECK(contacts > 3000);
}

TEST_CASE("contact_sets: rigid groups leave out the same pairs in all ways", "[property]") {
  std::mt19937 random(21);
  for (int k = 0; k < 8; ++k) {
    Surface surface = folded(6, 0.4f, random, 0.3f);
    std::uniform_int_distribution<Index> group(-1, 1);
    for (std::size_t v = 0; v < surface.positions.size(); ++v) surface.groups.push_back(group(random));
    const auto topology = surface.topology();
    const compare::DetectIn in = question(surface, topology, 0.7f, 1);
    CHECK(reference::vertex_facet_by_definition(in) == reference::detect_vertex_facet(in).exact.contacts);
    CHECK(reference::vertex_facet_over_all_pairs(in) == reference::detect_vertex_facet(in).exact.contacts);
    CHECK(reference::edge_edge_by_definition(in) == reference::detect_edge_edge(in).exact.contacts);
    CHECK(reference::edge_edge_over_all_pairs(in) == reference::detect_edge_edge(in).exact.contacts);
  }
}

TEST_CASE(
    "contact_sets: V_OGC holds each contact under its owner, E_OGC(e) each pair under both of its edges, layers count "
    "F_OGC",
    "[property]") {
  std::mt19937 random(22);
  const Surface surface = folded(8, 0.4f, random, 0.3f);
  const auto topology = surface.topology();
  const compare::DetectIn in = question(surface, topology, 0.7f, 1);
  const auto facets = reference::detect_vertex_facet(in).exact.contacts;
  const auto by_triangle = reference::vertices_near_facets(topology, facets);
  const auto layers = reference::layers(topology, facets);
  std::size_t listed = 0, counted = 0;
  for (const auto& row : by_triangle) listed += row.size();
  for (const Index n : layers) counted += static_cast<std::size_t>(n);
  CHECK(listed == facets.size());
  CHECK(counted == facets.size());
  CHECK(*std::max_element(layers.begin(), layers.end()) > 1);
  for (const auto& c : facets) {
    const auto& row = by_triangle[static_cast<std::size_t>(c.owner)];
    CHECK(std::find(row.begin(), row.end(), c.vertex) != row.end());
  }
  const auto pairs = reference::detect_edge_edge(in).exact.contacts;
  const auto by_edge = reference::contacts_of_edges(topology, pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const Index e : {pairs[i].first_edge, pairs[i].second_edge}) {
      const auto& row = by_edge[static_cast<std::size_t>(e)];
      CHECK(std::count(row.begin(), row.end(), i) == 1);
    }
  }
}

TEST_CASE(
    "contact_sets: Fig. 3, over a ridge IPC pushes both facets, SDF one or both, OGC the ridge alone; over a valley "
    "OGC both",
    "[unit]") {
  for (const float height : {-1.0f, 1.0f}) {
    const Surface surface = with_vertex(valley(height), {0, 0, 0.5f});
    const auto topology = surface.topology();
    const Complex mesh{topology, surface.positions};
    const auto contacts = reference::vertex_facet_over_all_pairs(question(surface, topology, 1, 1));
    CHECK(reference::ipc_face_set(mesh, 4, 1) == std::vector<Index>{0, 1});
    // Both slopes are equally near, so the argmin that defines the paper's SDF set is not unique.
    CHECK(reference::sdf_face_set(mesh, mesh.at(4), 1) == std::vector<Index>{0, 1});
    const Vec3f beside{0, 0x1p-20f, 0.5f};
    // Over the valley, one slope is nearer than the other. Over the ridge, the nearest point is still on the crest,
    // which belongs to both slopes.
    CHECK(reference::sdf_face_set(mesh, beside, 1) == (height < 0 ? std::vector<Index>{0, 1} : std::vector<Index>{0}));
    if (height < 0) {
      REQUIRE(contacts.size() == 1);
      CHECK(contacts[0].face == reference::edge_face(compare::find_edge(topology, 0, 1)));
    } else {
      REQUIRE(contacts.size() == 2);
      CHECK(contacts[0].face == reference::triangle_face(0));
      CHECK(contacts[1].face == reference::triangle_face(1));
    }
  }
}

TEST_CASE(
    "contact_sets: F_SDF of a vertex of the mesh is its own triangles (§2.2), F_IPC leaves them out and is open at r",
    "[unit]") {
  const Surface sheet = grid(3);
  const auto topology = sheet.topology();
  const Complex mesh{topology, sheet.positions};
  const auto own = topology.vertex_triangles[4];
  CHECK(reference::sdf_face_set(mesh, mesh.at(4), 1) == std::vector<Index>(own.begin(), own.end()));
  for (const Index t : reference::ipc_face_set(mesh, 4, 1.5f)) CHECK(std::find(own.begin(), own.end(), t) == own.end());
  const Surface above = with_vertex(grid(2), {0.25f, 0.25f, 1});
  const auto names = above.topology();
  const Complex lifted{names, above.positions};
  CHECK(reference::ipc_face_set(lifted, 4, 1).empty());
  CHECK(reference::ipc_face_set(lifted, 4, std::nextafter(1.0f, 2.0f)) == std::vector<Index>{0});
  CHECK(reference::sdf_face_set(lifted, lifted.at(4), 1).empty());
  CHECK(reference::sdf_face_set(lifted, lifted.at(4), std::nextafter(1.0f, 2.0f)) == std::vector<Index>{0});
}

TEST_CASE("contact_sets: every triangle of F_SDF is in F_IPC, and what OGC touches is a face of a triangle of F_IPC",
          "[property]") {
  std::mt19937 random(23);
  const Surface surface = together(folded(6, 0.4f, random, 0.3f), soup(8, 0, random));
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const auto contacts = reference::vertex_facet_over_all_pairs(question(surface, topology, 0.7f, 0.7f));
  for (Index v = 36; v < topology.vertex_count; ++v) {
    const auto ipc = reference::ipc_face_set(mesh, v, 0.7f);
    for (const Index t : reference::sdf_face_set(mesh, mesh.at(v), 0.7f))
      CHECK(std::find(ipc.begin(), ipc.end(), t) != ipc.end());
  }
  for (const VertexFacetContact& c : contacts) {
    const auto ipc = reference::ipc_face_set(mesh, c.vertex, 0.7f);
    CHECK(std::find(ipc.begin(), ipc.end(), c.owner) != ipc.end());
  }
}

TEST_CASE("contact_sets: Eq. 13, the penetration depth is r minus the distance, by hand", "[unit]") {
  const Surface surface = with_vertex(grid(3, 0, 4), {1, 1, 0.75f});
  const auto topology = surface.topology();
  const compare::DetectIn in = question(surface, topology, 2, 2);
  const auto contacts = reference::vertex_facet_over_all_pairs(in);
  CHECK(reference::penetration_depths({topology, surface.positions}, contacts, 2) == std::vector<double>{1.25});
}
