// Tests the polyhedral Gauss map: kinds of vertices on handmade meshes, corners (which are normals of triangles), and
// areas (which are angle deficits).
#include "reference/definitions/gauss_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/definitions/defined_blocks.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::Complex;
using reference::GaussMap;
using reference::Unit;
using reference::VertexKind;

namespace {

constexpr double pi = std::numbers::pi;

/// Returns 2π minus the angles of the triangles at v [rad].
double angle_deficit(const Complex& mesh, Index v) {
  double sum = 0;
  for (const Index t : mesh.topology.vertex_triangles[static_cast<std::size_t>(v)]) {
    std::array<std::array<double, 3>, 2> d{};
    int k = 0;
    for (const Index u : mesh.triangle(t)) {
      if (u == v) continue;
      const Vec3f &a = mesh.at(v), &b = mesh.at(u);
      d[static_cast<std::size_t>(k++)] = {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y,
                                          static_cast<double>(b.z) - a.z};
    }
    const double dot = d[0][0] * d[1][0] + d[0][1] * d[1][1] + d[0][2] * d[1][2];
    sum += std::acos(
        std::clamp(dot / std::hypot(d[0][0], d[0][1], d[0][2]) / std::hypot(d[1][0], d[1][1], d[1][2]), -1.0, 1.0));
  }
  return 2 * pi - sum;
}

bool near_unit(const Unit& a, const Unit& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-12; }

/// Returns five triangles around vertex 0. Its neighbours are the corners of a square at height −1, and the middle of
/// one of the square's sides at `height` (vertex 2).
Surface five_spokes(float height) {
  return {{{0, 0, 0}, {2, 2, -1}, {0, 2, height}, {-2, 2, -1}, {-2, -2, -1}, {2, -2, -1}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}},
          {},
          {}};
}

bool is_inner(const compare::Topology& topology, Index v) {
  const auto edges = topology.vertex_edges[static_cast<std::size_t>(v)];
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](Index e) {
    return topology.edge_triangles[static_cast<std::size_t>(e)].size() == 2;
  });
}

bool has(const std::vector<Unit>& units, const Unit& u) {
  return std::any_of(units.begin(), units.end(), [&](const Unit& other) { return near_unit(other, u); });
}

}  // namespace

TEST_CASE("gauss_map: convex, mixed and saddle vertices by hand", "[unit]") {
  const auto kind_of = [](const Surface& surface, Index v) {
    const auto topology = surface.topology();
    return reference::classify({topology, surface.positions}, v);
  };
  CHECK(kind_of(tetrahedron(), 0) == VertexKind::convex);
  CHECK(kind_of(cube(), 3) == VertexKind::convex);
  CHECK(kind_of(saddle(), 0) == VertexKind::saddle);
  CHECK(kind_of(saddle(), 1) == VertexKind::convex);  // at the rim two triangles meet in a ridge
  CHECK(kind_of(grid(3), 4) == VertexKind::convex);   // flat
  // Vertex 2 at (0, 2, −1/4) lies above the line between its neighbours, so the edge to it is a ridge; at (0, 2, −3/2)
  // the edge is a valley.
  CHECK(kind_of(five_spokes(-0.25f), 0) == VertexKind::convex);
  CHECK(kind_of(five_spokes(-1.5f), 0) == VertexKind::mixed);
  CHECK(kind_of({{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}, {}}, 0) == VertexKind::convex);
}

