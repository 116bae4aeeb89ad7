// Compares two definitions of blocks on all meshes of the zoo: half-spaces (Eq. 8–10, 14, 15) and cones of normals (Eq.
// 7).
#include "reference/definitions/defined_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/definitions/block_margins.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::FaceKind;
using reference::BlockMargin;
using reference::Complex;
using reference::DefinedBlocks;

namespace {

std::vector<Face> all_faces(const compare::Topology& topology) {
  std::vector<Face> faces;
  for (Index v = 0; v < topology.vertex_count; ++v) faces.push_back(reference::vertex_face(v));
  for (std::size_t e = 0; e < topology.edges.size(); ++e) faces.push_back(reference::edge_face(static_cast<Index>(e)));
  for (std::size_t t = 0; t < topology.triangles.size(); ++t)
    faces.push_back(reference::triangle_face(static_cast<Index>(t)));
  return faces;
}

bool holds(const BlockMargin& margin) { return margin.holds(); }

}  // namespace

TEST_CASE("mesh zoo: at least 200 meshes, each with points to ask about", "[unit]") {
  CHECK(mesh_zoo().size() >= 200);
  CHECK(std::all_of(mesh_zoo().begin(), mesh_zoo().end(),
                    [](const Specimen& s) { return s.points.size() >= 20 && s.radius > 0; }));
}

TEST_CASE(
    "defined_blocks: Eq. 7 through the Gauss map gives the blocks of Eq. 8 to 10, 14 and 15 on every mesh of the zoo",
    "[property]") {
  std::size_t inside = 0, on_boundary = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    const DefinedBlocks blocks(mesh);
    std::size_t different = 0;
    for (const Face face : all_faces(topology)) {
      for (const Vec3f& x : specimen.points) {
        const bool in = reference::in_block(mesh, face, x, specimen.radius);
        different += in != blocks.contains(face, x, specimen.radius);
        const bool in_edges = face.kind != FaceKind::triangle &&
                              reference::in_edge_only_block(mesh, face, x, specimen.radius);
        if (face.kind != FaceKind::triangle)
          different += in_edges != blocks.contains_edge_only(face, x, specimen.radius);
        inside += in + in_edges;
        if (!in) continue;
        const auto margins = reference::block_margins(mesh, face, x, specimen.radius);
        on_boundary += std::any_of(margins.begin(), margins.end(), [](const BlockMargin& m) { return m.sign == 0; });
      }
    }
    CHECK(different == 0);
  }
  CHECK(inside > 10000);
  CHECK(on_boundary > 1000);
}

TEST_CASE("block_margins: a point is in a block where all margins hold; lengths carry their exact signs",
          "[property]") {
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    std::size_t different = 0, wrong_sign = 0;
    for (const Face face : all_faces(topology)) {
      for (std::size_t k = 0; k < specimen.points.size(); k += 3) {
        const Vec3f& x = specimen.points[k];
        const auto margins = reference::block_margins(mesh, face, x, specimen.radius);
        different += std::all_of(margins.begin(), margins.end(), holds) !=
                     reference::in_block(mesh, face, x, specimen.radius);
        if (face.kind != FaceKind::triangle) {
          const auto edges = reference::block_margins(mesh, face, x, specimen.radius, true);
          different += std::all_of(edges.begin(), edges.end(), holds) !=
                       reference::in_edge_only_block(mesh, face, x, specimen.radius);
        }
        for (const BlockMargin& m : margins)
          wrong_sign += !std::isfinite(m.length) || (m.length > 0) - (m.length < 0) != m.sign;
      }
    }
    CHECK(different == 0);
    CHECK(wrong_sign == 0);
  }
}

TEST_CASE("block_margins: distances to each boundary of an edge's, a triangle's and a vertex's block by hand",
          "[unit]") {
  // Edge 0 goes from (0,0,0) to (4,0,0), and the third corner of its triangle is (0,3,0); x = (1,-2,0), r = 5.
  const Surface surface{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}, {}, {}};
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const auto edge = reference::block_margins(mesh, reference::edge_face(0), {1, -2, 0}, 5);
  REQUIRE(edge.size() == 4);
  CHECK(edge[0].kind == BlockMargin::Kind::sphere);
  CHECK(edge[0].length == 3);  // Eq. 13: 5 − 2
  CHECK(edge[0].closed);
  CHECK(edge[1].length == 1);
  CHECK_FALSE(edge[1].closed);
  CHECK(edge[2].length == 3);
  CHECK(edge[3].kind == BlockMargin::Kind::wall);
  CHECK(edge[3].length == 2);
  CHECK(edge[3].closed);
  const auto triangle = reference::block_margins(mesh, reference::triangle_face(0), {1, 1, 3}, 3);
  REQUIRE(triangle.size() == 4);
  CHECK(triangle[0].sign == 0);
  CHECK(triangle[1].length == 1);            // to the edge on the x axis
  CHECK(triangle[2].length == Approx(1.0));  // |3·1 + 4·1 − 12| / 5
  CHECK(triangle[3].length == 1);            // to the edge on the y axis
  const auto vertex = reference::block_margins(mesh, reference::vertex_face(0), {-1, 2, 0}, 3);
  REQUIRE(vertex.size() == 3);
  CHECK(vertex[1].length == 1);
  CHECK(vertex[2].length == -2);
  CHECK(reference::block_margins(mesh, reference::edge_face(0), {1, -2, 0}, 5, true).size() == 3);
}

TEST_CASE("block_margins: next to the sphere the length is r − d without cancellation", "[unit]") {
  const Surface surface = grid(2);
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const float z = std::nextafter(1.0f, 0.0f);
  CHECK(reference::block_margins(mesh, reference::vertex_face(0), {0, 0, z}, 1)[0].length == 0x1p-24);
  CHECK(reference::block_margins(mesh, reference::vertex_face(0), {0, 0, std::nextafter(1.0f, 2.0f)}, 1)[0].length ==
        -0x1p-23);
}
