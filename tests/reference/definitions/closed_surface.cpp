// Tests two decisions of §3.9: whether a point is inside a body, and whether it is in an outward block of the body's
// surface. The two decisions share no formula, so each tests the other.
#include "reference/definitions/closed_surface.hpp"

#include <algorithm>

#include "compare/problem/error.hpp"
#include "reference/definitions/block_margins.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::ClosedSurface;
using reference::Complex;
using reference::Face;
using reference::FaceKind;

namespace {

/// Returns a cube with a dent: the corner (2, 2, 2) moves inward, so far that the vertex is reentrant and has valleys
/// and ridges.
Surface dented_cube() {
  Surface surface = cube();
  surface.positions[7] = {0.5f, 0.75f, 0.5f};
  return surface;
}

/// Returns a cube with a cavity: a smaller cube inside it whose triangles have the opposite orientation.
Surface hollow_cube() {
  Surface inner = mapped(cube(), [](Vec3f x) { return Vec3f{x.x / 2 + 0.5f, x.y / 2 + 0.5f, x.z / 2 + 0.5f}; });
  for (auto& t : inner.triangles) std::swap(t[0], t[1]);
  return together(cube(), inner);
}

/// Returns two overlapping cubes; their surface winds twice around common points.
Surface overlapping_cubes() {
  return together(cube(), mapped(cube(), [](Vec3f x) { return Vec3f{x.x + 1.25f, x.y + 0.5f, x.z + 0.25f}; }));
}

std::vector<Surface> bodies() {
  return {tetrahedron(),
          octahedron(),
          cube(),
          dented_cube(),
          hollow_cube(),
          overlapping_cubes(),
          mapped(dented_cube(), turned)};
}

struct Body {
  Surface surface;
  compare::Topology topology;
  explicit Body(Surface from) : surface(std::move(from)), topology(surface.topology()) {}
  Complex mesh() const { return {topology, surface.positions}; }
};

/// Returns points on a grid over the box, and points off the grid; many lie on vertices, edges and triangles.
std::vector<Vec3f> points_around(const Surface& surface, std::mt19937& random) {
  Vec3f low = surface.positions[0], high = low;
  for (const Vec3f& x : surface.positions) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  std::vector<Vec3f> points = surface.positions;
  std::uniform_int_distribution<int> eighth(-2, 10);
  std::uniform_real_distribution<float> anywhere(-0.25f, 1.25f);
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  for (int k = 0; k < 120; ++k) {
    const auto coordinate = [&] { return k % 2 == 0 ? static_cast<float>(eighth(random)) / 8 : anywhere(random); };
    points.push_back(
        {mix(low.x, high.x, coordinate()), mix(low.y, high.y, coordinate()), mix(low.z, high.z, coordinate())});
  }
  return points;
}

/// Returns the faces nearest to x, among those whose block of unlimited radius holds x.
std::vector<Face> nearest_faces(const Complex& mesh, const Vec3f& x) {
  constexpr float far = 1e6f;
  std::vector<Face> nearest;
  double best = far;
  const auto offer = [&](Face face) {
    if (!reference::in_block(mesh, face, x, far)) return;
    const double d = reference::distance(reference::face_gap(mesh, face, x, 0));
    if (d < best) nearest.clear();
    best = std::min(best, d);
    if (d == best) nearest.push_back(face);
  };
  for (Index v = 0; v < mesh.topology.vertex_count; ++v) offer(reference::vertex_face(v));
  for (std::size_t e = 0; e < mesh.topology.edges.size(); ++e) offer(reference::edge_face(static_cast<Index>(e)));
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t)
    offer(reference::triangle_face(static_cast<Index>(t)));
  return nearest;
}