TEST_CASE("gauss_map: Eq. 6, a triangle has two opposite normals, an edge an arc between its triangles' normals",
          "[unit]") {
  const Surface surface = cube();
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const GaussMap triangle = reference::gauss_map(mesh, reference::triangle_face(0));
  CHECK(triangle.dimension == 0);
  REQUIRE(triangle.corners.size() == 2);
  CHECK(has(triangle.corners, {0, 0, 1}));
  CHECK(has(triangle.corners, {0, 0, -1}));
  const GaussMap crease = reference::gauss_map(mesh, reference::edge_face(compare::find_edge(topology, 0, 1)));
  CHECK(crease.dimension == 1);
  CHECK(crease.corners.size() == 2);
  CHECK(has(crease.corners, {0, 0, -1}));
  CHECK(has(crease.corners, {0, -1, 0}));
  const GaussMap diagonal = reference::gauss_map(mesh, reference::edge_face(compare::find_edge(topology, 1, 2)));
  CHECK(diagonal.dimension == 0);  // flat: the two normals of the plane
  CHECK(diagonal.corners.size() == 2);
  const GaussMap corner = reference::gauss_map(mesh, reference::vertex_face(0));
  CHECK(corner.dimension == 2);
  CHECK(corner.corners.size() == 3);
  for (const Unit& n : {Unit{-1, 0, 0}, Unit{0, -1, 0}, Unit{0, 0, -1}}) CHECK(has(corner.corners, n));
  CHECK(reference::solid_angle(corner) == Approx(pi / 2));
}

TEST_CASE(
    "gauss_map: boundary edges have half a circle, edges of M^e a whole one, the end of a yarn half the sphere, a lone "
    "vertex all of it",
    "[unit]") {
  Surface surface{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 5}, {1, 1, 1}}, {{0, 1, 2}}, {{2, 3}}, {}};
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const Index rim = compare::find_edge(topology, 0, 1), yarn = compare::find_edge(topology, 2, 3);
  const GaussMap half = reference::gauss_map(mesh, reference::edge_face(rim));
  CHECK(half.dimension == 1);
  REQUIRE(half.corners.size() == 3);
  CHECK(near_unit(half.corners[1], {0, -1, 0}));
  CHECK(std::abs(half.corners[0][2]) == 1);
  CHECK_FALSE(half.closed);
  for (const auto& whole : {reference::gauss_map(mesh, reference::edge_face(rim), true),
                            reference::gauss_map(mesh, reference::edge_face(yarn))}) {
    CHECK(whole.dimension == 1);
    CHECK(whole.corners.size() == 4);
    CHECK(whole.closed);
  }
  CHECK(reference::solid_angle(reference::gauss_map(mesh, reference::vertex_face(3))) == Approx(2 * pi));
  CHECK(reference::solid_angle(reference::gauss_map(mesh, reference::vertex_face(4))) == Approx(4 * pi));
  // A right angle of a sheet maps to a quarter of a sphere.
  CHECK(reference::solid_angle(reference::gauss_map(mesh, reference::vertex_face(0))) == Approx(pi));
}

TEST_CASE(
    "gauss_map: the area of a convex inner vertex is its angle deficit, of a mixed one at least that, of a saddle zero",
    "[property]") {
  std::array<int, 3> seen{};
  for (const Specimen& specimen : mesh_zoo()) {
    if (specimen.collapsed) continue;
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    for (Index v = 0; v < topology.vertex_count; ++v) {
      if (!is_inner(topology, v) || !reference::indicatrix(mesh, v)) continue;
      const VertexKind kind = reference::classify(mesh, v);
      const double area = reference::solid_angle(reference::gauss_map(mesh, reference::vertex_face(v))),
                   deficit = angle_deficit(mesh, v);
      ++seen[static_cast<std::size_t>(kind)];
      if (kind == VertexKind::convex) CHECK(std::abs(area - deficit) < 1e-6);
      if (kind == VertexKind::mixed) CHECK(area > deficit - 1e-6);
      if (kind == VertexKind::saddle) CHECK(area == 0);
    }
  }
  CHECK(seen[0] > 100);
  CHECK(seen[1] > 50);
  CHECK(seen[2] > 50);
}

TEST_CASE("gauss_map: every direction is a normal of some vertex of a closed mesh; of a convex one just once",
          "[property]") {
  const auto total = [](const Surface& surface) {
    const auto topology = surface.topology();
    const Complex mesh{topology, surface.positions};
    double area = 0;
    for (Index v = 0; v < topology.vertex_count; ++v)
      area += reference::solid_angle(reference::gauss_map(mesh, reference::vertex_face(v)));
    return area;
  };
  for (const Surface& surface : {tetrahedron(), octahedron(), cube(), mapped(cube(), turned)})
    CHECK(total(surface) == Approx(4 * pi));
  Surface dented = octahedron();
  dented.positions[4].z = -1;
  CHECK(total(dented) > 4 * pi);
}

