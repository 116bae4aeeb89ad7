// Tests §3.9 inside the body: the depth by the definition of Chen et al. 2023, on bodies whose depth can also be
// derived in another way.
#include "reference/definitions/tet_volume.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "compare/problem/error.hpp"
#include "reference/definitions/volumetric_contact.hpp"
#include "reference/geometry/closest_face.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::BoundaryDepth;
using reference::BoundaryPath;
using reference::Tetrahedron;
using reference::TetVolume;

namespace {

struct Body {
  std::vector<Vec3f> positions;
  std::vector<Tetrahedron> tetrahedra;
};

/// Returns nx × ny × nz cells, each of six tetrahedra around its diagonal; vertex (i, j, k) lies at map(i, j, k).
/// Tetrahedra are listed cell by cell; i changes slowest.
template <class Map>
Body blocks(int nx, int ny, int nz, Map map) {
  Body body;
  const auto number = [&](int i, int j, int k) { return static_cast<Index>((i * (ny + 1) + j) * (nz + 1) + k); };
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      for (int k = 0; k <= nz; ++k) body.positions.push_back(map(i, j, k));
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        for (std::size_t o = 0; o < 6; ++o) {
          std::array<int, 3> at{i, j, k};
          Tetrahedron t{number(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[static_cast<std::size_t>(orders[o][s])];
            t[s + 1] = number(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(t[2], t[3]);  // odd permutations have the other orientation
          body.tetrahedra.push_back(t);
        }
  return body;
}

Body box(int n) {
  return blocks(n, n, n, [](int i, int j, int k) {
    return Vec3f{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
  });
}

constexpr int ring_cells = 40, ring_turn = 36;  // the bar winds once in 36 cells: the last 4 cells lie in the first 4

/// Returns a bar bent around the z axis by more than 2π, so that its two ends overlap. Radius 1 … 3, height 0 … 2.
Body overlapping_ring() {
  return blocks(2, ring_cells, 2, [](int i, int j, int k) {
    const double angle = 2 * std::numbers::pi * j / ring_turn, radius = 1 + i;
    return Vec3f{static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)),
                 static_cast<float>(k)};
  });
}

/// Returns the number of the ring's cell, counted along the bar, that contains a tetrahedron.
int ring_cell(Index tetrahedron) { return tetrahedron / 12 % ring_cells; }

double euclidean(const Vec3f& x, const std::array<double, 3>& y) {
  return std::hypot(x.x - y[0], x.y - y[1], x.z - y[2]);
}

/// Returns the distance of x from a boundary triangle, by its closest feature (Algorithm 1). This shares no formula
/// with the closest points in rational numbers.
double triangle_distance(const Body& body, const reference::BoundaryTriangle& side, const Vec3f& x) {
  const auto corner = [&](std::size_t k) { return body.positions[static_cast<std::size_t>(side.vertices[k])]; };
  const std::array<Vec3f, 3> corners{corner(0), corner(1), corner(2)};
  return reference::distance(reference::feature_gap(corners, reference::closest_feature(corners, x), x));
}

std::string refusal(const Body& body) {
  try {
    TetVolume(body.positions, body.tetrahedra);
  } catch (const compare::InputError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("tet volume: in a box the depth is the distance to the nearest side, exactly, whatever the path crosses",
          "[property]") {
  const Body body = box(2);
  const TetVolume volume(body.positions, body.tetrahedra);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> quarter(0, 8);
  std::uniform_real_distribution<float> anywhere(0, 2);
  for (int n = 0; n < 40; ++n) {
    const auto coordinate = [&] { return n % 2 == 0 ? static_cast<float>(quarter(random)) / 4 : anywhere(random); };
    const Vec3f x{coordinate(), coordinate(), coordinate()};
    CAPTURE(x.x, x.y, x.z);
    const auto sheets = volume.sheets(x);
    REQUIRE(sheets.size() == 1);
    const double expected = std::min({static_cast<double>(x.x), 2.0 - x.x, static_cast<double>(x.y), 2.0 - x.y,
                                      static_cast<double>(x.z), 2.0 - x.z});
    for (const Index t : sheets[0]) {
      const BoundaryDepth depth = volume.shortest_path_to_boundary(x, t);
      CHECK(depth.path.length == expected);  // the square of a short number is exact
      CHECK(depth.refused == 0);
      CHECK(depth.path.squared_length[0] <= expected * expected);
    }
  }
}

TEST_CASE(
    "tet volume: where a bar overlaps itself each sheet has its own depth, and Euclid's nearest boundary is the wrong "
    "one",
    "[property]") {
  const Body body = overlapping_ring();
  const TetVolume volume(body.positions, body.tetrahedra);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.01, 0.99), radius(1.2, 2.8), height(0.1, 1.9);
  int misled = 0;
  for (int n = 0; n < 20; ++n) {
    // Half of the points lie near an end of the bar.
    const double overlap = ring_cells - ring_turn,
                 cell = n % 2 == 0 ? overlap * share(random) : overlap - 0.5 * share(random);
    const double angle = 2 * std::numbers::pi * cell / ring_turn, rho = radius(random);
    const Vec3f x{static_cast<float>(rho * std::cos(angle)), static_cast<float>(rho * std::sin(angle)),
                  static_cast<float>(height(random))};
    const auto sheets = volume.sheets(x);
    REQUIRE(sheets.size() == 2);
    for (const auto& sheet : sheets) {
      // Within ±π/2 of the sheet the bar does not overlap itself, so the nearest boundary there is the answer.
      double expected = 1e9;
      for (const auto& side : volume.boundary())
        if (std::abs(ring_cell(side.tetrahedron) - ring_cell(sheet[0])) < ring_turn / 4)
          expected = std::min(expected, triangle_distance(body, side, x));
      const BoundaryDepth depth = volume.shortest_path_to_boundary(x, sheet[0]);
      CHECK(depth.path.length == Approx(expected).epsilon(1e-15));
      CHECK(euclidean(x, depth.path.end) == Approx(depth.path.length));
      misled += depth.refused > 0;
    }
  }
  CHECK(misled > 10);
}

TEST_CASE(
    "tet volume: just inside the first end of the overlapping bar the other end is far by Euclid's measure and near by "
    "a valid path",
    "[unit]") {
  const Body body = overlapping_ring();
  const TetVolume volume(body.positions, body.tetrahedra);
  // The point is 0.02 of a cell before the bar's end, which belongs to the second sheet. The first sheet goes on for 36
  // cells.
  const double angle = 2 * std::numbers::pi * (ring_cells - ring_turn - 0.02) / ring_turn;
  const Vec3f x{static_cast<float>(2 * std::cos(angle)), static_cast<float>(2 * std::sin(angle)), 1.0f};
  const auto sheets = volume.sheets(x);
  REQUIRE(sheets.size() == 2);
  std::array<double, 2> depth{};
  for (std::size_t s = 0; s < 2; ++s) depth[s] = volume.shortest_path_to_boundary(x, sheets[s][0]).path.length;
  CHECK(depth[0] > 0.9);   // the bar's top, bottom or sides, about 1 away
  CHECK(depth[1] < 0.01);  // the bar's end, 2 sin(0.02 · 10°) away
  const auto& refused = volume.shortest_path_to_boundary(x, sheets[0][0]);
  CHECK(refused.refused >= 2);  // the end's triangles belong to the other sheet
}

TEST_CASE("tet volume: the candidates of all boundary triangles give the depth, and a valid one is never from outside",
          "[property]") {
  const Body body = overlapping_ring();
  const TetVolume volume(body.positions, body.tetrahedra);
  const Vec3f x{2.25f, 0.5f, 0.75f};
  for (const auto& sheet : volume.sheets(x)) {
    const auto paths = volume.boundary_paths(x, sheet[0]);
    const BoundaryDepth depth = volume.shortest_path_to_boundary(x, sheet[0]);
    double shortest = 1e9;
    for (const BoundaryPath& path : paths) {
      CHECK(path.length <= euclidean(x, path.end) * (1 + 1e-15));
      if (path.valid) shortest = std::min(shortest, path.length);
    }
    CHECK(shortest == depth.path.length);
    CHECK(paths[static_cast<std::size_t>(depth.path.triangle)].valid);
  }
}

TEST_CASE(
    "tet volume: outside there is no sheet, on the boundary the depth is zero, and a wrong tetrahedron is refused",
    "[unit]") {
  const Body body = box(1);
  const TetVolume volume(body.positions, body.tetrahedra);
  CHECK(volume.boundary().size() == 12);
  CHECK(volume.sheets({1.5f, 0.5f, 0.5f}).empty());
  CHECK(volume.sheets({-1e-30f, 0, 0}).empty());
  for (const Vec3f& x : {Vec3f{0, 0, 0}, Vec3f{1, 1, 1}, Vec3f{0.5f, 0, 0}, Vec3f{0.5f, 0.25f, 1}}) {
    const auto sheets = volume.sheets(x);
    REQUIRE(sheets.size() == 1);
    CHECK(volume.shortest_path_to_boundary(x, sheets[0][0]).path.length == 0);
  }
  CHECK_THROWS_AS(volume.shortest_path_to_boundary({1.5f, 0.5f, 0.5f}, 0), compare::InputError);
  CHECK_THROWS_AS(volume.shortest_path_to_boundary({0.5f, 0.5f, 0.5f}, 99), compare::InputError);
  const BoundaryDepth middle = volume.shortest_path_to_boundary({0.5f, 0.5f, 0.5f}, 0);
  CHECK(middle.path.length == 0.5);
  CHECK(middle.equally_near.size() == 12);  // the centre of each side lies on the diagonal between its two triangles
}

TEST_CASE("tet volume: inverted, flat, folded, crowded and wound tetrahedra are refused by their names", "[unit]") {
  Body inverted = box(1);
  std::swap(inverted.tetrahedra[4][0], inverted.tetrahedra[4][1]);
  CHECK(contains(refusal(inverted), "tetrahedron 4 is inverted"));
  Body flat = box(1);
  flat.tetrahedra.push_back({0, 1, 2, 3});
  CHECK(contains(refusal(flat), "tetrahedron 6 is flat"));
  Body wrong = box(1);
  wrong.tetrahedra[2][1] = 8;
  CHECK(contains(refusal(wrong), "tetrahedron 2 names vertex 8"));
  const Body folded{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}}, {{0, 1, 2, 3}, {0, 1, 2, 4}}};
  CHECK(contains(refusal(folded), "0 and 1 lie on the same side"));
  const Body crowded{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, -1}},
                     {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 2, 1, 5}}};
  CHECK(contains(refusal(crowded), "belongs to 3 tetrahedra"));
  // Six tetrahedra wind once around the edge of vertices 0 and 1. These twelve wind twice, over twelve rim vertices.
  Body wound{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (int k = 0; k < 12; ++k) {
    const double angle = std::numbers::pi * k / 3;
    wound.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.5f});
    wound.tetrahedra.push_back({0, 1, 2 + k, 2 + (k + 1) % 12});
  }
  CHECK(contains(refusal(wound), "inner edge of vertices 0, 1 wind 2 times"));
}

