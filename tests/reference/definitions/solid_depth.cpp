// Tests the truth of stage volume_depth for tetrahedra. If the map from the rest shape to the positions is locally
// injective, the exact answer is the answer of TetVolume. Tetrahedra without positive volume neither hold a point nor
// let a path through.
#include "reference/definitions/solid_depth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "reference/definitions/tet_volume.hpp"
#include "reference/definitions/volume_depth.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::VolumeDepthTruth;
using compare::VolumePartTruth;
using reference::Tetrahedron;

namespace {

/// Cells of six tetrahedra each; vertex (i, j, k) lies at map(i, j, k).
struct Cells {
  std::vector<Vec3f> positions;
  std::vector<Tetrahedron> tetrahedra;
  int ny, nz;

  template <class Map>
  Cells(int x, int y, int z, Map map) : ny(y), nz(z) {
    for (int i = 0; i <= x; ++i)
      for (int j = 0; j <= y; ++j)
        for (int k = 0; k <= z; ++k) positions.push_back(map(i, j, k));
    constexpr std::array<std::array<std::size_t, 3>, 6> ways{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const std::array<Index, 3> step{(y + 1) * (z + 1), z + 1, 1};
    for (int i = 0; i < x; ++i)
      for (int j = 0; j < y; ++j)
        for (int k = 0; k < z; ++k)
          for (std::size_t w = 0; w < 6; ++w) {
            const Index a = vertex(i, j, k), b = a + step[ways[w][0]], c = b + step[ways[w][1]],
                        d = c + step[ways[w][2]];
            tetrahedra.push_back(w < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
          }
  }

  Index vertex(int i, int j, int k) const { return (i * (ny + 1) + j) * (nz + 1) + k; }
};

Vec3f straight(int i, int j, int k) { return {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)}; }

/// Returns a bar bent by more than 2π, so that its ends overlap.
Cells ring() {
  return {2, 20, 2, [](int i, int j, int k) {
            const double angle = 2 * std::numbers::pi * j / 17, radius = 1 + i;
            return Vec3f{static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)),
                         static_cast<float>(k)};
          }};
}

VolumeDepthTruth ask(const Cells& body, const compare::Topology& surface, const std::vector<Vec3f>& points, float r,
                     const std::vector<Index>& own = {}) {
  return reference::volume_depth({&surface, body.positions, r, points, body.tetrahedra, own});
}

compare::Topology surface_of(const Cells& body) {
  std::vector<compare::Triangle> triangles;
  const reference::TetVolume volume(body.positions, body.tetrahedra);
  for (const auto& side : volume.boundary()) triangles.push_back(side.vertices);
  return compare::build_topology(static_cast<Index>(body.positions.size()), triangles);
}

/// Returns the depths of the exact contacts on the given side of the surface, ascending.
std::vector<double> depths(const VolumePartTruth& part, bool inside) {
  std::vector<double> all;
  for (const compare::VolumeAnswer* answer : compare::exact_answers(part))
    if ((answer->contact.inside != 0) == inside) all.push_back(answer->depth);
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("where the map is locally injective the contacts of tetrahedra are those of the shortest paths",
          "[property]") {
  std::mt19937 random(31);
  std::uniform_real_distribution<float> anywhere(-3.2f, 3.2f), height(-0.2f, 2.2f);
  const float r = 0.3f;
  for (const Cells& body : {Cells(2, 2, 2, straight), ring()}) {
    const compare::Topology topology = surface_of(body);
    const reference::TetVolume volume(body.positions, body.tetrahedra);
    std::vector<Vec3f> points;
    for (int n = 0; n < 240; ++n) {
      const float x = anywhere(random), y = anywhere(random);
      points.push_back({x, y, height(random)});
    }
    const VolumeDepthTruth truth = ask(body, topology, points, r);
    std::size_t several = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      REQUIRE(truth.parts[i].size() == 1);
      const VolumePartTruth& part = truth.parts[i].front();
      const auto sheets = volume.sheets(points[i]);
      CHECK(part.inside == !sheets.empty());
      std::map<Index, double> paths;  // by triangle: two sheets with the same nearest face have one contact
      for (const auto& sheet : sheets) {
        const reference::BoundaryPath path = volume.shortest_path_to_boundary(points[i], sheet[0]).path;
        paths[path.triangle] = path.length;
      }
      std::vector<double> wanted;
      for (const auto& [triangle, length] : paths) wanted.push_back(length);
      std::ranges::sort(wanted);
      const std::vector<double> found = depths(part, true);
      REQUIRE(found.size() == wanted.size());
      // The path's length is rounded down; the depth is within 2 ulp of double.
      for (std::size_t k = 0; k < found.size(); ++k) CHECK(std::abs(found[k] - r - wanted[k]) <= 0x1p-50 * found[k]);
      several += sheets.size() > 1;
      CHECK(depths(part, false).empty() == (!sheets.empty() || !part.needs_contact));
    }
    if (body.positions.size() > 27) CHECK(several > 3);
  }
}

