// Tests statements of the paper's sections 3 and 4 that, as printed, fail on some meshes. Each case has the smallest
// such mesh (compare/deviations.md), and checks what holds there instead.
#include <algorithm>
#include <cmath>

#include "reference/definitions/contact_sets.hpp"
#include "reference/definitions/defined_blocks.hpp"
#include "reference/definitions/gauss_map.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::VertexFacetContact;
using reference::Complex;
using reference::DefinedBlocks;
using reference::edge_face;
using reference::in_block;
using reference::in_edge_only_block;
using reference::triangle_face;
using reference::vertex_face;

namespace {

std::vector<Face> faces_touched(const std::vector<VertexFacetContact>& contacts, Index vertex) {
  std::vector<Face> faces;
  for (const auto& c : contacts) {
    if (c.vertex == vertex) faces.push_back(c.face);
  }
  return faces;
}

}  // namespace

TEST_CASE("counterexample to the remark on saddles in §3.3: within r of one, and in no block of its faces or edges",
          "[unit]") {
  // The star extends 2.3 from its saddle and r = 6, so the points of the star closest to x are vertices on the rim.
  const Surface star = with_vertex(saddle(), {0, 0, 5});
  const auto topology = star.topology();
  const Complex mesh{topology, star.positions};
  const Vec3f x = star.positions[5];
  REQUIRE(reference::classify(mesh, 0) == reference::VertexKind::saddle);
  REQUIRE(reference::sign(reference::gap_points(mesh.at(0), x, 6)) < 0);
  for (const Index t : topology.vertex_triangles[0]) CHECK_FALSE(in_block(mesh, triangle_face(t), x, 6));
  for (const Index e : topology.vertex_edges[0]) CHECK_FALSE(in_block(mesh, edge_face(e), x, 6));
  // The blocks of two vertices on the rim still contain the point.
  const auto contacts = reference::vertex_facet_over_all_pairs(question(star, topology, 6, 6));
  CHECK(faces_touched(contacts, 5) == std::vector<Face>{vertex_face(1), vertex_face(3)});
}

TEST_CASE(
    "counterexample to covering by Eq. 7: the position of a saddle vertex, and the interior of an edge with triangles "
    "all around",
    "[unit]") {
  const Surface star = saddle();
  const auto topology = star.topology();
  const Complex mesh{topology, star.positions};
  const DefinedBlocks blocks(mesh);
  const Vec3f x{0, 0, 0};
  CHECK_FALSE(blocks.has_normals(vertex_face(0)));
  CHECK(in_block(mesh, vertex_face(0), x, 1));  // Eq. 8 covers the point
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    CHECK_FALSE(blocks.contains(edge_face(static_cast<Index>(e)), x, 1));
  for (std::size_t t = 0; t < topology.triangles.size(); ++t)
    CHECK_FALSE(blocks.contains(triangle_face(static_cast<Index>(t)), x, 1));
  const Surface pages = book(5, 1);
  const auto spine = pages.topology();
  const Complex around{spine, pages.positions};
  const DefinedBlocks of_pages(around);
  const Index e = compare::find_edge(spine, 0, 1);
  CHECK_FALSE(of_pages.has_normals(edge_face(e)));
  CHECK(in_block(around, edge_face(e), {1, 0, 0}, 1));
  for (const float y : {-0x1p-20f, 0x1p-20f}) CHECK_FALSE(in_block(around, edge_face(e), {1, y, 0.5f * y}, 1));
}

TEST_CASE(
    "counterexample to the remark on Eq. 8: a flat edge's plane meets the block of its vertex in more than the vertex",
    "[unit]") {
  const Surface sheet = grid(3);
  const auto topology = sheet.topology();
  const Complex mesh{topology, sheet.positions};
  const Index e = compare::find_edge(topology, 3, 4);
  CHECK_FALSE(reference::is_hull_edge(mesh, 4, e));
  const Vec3f above{1, 1, 0.5f};
  CHECK(in_block(mesh, vertex_face(4), above, 1));
  // The point lies on the plane through vertex 4 perpendicular to edge e, half a radius from the vertex.
  CHECK(reference::sign(reference::along(mesh.at(4), mesh.at(3), above)) == 0);
}