TEST_CASE(
    "gauss_map: Echeverria's indicatrix of a closed fan encloses the angle deficit, with inverted parts counted "
    "against it",
    "[property]") {
  int closed = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    for (Index v = 0; v < topology.vertex_count; ++v) {
      const auto polygon = reference::indicatrix(mesh, v);
      if (!polygon || !polygon->closed) continue;
      ++closed;
      CHECK(polygon->normals.size() == topology.vertex_triangles[static_cast<std::size_t>(v)].size());
      // The area of a spherical polygon is defined up to whole spheres (4π). If the star passes through itself, the
      // area is defined only up to half spheres: when neighbouring normals become opposite, the arc between them
      // changes to the other side of the sphere.
      const bool crosses_itself = specimen.name.starts_with("folded sheet") || specimen.name.starts_with("jittered") ||
                                  specimen.name.starts_with("soup");
      const double turns = (polygon->area - angle_deficit(mesh, v)) / (crosses_itself ? 2 * pi : 4 * pi);
      CHECK(std::abs(turns - std::round(turns)) < 1e-6);
    }
  }
  CHECK(closed > 200);
}

TEST_CASE(
    "gauss_map: the indicatrix of a convex corner is its Gauss map; boundary vertices give an open polygon, books none",
    "[unit]") {
  const Surface box = cube();
  const auto topology = box.topology();
  const Complex mesh{topology, box.positions};
  const auto polygon = reference::indicatrix(mesh, 7);
  REQUIRE(polygon);
  CHECK(polygon->closed);
  for (const Unit& n : polygon->normals) CHECK(has(reference::gauss_map(mesh, reference::vertex_face(7)).corners, n));
  const Surface sheet = grid(3);
  const auto flat = sheet.topology();
  const auto corner = reference::indicatrix({flat, sheet.positions}, 1);
  REQUIRE(corner);
  CHECK_FALSE(corner->closed);
  const Surface pages = book(3, 1);
  const auto spine = pages.topology();
  CHECK_FALSE(reference::indicatrix({spine, pages.positions}, 0));
}

TEST_CASE("gauss_map: edges of the hull are those of ridges, and planes of other edges change no vertex block",
          "[property]") {
  const Surface dented = five_spokes(-1.5f);
  const auto topology = dented.topology();
  const Complex mesh{topology, dented.positions};
  for (const Index v : {1, 3, 4, 5}) CHECK(reference::is_hull_edge(mesh, 0, compare::find_edge(topology, 0, v)));
  CHECK_FALSE(reference::is_hull_edge(mesh, 0, compare::find_edge(topology, 0, 2)));
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto all = specimen.surface.topology();
    const Complex whole{all, specimen.surface.positions};
    for (Index v = 0; v < std::min<Index>(all.vertex_count, 6); ++v) {
      if (reference::gauss_map(whole, reference::vertex_face(v)).dimension < 2) continue;
      Surface ridges{{whole.at(v)}, {}, {}, {}};
      for (const Index e : all.vertex_edges[static_cast<std::size_t>(v)]) {
        if (!reference::is_hull_edge(whole, v, e)) continue;
        ridges.loose_edges.push_back({0, static_cast<Index>(ridges.positions.size())});
        ridges.positions.push_back(whole.at(whole.across(e, v)));
      }
      const auto spokes = ridges.topology();
      const Complex star{spokes, ridges.positions};
      std::size_t different = 0;
      for (const Vec3f& x : specimen.points) {
        different += reference::in_block(star, reference::vertex_face(0), x, specimen.radius) !=
                     reference::in_block(whole, reference::vertex_face(v), x, specimen.radius);
      }
      CHECK(different == 0);
    }
  }
}