TEST_CASE("a vertex asks without its own sheet and its own faces", "[property]") {
  for (const bool overlaps : {false, true}) {
    const Cells body = overlaps ? ring() : Cells(2, 2, 2, straight);
    const compare::Topology topology = surface_of(body);
    const reference::TetVolume volume(body.positions, body.tetrahedra);
    std::vector<Vec3f> points;
    std::vector<Index> own;
    for (Index v = 0; v < topology.vertex_count; ++v) {
      if (topology.vertex_triangles[static_cast<std::size_t>(v)].empty()) continue;
      own.push_back(v);
      points.push_back(body.positions[static_cast<std::size_t>(v)]);
    }
    const VolumeDepthTruth truth = ask(body, topology, points, 0.25f, own);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::size_t others = 0;
      for (const auto& sheet : volume.sheets(points[i]))
        others += std::ranges::none_of(sheet, [&](Index t) { return volume.has_vertex(t, own[i]); });
      const VolumePartTruth& part = truth.parts[i].front();
      CHECK(depths(part, true).size() == others);
      inside += others;
      for (const compare::VolumeAnswer* answer : compare::exact_answers(part)) {
        const auto vertices = reference::Complex{topology, body.positions}.vertices(answer->contact.face);
        CHECK(std::ranges::find(vertices.span(), own[i]) == vertices.span().end());
      }
    }
    CHECK((inside > 0) == overlaps);
  }
}

TEST_CASE("a way does not lead through tetrahedra that are turned inside out, nor end at theirs", "[unit]") {
  // The inner layers of three cells in a row are swapped, so the middle cell is turned inside out.
  const auto folded = [](int i, int j, int k) {
    constexpr std::array<float, 4> x{0, 3, 2, 5};
    return Vec3f{x[static_cast<std::size_t>(i)], 4.0f * static_cast<float>(j), 4.0f * static_cast<float>(k)};
  };
  const Cells body(3, 1, 1, folded);
  const compare::Topology topology = surface_of(Cells(3, 1, 1, straight));
  // The point lies in both end cells, 0.4 and 0.6 from the middle cell, and 1.75 from the bottom of each.
  const VolumeDepthTruth truth = ask(body, topology, {{2.6f, 2.0f, 1.75f}}, 0.5f);
  const VolumePartTruth& part = truth.parts[0].front();
  const std::vector<double> found = depths(part, true);
  REQUIRE(found.size() == 2);
  for (const double depth : found) CHECK(depth == 1.75 + 0.5);
  CHECK(compare::exact_unresolved(part) == 0);
}

TEST_CASE("a sheet that nothing but tetrahedra without volume surrounds has no way, and says so", "[unit]") {
  // Behind each side of one tetrahedron lies a tetrahedron of negative volume, whose apex is inside the first one.
  Cells body(1, 1, 1, straight);
  body.positions = {{0, 0, 0},     {4, 0, 0},     {0, 4, 0},    {0, 0, 4}, {1.25f, 1.25f, 1.25f},
                    {0.25f, 1, 1}, {1, 0.25f, 1}, {1, 1, 0.25f}};
  body.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}, {0, 3, 2, 5}, {0, 1, 3, 6}, {0, 2, 1, 7}};
  std::vector<compare::Triangle> triangles;
  for (std::size_t t = 1; t < 5; ++t) {
    const auto [a, b, c, apex] = body.tetrahedra[t];
    // The triangle abc also belongs to the first tetrahedron, and its normal points out of it.
    for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) triangles.push_back({p, q, apex});
  }
  const compare::Topology topology = compare::build_topology(8, triangles);
  const VolumeDepthTruth truth = ask(body, topology, {{0.9f, 0.8f, 0.7f}}, 0.5f);
  const VolumePartTruth& part = truth.parts[0].front();
  CHECK(part.inside);
  CHECK(depths(part, true).empty());
  CHECK(compare::exact_unresolved(part) == 1);
  REQUIRE(part.sheets.size() == 1);
  CHECK(part.sheets[0].may_be_unresolved);
}
