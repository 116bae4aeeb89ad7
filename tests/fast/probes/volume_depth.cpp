// Tests the search of volumes on the CPU against hand-computed values.
#include "compare/stages/volume_depth.hpp"

#include <algorithm>
#include <cmath>

#include "compare/contestant.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "fast/cpu/cpu.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

/// Boxes 2 m wide about given centres; each is a part.
struct Boxes {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  Topology topology;

  explicit Boxes(const std::vector<Vec3f>& centres) {
    // quads of the cube, counterclockwise from outside; bit 0: x, bit 1: y, bit 2: z
    constexpr std::array<std::array<Index, 4>, 6> quads{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const Vec3f& c : centres) {
      const auto base = static_cast<Index>(positions.size());
      for (int k = 0; k < 8; ++k)
        positions.push_back({c.x + ((k & 1) != 0 ? 1.0f : -1.0f), c.y + ((k & 2) != 0 ? 1.0f : -1.0f),
                             c.z + ((k & 4) != 0 ? 1.0f : -1.0f)});
      for (const auto& [p, q, s, t] : quads) {
        triangles.push_back({base + p, base + q, base + s});
        triangles.push_back({base + p, base + s, base + t});
      }
    }
    topology = build_topology(static_cast<Index>(positions.size()), triangles);
  }

  std::vector<VolumeContact> ask(const std::vector<Vec3f>& points, float r) const {
    return ogc::fast::cpu_contestant().volume_depth({&topology, positions, r, points}).contacts;
  }
};

}  // namespace

TEST_CASE("the depth is r from both sides of a volume's surface", "[unit]") {
  const Boxes box({{0, 0, 0}});
  for (const float height : {-1e-6f, 1e-6f}) {
    const auto contacts = box.ask({{0.25f, 0.125f, 1 + height}}, 0.5f);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].inside == (height < 0 ? 1 : 0));
    CHECK(contacts[0].depth == Approx(0.5).margin(2e-6));
    CHECK(contacts[0].direction.z == 1);
    CHECK(contacts[0].face.kind == FaceKind::triangle);
  }
}

TEST_CASE("a point deep inside is found, however small r is", "[unit]") {
  const Boxes box({{0, 0, 0}});
  const auto contacts = box.ask({{0.1f, 0.2f, 0.3f}}, 1e-3f);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].inside == 1);
  CHECK(contacts[0].depth == Approx(0.701));
  CHECK(contacts[0].direction.z == 1);
}

TEST_CASE("at ridges and corners a point is outside and is pushed away from them", "[unit]") {
  const Boxes box({{0, 0, 0}});
  const auto at_edge = box.ask({{1.25f, 1.25f, 0.125f}}, 0.5f);
  REQUIRE(at_edge.size() == 1);
  CHECK(at_edge[0].face.kind == FaceKind::edge);
  CHECK(at_edge[0].direction.x == Approx(std::sqrt(0.5)));
  CHECK(at_edge[0].depth == Approx(0.5 - 0.25 * std::sqrt(2.0)));
  const auto at_corner = box.ask({{-1.125f, -1.125f, -1.125f}}, 0.5f);
  REQUIRE(at_corner.size() == 1);
  CHECK(at_corner[0].face.kind == FaceKind::vertex);
  CHECK(at_corner[0].direction.x == Approx(-std::sqrt(1.0 / 3)));
}

TEST_CASE("each part answers by itself: one holds the point, the other is near", "[unit]") {
  const Boxes boxes({{0, 0, 0}, {2.25f, 0, 0}, {9, 0, 0}});
  const auto contacts = boxes.ask({{0.875f, 0.0625f, 0.125f}}, 0.5f);
  REQUIRE(contacts.size() == 2);
  CHECK(contacts[0].inside == 0);
  CHECK(contacts[0].depth == Approx(0.5 - 0.375));
  CHECK(contacts[0].direction.x == -1);
  CHECK(contacts[1].inside == 1);
  CHECK(contacts[1].depth == Approx(0.5 + 0.125));
  CHECK(contacts[1].direction.x == 1);
}

TEST_CASE("a void belongs to the part around it: nobody in it is inside, and the wall pushes out on its nearer side",
          "[unit]") {
  Boxes hollow({{0, 0, 0}, {0, 0, 0}});
  for (std::size_t v = 8; v < 16; ++v) {
    Vec3f& x = hollow.positions[v];
    x = {x.x / 2, x.y / 2, x.z / 2};
  }
  for (std::size_t t = 12; t < 24; ++t) std::swap(hollow.triangles[t][1], hollow.triangles[t][2]);
  hollow.topology = build_topology(16, hollow.triangles);
  const std::vector<Edge> cavities{{8, 0}};
  const std::vector<Vec3f> points{{0.1f, 0.2f, 0.875f}, {0.1f, 0.2f, 0.625f}, {0.1f, 0.2f, 0.375f}, {0.1f, 0, 0}};
  const VolumeDepthOut out = ogc::fast::cpu_contestant().volume_depth(
      {&hollow.topology, hollow.positions, 0.25f, points, {}, {}, cavities});
  REQUIRE(out.contacts.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(out.contacts[i].point == static_cast<Index>(i));
    CHECK(out.contacts[i].inside == (i < 2 ? 1 : 0));
    CHECK(out.contacts[i].depth == (i < 2 ? 0.375f : 0.125f));
    CHECK(out.contacts[i].direction.z == (i == 0 ? 1 : -1));
  }
}