TEST_CASE("counterexample to strict closest-ness: a ⊂ b has equal distances; the paper's other half, b ⊂ a, is strict",
          "[unit]") {
  const Surface sheet = grid(3);
  const auto topology = sheet.topology();
  const Complex mesh{topology, sheet.positions};
  const Vec3f above{1, 1, 0.5f};
  REQUIRE(in_block(mesh, vertex_face(4), above, 1));
  for (const Index t : topology.vertex_triangles[4]) {
    const auto [a, b, c] = mesh.triangle(t);
    const reference::Corners corners{mesh.at(a), mesh.at(b), mesh.at(c)};
    CHECK(reference::distance(reference::feature_gap(corners, reference::closest_feature(corners, above), above)) ==
          0.5);
  }
}

TEST_CASE("counterexample to equality with the open offset: at d = r a block holds a point that M^{+r} does not",
          "[unit]") {
  const Surface sheet = grid(2);
  const auto topology = sheet.topology();
  const Complex mesh{topology, sheet.positions};
  CHECK(in_block(mesh, triangle_face(0), {0.25f, 0.25f, 1}, 1));
  const Surface with = with_vertex(sheet, {0.25f, 0.25f, 1});
  const auto names = with.topology();
  CHECK(reference::vertex_facet_by_definition(question(with, names, 1, 1)).empty());
}

TEST_CASE(
    "counterexample to \"at most one face of t\" (§4.1): of a collapsed triangle Eq. 12 gives several, Algorithm 1 one",
    "[unit]") {
  const Surface line = with_vertex({{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}, {}}, {1, 0, 0.5f});
  const auto topology = line.topology();
  const auto in = question(line, topology, 1, 1);
  // The vertex lies above the interiors of the edges 0–1 and 0–2 at once.
  const std::vector<Face> both{edge_face(compare::find_edge(topology, 0, 1)),
                               edge_face(compare::find_edge(topology, 0, 2))};
  CHECK(faces_touched(reference::vertex_facet_by_definition(in), 3) == both);
  CHECK(faces_touched(reference::vertex_facet_over_all_pairs(in), 3).size() == 1);
}

TEST_CASE(
    "counterexample to \"no miss\" (§4.1): on a collapsed triangle a vertex lies in the block of its own opposite edge",
    "[unit]") {
  const Surface line{{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}, {}};
  const auto topology = line.topology();
  const auto in = question(line, topology, 1, 1);
  CHECK(faces_touched(reference::vertex_facet_by_definition(in), 2) ==
        std::vector<Face>{edge_face(compare::find_edge(topology, 0, 1))});
  CHECK(reference::vertex_facet_over_all_pairs(in).empty());  // line 3: the only triangle contains the vertex
  Surface raised = line;
  raised.positions[2].y = 0x1p-20f;
  CHECK(reference::vertex_facet_by_definition(question(raised, topology, 1, 1)).empty());
}

TEST_CASE(
    "counterexample to \"detected exactly twice\" (§4.2): Algorithm 2 as printed enters a pair from one side only",
    "[unit]") {
  // Edge 1 continues edge 0 at vertex 1. Edge 2 (vertices 3, 4) passes above edge 1, so it is nearer to edge 1 than to
  // edge 0.
  const Surface bend{{{-2, 0, 0}, {0, 0, 0}, {2, 0, 0.5f}, {1, -2, 1}, {1, 2, 1}}, {}, {{0, 1}, {1, 2}, {3, 4}}, {}};
  const auto topology = bend.topology();
  const Complex mesh{topology, bend.positions};
  const float r = 2;
  const Vec3f on_edge_0{0, 0, 0}, on_edge_2{1, 0, 1};  // closest points of both edges, √2 apart
  const auto closest = reference::closest_features({{mesh.at(0), mesh.at(1)}, {mesh.at(3), mesh.at(4)}});
  REQUIRE(closest == reference::EdgeFeatures{compare::EdgeFeature::end_1, compare::EdgeFeature::interior});
  // Algorithm 2 as printed, run for edge 0, enters the pair with a = the interior of edge 2.
  CHECK(in_edge_only_block(mesh, edge_face(2), on_edge_0, r));
  CHECK_FALSE(in_edge_only_block(mesh, vertex_face(1), on_edge_2, r));  // run for edge 2, it refuses a = vertex 1
  const auto contacts = reference::detect_edge_edge(question(bend, topology, r, r)).exact.contacts;
  // Only the pair that both edges accept is a contact.
  CHECK(contacts == std::vector<compare::EdgeEdgeContact>{{edge_face(1), edge_face(2), 1, 2}});
}