TEST_CASE("tet volume: two bodies that share one inner vertex only are refused", "[unit]") {
  Body two = box(2);
  const Body other = box(2);
  const auto shift = static_cast<Index>(two.positions.size());
  constexpr Index middle = 13;
  two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
  for (Tetrahedron t : other.tetrahedra) {
    for (Index& v : t) v = v == middle ? middle : v + shift;
    two.tetrahedra.push_back(t);
  }
  CHECK(contains(refusal(two), "inner vertex 13 alone"));
}

TEST_CASE(
    "volumetric contact: the depth is r on the surface from either side, d + r inside, r - d outside, one contact for "
    "each sheet",
    "[unit]") {
  const Body body = box(2);
  const TetVolume volume(body.positions, body.tetrahedra);
  const compare::Topology topology = reference::surface_topology(volume, static_cast<Index>(body.positions.size()));
  const reference::ClosedSurface surface({topology, body.positions});
  const auto depths = [&](const Vec3f& x) {
    std::vector<double> all;
    for (const auto& contact : reference::volumetric_contacts(volume, surface, x, 0.5f)) all.push_back(contact.depth);
    return all;
  };
  CHECK(depths({0.75f, 1.25f, 2.25f}) == std::vector<double>{0.25});
  CHECK(depths({0.75f, 1.25f, 2}) == std::vector<double>{0.5});
  CHECK(depths({0.75f, 1.25f, 1.875f}) == std::vector<double>{0.625});
  CHECK(depths({0.75f, 1.25f, 2.5f}).empty());
  CHECK(depths({2.25f, 2, 1}).size() == 1);  // beside the middle of a ridge
  // A vertex of the body has no contact with the sheet and the faces to which it belongs.
  const Vec3f corner = body.positions.back();
  CHECK(reference::volumetric_contacts(volume, surface, corner, 0.5f, static_cast<Index>(body.positions.size()) - 1)
            .empty());
  CHECK_FALSE(reference::volumetric_contacts(volume, surface, corner, 0.5f).empty());
  const Body ring = overlapping_ring();
  const TetVolume bar(ring.positions, ring.tetrahedra);
  const compare::Topology ring_topology = reference::surface_topology(bar, static_cast<Index>(ring.positions.size()));
  const reference::ClosedSurface skin({ring_topology, ring.positions});
  const Vec3f x{2, 0.5f, 1.2f};
  CHECK(reference::volumetric_contacts(bar, skin, x, 0.5f).size() == 2);
  CHECK(skin.locate(x).winding == 2);
}

TEST_CASE("closed surface and tet volume agree: the winding number of a body's surface is its number of sheets",
          "[property]") {
  const Body ring = overlapping_ring();
  const TetVolume bar(ring.positions, ring.tetrahedra);
  const compare::Topology topology = reference::surface_topology(bar, static_cast<Index>(ring.positions.size()));
  const reference::ClosedSurface skin({topology, ring.positions});
  std::mt19937 random(6);
  std::uniform_real_distribution<float> across(-3.2f, 3.2f), up(-0.2f, 2.2f);
  std::set<int> windings;
  for (int n = 0; n < 120; ++n) {
    const Vec3f x{across(random), across(random), up(random)};
    const auto place = skin.locate(x);
    windings.insert(place.winding);
    if (!place.on_surface) CHECK(place.winding == static_cast<int>(bar.sheets(x).size()));
  }
  CHECK(windings == std::set<int>{0, 1, 2});
}