namespace {

/// A row of cubes of six tetrahedra each, 2 m wide, high and deep. `x` has the positions of the layers between cubes.
struct Row {
  std::vector<Vec3f> positions;
  std::vector<Tetrahedron> tetrahedra;
  Topology topology;

  explicit Row(const std::vector<float>& x) {
    constexpr std::array<std::array<Index, 3>, 6> ways{
        {{4, 2, 1}, {2, 1, 4}, {1, 4, 2}, {4, 1, 2}, {2, 4, 1}, {1, 2, 4}}};
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (const float y : {0.0f, 2.0f})
        for (const float z : {0.0f, 2.0f}) positions.push_back({x[i], y, z});
      if (i + 1 == x.size()) continue;
      for (std::size_t w = 0; w < ways.size(); ++w) {
        const Index a = 4 * static_cast<Index>(i), b = a + ways[w][0], c = b + ways[w][1], d = c + ways[w][2];
        tetrahedra.push_back(w < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
      }
    }
    topology = build_topology(static_cast<Index>(positions.size()), boundary_triangles(tetrahedra));
  }

  VolumeDepthOut ask(const std::vector<Vec3f>& points, float r, const std::vector<Index>& own = {}) const {
    return ogc::fast::cpu_contestant().volume_depth({&topology, positions, r, points, tetrahedra, own});
  }
};

}  // namespace

TEST_CASE("in a body of tetrahedra the depth is r at the surface, and that of the nearest side plus r inside",
          "[unit]") {
  const Row row({0, 2, 4});
  for (const float height : {-1e-6f, 1e-6f}) {
    const auto out = row.ask({{1.25f, 0.75f, 2 + height}}, 0.5f);
    REQUIRE(out.contacts.size() == 1);
    CHECK(out.contacts[0].inside == (height < 0 ? 1 : 0));
    CHECK(out.contacts[0].depth == Approx(0.5).margin(2e-6));
    CHECK(out.contacts[0].direction.z == 1);
  }
  // paths also through the edges and vertices between the cells
  for (const Vec3f x : {Vec3f{2, 1, 1.25f}, Vec3f{2, 1.5f, 1.75f}, Vec3f{1, 1, 1.125f}, Vec3f{3, 1, 1.125f}}) {
    const auto out = row.ask({x}, 0.125f);
    REQUIRE(out.contacts.size() == 1);
    CHECK(out.contacts[0].depth == 2 - x.z + 0.125f);
    CHECK(out.unresolved.empty());
  }
}

TEST_CASE("each sheet of a body that lies in itself has its own contact, and none a way through what is inside out",
          "[unit]") {
  // The middle cell is inside out. Both other cells contain x = 2.5. The layers nearest to this point, at 3 and at 2,
  // are not part of the boundary.
  const Row row({0, 3, 2, 5});
  const auto out = row.ask({{2.5f, 1, 0.75f}, {1, 1, 0.75f}}, 0.25f);
  REQUIRE(out.contacts.size() == 3);
  for (const VolumeContact& contact : out.contacts) {
    CHECK(contact.inside == 1);
    CHECK(contact.depth == 0.75f + 0.25f);
    CHECK(contact.direction.z == -1);
  }
  CHECK(out.contacts[1].point == 0);
}

TEST_CASE("a vertex of a body asks without its own sheet and faces", "[unit]") {
  const Row apart({0, 2, 4}), folded({0, 3, 2, 5});
  for (const Row* row : {&apart, &folded}) {
    std::vector<Index> own;
    for (std::size_t v = 0; v < row->positions.size(); ++v) own.push_back(static_cast<Index>(v));
    const auto out = row->ask(row->positions, 0.25f, own);
    for (const VolumeContact& contact : out.contacts) {
      const Triangle& corners = row->topology.triangles[static_cast<std::size_t>(contact.triangle)];
      CHECK(std::find(corners.begin(), corners.end(), contact.point) == corners.end());
    }
    const bool is_in_another = std::any_of(out.contacts.begin(), out.contacts.end(),
                                           [](const VolumeContact& c) { return c.inside != 0; });
    CHECK(is_in_another == (row == &folded));
  }
}