std::string refusal(const Surface& surface) {
  const Body body(surface);
  try {
    ClosedSurface{body.mesh()};
  } catch (const compare::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE(
    "closed surface: winding numbers and points of the surface of a cube, a dent, a cavity and an overlap, by hand",
    "[unit]") {
  const Body plain(cube()), dent(dented_cube()), hollow(hollow_cube()), both(overlapping_cubes());
  const ClosedSurface a(plain.mesh()), b(dent.mesh()), c(hollow.mesh()), d(both.mesh());
  CHECK(a.locate({1, 1, 1}).winding == 1);
  CHECK(a.locate({1, 1, 2}).on_surface);  // on a diagonal between two triangles
  CHECK(a.locate({2, 2, 2}).on_surface);  // a vertex
  CHECK(a.locate({-1, 0, 0}).outside());  // the ray runs along an edge
  CHECK(a.locate({-1, 1, 1}).outside());  // the ray runs through diagonals
  CHECK(a.locate({0, 3, 0}).outside());
  CHECK(b.locate({1.75f, 1.75f, 1.75f}).outside());  // where the corner of the cube was before it moved inward
  CHECK(b.locate({0.25f, 0.25f, 0.25f}).inside());
  CHECK(c.locate({1, 1, 1}).outside());
  CHECK(c.locate({0.25f, 1, 1}).winding == 1);
  CHECK(d.locate({1.5f, 1, 1}).winding == 2);
  CHECK(d.locate({2.5f, 1, 1}).winding == 1);
}

TEST_CASE("closed surface: the block of a nearest face is outward exactly where the point is not inside",
          "[property]") {
  std::mt19937 random(9);
  std::size_t inside = 0, outside = 0, on_surface = 0;
  for (const Surface& surface : bodies()) {
    // Skips the two overlapping cubes: the face nearest to a point may lie inside the body.
    if (surface.triangles.size() == overlapping_cubes().triangles.size() && surface.positions[8].x == 1.25f) continue;
    const Body body(surface);
    const ClosedSurface closed(body.mesh());
    for (const Vec3f& x : points_around(surface, random)) {
      const reference::PointLocation place = closed.locate(x);
      inside += place.inside();
      outside += place.outside();
      on_surface += place.on_surface;
      const auto faces = nearest_faces(body.mesh(), x);
      REQUIRE_FALSE(faces.empty());
      for (const Face face : faces) CHECK(closed.outward(face, x) == !place.inside());
    }
  }
  CHECK(std::min({inside, outside, on_surface}) > 40);
}

TEST_CASE(
    "closed surface: outward blocks cover the outside up to r, hold the surface, and lie in the blocks of Eq. 8 to 10",
    "[property]") {
  std::mt19937 random(10);
  for (const Surface& surface : bodies()) {
    const Body body(surface);
    const ClosedSurface closed(body.mesh());
    const float r = 0.5f * std::abs(surface.positions[1].x - surface.positions[0].x + surface.positions[1].y -
                                    surface.positions[0].y);
    for (const Vec3f& x : points_around(surface, random)) {
      const auto faces = nearest_faces(body.mesh(), x);
      const reference::PointLocation place = closed.locate(x);
      const bool near = reference::sign(reference::face_gap(body.mesh(), faces.front(), x, r)) <= 0;
      const auto in_outward = [&](Face face) { return closed.in_outward_block(face, x, r); };
      if (!place.inside() && near) CHECK(std::any_of(faces.begin(), faces.end(), in_outward));
      for (const Face face : faces) CHECK((!in_outward(face) || reference::in_block(body.mesh(), face, x, r)));
    }
  }
}

TEST_CASE("closed surface: a ridge has its outward block, a dent only its own point", "[unit]") {
  const Body body(dented_cube());
  const ClosedSurface closed(body.mesh());
  const Index ridge = compare::find_edge(body.topology, 0, 1);
  CHECK(closed.in_outward_block(reference::edge_face(ridge), {1, -0.25f, -0.25f}, 1));
  CHECK(closed.in_outward_block(reference::edge_face(ridge), {1, 0, 0}, 1));
  const reference::Face dent = reference::vertex_face(7);
  CHECK(closed.in_outward_block(dent, body.mesh().at(7), 1));
  // The point is outside, but no normal of the dent points to it.
  CHECK_FALSE(closed.in_outward_block(dent, {1.5f, 1.5f, 1.5f}, 4));
  CHECK(reference::in_block(body.mesh(), dent, {0.25f, 0.5f, 0.25f}, 4));
  // The point is in the dent's block, but inside the cube.
  CHECK_FALSE(closed.in_outward_block(dent, {0.25f, 0.5f, 0.25f}, 4));
}

TEST_CASE("closed surface: what is not closed, not oriented, folded or inside out is refused by its element's name",
          "[unit]") {
  Surface open = cube();
  open.triangles.pop_back();
  CHECK(refusal(open).find("edge") != std::string::npos);
  CHECK(refusal(open).find("belongs to 1 triangle,") != std::string::npos);
  Surface mixed = cube();
  std::swap(mixed.triangles[4][0], mixed.triangles[4][1]);
  CHECK(refusal(mixed).find("in the same sense") != std::string::npos);
  CHECK(refusal(mixed).find("4") != std::string::npos);
  Surface inverted = cube();
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  CHECK(refusal(inverted).find("face inward") != std::string::npos);
  Surface flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {}, {}};
  CHECK(refusal(flat).find("folded onto each other") != std::string::npos);
  Surface collapsed = tetrahedron();
  collapsed.positions[3] = collapsed.positions[2];
  CHECK(refusal(collapsed).find("has no area") != std::string::npos);
  Surface yarn = cube();
  yarn.loose_edges = {{0, 7}};
  CHECK(refusal(yarn).find("belongs to 0 triangles") != std::string::npos);
  Surface pages = together(tetrahedron(), tetrahedron());
  for (auto& t : pages.triangles)
    for (Index& v : t) v = v == 4 ? 0 : v == 5 ? 1 : v;
  CHECK(refusal(pages).find("belongs to 4 triangles") != std::string::npos);
}