TEST_CASE(
    "counterexample to \"orthogonal to the face it applies on\" (§1, §3): opposite edges of one strip are a contact by "
    "Eq. 17, whose force lies in the strip",
    "[unit]") {
  // Edges 0–1 and 2–3 are 1 apart, and lean by ±s, so that their closest points are their middles.
  const float s = 0.0625f, r = 1.5f;
  const Surface strip{{{-1, 0, -s}, {1, 0, s}, {-1, 1, s}, {1, 1, -s}}, {{0, 1, 2}, {1, 3, 2}}, {}, {}};
  const auto topology = strip.topology();
  const Complex mesh{topology, strip.positions};
  const Index near = compare::find_edge(topology, 0, 1), far = compare::find_edge(topology, 2, 3);
  const auto contacts = reference::detect_edge_edge(question(strip, topology, r, r)).exact.contacts;
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].first == edge_face(std::min(near, far)));
  CHECK(contacts[0].second == edge_face(std::max(near, far)));
  // The force pushes along y. The normal of triangle 0 is (−2s, −4s, 2), so that a share above 0.99 of the force is in
  // the plane of the triangle.
  const double along_normal = 4 * s / std::sqrt(4 * s * s + 16 * s * s + 4);
  CHECK(1 - along_normal * along_normal > 0.98);
  // The blocks of the surface (Eq. 9) do not hold these points.
  CHECK_FALSE(in_block(mesh, edge_face(near), {0, 1, 0}, r));
  CHECK_FALSE(in_block(mesh, edge_face(far), {0, 0, 0}, r));
}

TEST_CASE(
    "non-manifold edges: blocks of all pages' edges stay exclusive and cover, though V_e has more than two vertices "
    "(§3.2)",
    "[property]") {
  for (const int pages : {3, 4, 6}) {
    const Surface surface = book(pages, 0.5);
    const auto topology = surface.topology();
    const Complex mesh{topology, surface.positions};
    const Index e = compare::find_edge(topology, 0, 1);
    REQUIRE(topology.edge_opposite[static_cast<std::size_t>(e)].size() == static_cast<std::size_t>(pages));
    const reference::GaussMap map = reference::gauss_map(mesh, edge_face(e));
    CHECK(map.dimension == 1);
    CHECK(map.corners.size() == 2);  // between the normals of the two outer pages
    CHECK(in_block(mesh, edge_face(e), {1, -0.25f, -0.5f}, 1));
    CHECK_FALSE(in_block(mesh, edge_face(e), {1, 0.5f, 0.25f}, 1));
  }
}

TEST_CASE("two vertices in each other's blocks are two contacts, (v, a) and (a, v)", "[unit]") {
  const Surface tips{
      {{0, 0, 0.25f}, {1, 0, 2}, {0, 1, 2}, {0, 0, -0.25f}, {-1, 0, -2}, {0, -1, -2}}, {{0, 1, 2}, {3, 4, 5}}, {}, {}};
  const auto topology = tips.topology();
  const auto contacts = reference::vertex_facet_by_definition(question(tips, topology, 1, 1));
  CHECK(contacts == std::vector<VertexFacetContact>{{0, vertex_face(3), 1}, {3, vertex_face(0), 0}});
}
