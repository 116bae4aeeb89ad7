// Compares pictures of blocks with the exact decision: points inside the patches are in the block, points beyond the
// patches are not.
#include "reference/illustrations/block_picture.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::FaceKind;
using reference::BlockMargin;
using reference::BlockPicture;
using reference::Complex;

namespace {

using Point3 = std::array<double, 3>;

Point3 mean_of(const BlockPicture& picture) {
  Point3 sum{};
  for (const Point3& x : picture.points) sum = {sum[0] + x[0], sum[1] + x[1], sum[2] + x[2]};
  const double n = static_cast<double>(picture.points.size());
  return {sum[0] / n, sum[1] / n, sum[2] / n};
}

/// Returns the point at the share `part` of the way from `centre`, the middle of the convex block, to the middle of
/// triangle t of its boundary.
Vec3f on_ray(const BlockPicture& picture, const std::array<int, 3>& t, const Point3& centre, double part) {
  Point3 x{};
  for (const int k : t) {
    for (std::size_t c = 0; c < 3; ++c) x[c] += picture.points[static_cast<std::size_t>(k)][c] / 3;
  }
  const auto along = [&](std::size_t c) { return static_cast<float>(centre[c] + part * (x[c] - centre[c])); };
  return {along(0), along(1), along(2)};
}

}  // namespace

TEST_CASE("block_picture: just inside each patch is in the block, just outside is not", "[property]") {
  std::size_t patches = 0;
  const Surface bent = mapped(grid(3), [](Vec3f x) { return Vec3f{x.x, x.y, 0.3f * x.x * x.y}; });
  for (const Surface& surface : {tetrahedron(), octahedron(), saddle(), book(3, 0.75), bent}) {
    const auto topology = surface.topology();
    const Complex mesh{topology, surface.positions};
    const float r = 0.8f;
    const auto check = [&](Face face, bool edge_only) {
      const BlockPicture picture = reference::block_picture(mesh, face, r, edge_only, 0.02);
      const int dimension = reference::gauss_map(mesh, face, edge_only).dimension + static_cast<int>(face.kind);
      if (dimension < 2) return;  // a flat block has no inside
      const auto inside = [&](const Vec3f& x) {
        return edge_only ? reference::in_edge_only_block(mesh, face, x, r) : reference::in_block(mesh, face, x, r);
      };
      const Point3 centre = mean_of(picture);
      for (const auto& patch : picture.patches) {
        std::size_t missed = 0, beyond = 0;
        for (const auto& t : patch.triangles) {
          missed += !inside(on_ray(picture, t, centre, 0.999));
          beyond += inside(on_ray(picture, t, centre, 1.01));
        }
        CHECK(missed == 0);
        CHECK(beyond == 0);
        ++patches;
      }
    };
    for (Index v = 0; v < topology.vertex_count; ++v) check(reference::vertex_face(v), false);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      check(reference::edge_face(static_cast<Index>(e)), false);
      check(reference::edge_face(static_cast<Index>(e)), true);
    }
    for (std::size_t t = 0; t < topology.triangles.size(); ++t)
      check(reference::triangle_face(static_cast<Index>(t)), false);
  }
  CHECK(patches > 200);
}

TEST_CASE(
    "block_picture: open are the ends of edges and the walls of triangles, closed everything else, as printed in Eq. 8 "
    "to 10",
    "[unit]") {
  const Surface surface = tetrahedron();
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  for (const Face face : {reference::vertex_face(1), reference::edge_face(2), reference::triangle_face(2)}) {
    for (const auto& patch : reference::block_picture(mesh, face, 1).patches) {
      const bool open = (face.kind == FaceKind::edge && patch.kind == BlockMargin::Kind::end) ||
                        (face.kind == FaceKind::triangle && patch.kind == BlockMargin::Kind::wall);
      CHECK(patch.closed != open);
    }
  }
  // The patches lie on a cylinder, on two planes of kind `end` and on two planes of kind `wall`.
  CHECK(reference::block_picture(mesh, reference::edge_face(2), 1).patches.size() == 5);
  const Surface flat = grid(3);
  const auto names = flat.topology();
  // The block of a flat vertex is a line segment on either side of the sheet.
  CHECK(reference::block_picture({names, flat.positions}, reference::vertex_face(4), 1).patches.size() == 2);
  const Surface star = saddle();
  const auto around = star.topology();
  CHECK(reference::block_picture({around, star.positions}, reference::vertex_face(0), 1).patches.empty());
}
