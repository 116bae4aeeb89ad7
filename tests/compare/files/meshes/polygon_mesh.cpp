// Tests that triangulation keeps area, orientation and corners. Tests that removed and merged elements are reported and
// leave the other elements in place.
#include "compare/files/meshes/polygon_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/triangulate.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

std::vector<Index> in_order(std::size_t count) {
  std::vector<Index> corners(count);
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

/// Returns twice the signed area of a polygon or triangle in the plane z = 0.
double area(const std::vector<Vec3>& positions, std::span<const Index> corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &a = positions[static_cast<std::size_t>(corners[k])],
               &b = positions[static_cast<std::size_t>(corners[(k + 1) % corners.size()])];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

/// Checks that the cut has n − 2 triangles with the polygon's orientation and total area, and has each side of the
/// polygon once.
void check_cut(const std::vector<Vec3>& positions) {
  const std::vector<Index> corners = in_order(positions.size());
  const std::vector<Triangle> triangles = triangulate(corners, positions);
  REQUIRE(triangles.size() == positions.size() - 2);
  double sum = 0;
  std::map<Edge, int> sides;
  for (const Triangle& t : triangles) {
    CHECK(area(positions, t) > 0);
    sum += area(positions, t);
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(sum == Approx(area(positions, corners)));
  for (std::size_t k = 0; k < corners.size(); ++k) CHECK(sides[{corners[k], corners[(k + 1) % corners.size()]}] == 1);
  for (const auto& [side, count] : sides) {
    const bool is_outer = (side[0] + 1) % static_cast<Index>(corners.size()) == side[1];
    CHECK(count == 1);
    CHECK((is_outer || sides.contains({side[1], side[0]})));
  }
}

std::vector<Vec3> star(std::size_t count, std::mt19937& random) {
  std::vector<Vec3> positions;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    const double radius = std::uniform_real_distribution<double>(0.2, 1)(random);
    positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return positions;
}

LoadedMesh of_obj(const std::string& text, const MeshOptions& options = {}) {
  return make_mesh(parse_obj(text, "m.obj"), options);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("polygons are cut into triangles that cover them once, star-shaped, convex or with corners on straight sides",
          "[property]") {
  std::mt19937 random(5);
  for (std::size_t count = 4; count <= 40; ++count) {
    for (int repetition = 0; repetition < 5; ++repetition) check_cut(star(count, random));
  }
  std::vector<Vec3> round, comb{{0, 0, 0}, {20, 0, 0}}, notched;
  for (int k = 0; k < 100; ++k)
    round.push_back({std::cos(k * std::numbers::pi / 50), std::sin(k * std::numbers::pi / 50), 0});
  check_cut(round);
  for (int k = 20; k-- > 0;) comb.push_back({k + 0.5, k % 2 == 0 ? 0.1 : 5.0, 0});
  check_cut(comb);
  for (int side = 0; side < 4; ++side) {  // ten corners on each side of a square
    for (int k = 0; k < 10; ++k) {
      const std::array<Vec3, 4> places{{{0.1 * k, 0, 0}, {1, 0.1 * k, 0}, {1 - 0.1 * k, 1, 0}, {0, 1 - 0.1 * k, 0}}};
      notched.push_back(places[static_cast<std::size_t>(side)]);
    }
  }
  check_cut(notched);
}

TEST_CASE("a quad is cut from its first corner to its third, a concave one from where it is whole", "[unit]") {
  const auto cut = [](const std::vector<Vec3>& positions) { return triangulate(in_order(4), positions); };
  const std::vector<Triangle> usual{{0, 1, 2}, {0, 2, 3}}, turned{{0, 1, 3}, {1, 2, 3}};
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == usual);
  CHECK(cut({{0, 0, 0.3}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}}) == usual);  // not in a plane
  CHECK(cut({{0, 0, 0}, {1, 0, 6e-17}, {1 - 1e-16, 1, 0}, {0, 1 + 1e-16, 0}}) == usual);
  CHECK(cut({{0, 0, 0}, {2, 0, 0}, {0.2, 0.2, 0}, {0, 2, 0}}) == usual);   // points inwards at its third corner
  CHECK(cut({{2, 0, 0}, {0.2, 0.2, 0}, {0, 2, 0}, {0, 0, 0}}) == turned);  // points inwards at its second corner
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {2, 1e-17, 0}, {1, 1, 0}}) == turned);  // its second corner lies on a straight side
  CHECK(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).empty());        // crosses itself
  CHECK(cut({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}).empty());        // no area
}

TEST_CASE("a mesh says what was cut and left out, and where its elements stand in the file", "[unit]") {
  const LoadedMesh loaded = of_obj("v 9 9 9\n" + square + "v 8 8 8\nv 2 0 0\nf 2 3 4 5\nf 3 7 4\n");
  CHECK(loaded.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
  CHECK(loaded.mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}});
  CHECK(loaded.notes ==
        std::vector<std::string>{
            "m.obj: 1 face of more than three corners was cut into 2 triangles",
            "m.obj: 2 vertex positions that no face and no edge uses were left out, the first: vertex 1 (line 1)"});
  const ElementNames names(loaded.source);
  CHECK(names.vertex(4) == "vertex 7 (line 7)");
  CHECK(names.triangle(1, loaded.mesh.triangles[1]) == "face 1 (vertices 2, 4, 5; line 8)");
  CHECK(names.triangle(2, loaded.mesh.triangles[2]) == "face 2 (vertices 3, 7, 4; line 9)");
  CHECK(of_obj(square + "f 1 2 3\nf 1 3 4\n").notes.empty());
}

TEST_CASE("what options do not take is refused with the first of them and the option's name", "[unit]") {
  CHECK_THROWS_WITH(
      of_obj(square + "f 1 2 3 4\n", {.triangulate = false}),
      ContainsSubstring(
          "m.obj: has 1 face of more than three corners, the first: face 1 (line 5) of 4; take --triangulate"));
  CHECK_THROWS_WITH(
      of_obj(square + "f 1 2 3\n", {.drop_unused = false}),
      ContainsSubstring("m.obj: has 1 vertex position that no face and no edge uses, the first: vertex 4 (line "
                        "4); take --drop-unused"));
  CHECK_THROWS_WITH(of_obj(square), ContainsSubstring("m.obj: has 4 vertex positions and no face"));
  CHECK_THROWS_WITH(of_obj(square + "f 1 2 3\nf 1 3 2 4\n"),
                    ContainsSubstring("m.obj: face 2 (line 6): its 4 corners make no simple polygon"));
  CHECK_THROWS_WITH(of_obj(square + "f 1 2 1 2\n"),
                    ContainsSubstring("m.obj: has 4 vertex positions and no face that has an area; the first that has "
                                      "none: face 1 (line 5)"));
}

TEST_CASE("a polygon that names a vertex twice in a row has it once", "[unit]") {
  CHECK(of_obj(square + "f 1 2 2 3\nf 1 3 4 1\n").mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("faces that collapse, have no area or are there twice are left out, with a word and a count; strictly none",
          "[unit]") {
  const std::string whole = square + "v 0.5 0.5 0\nv 9 9 9\nv 1 0 0\nf 1 2 3\nf 1 3 4\n",  // lines 8 and 9
      broken = whole + "f 1 1 6\nf 1 5 3\nf 2 7 3\nf 3 1 2\nf 2 1 3\nf 1 5 3 5\nf 3 3 4 4\n";
  const LoadedMesh loaded = of_obj(broken);
  CHECK(loaded.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(loaded.mesh.positions.size() == 4);
  CHECK_THAT(loaded.notes.at(0),
             ContainsSubstring(
                 "m.obj: 7 faces were left out: 2 name less than three different vertices, 3 have no area, 2 have "
                 "the same vertices as others; the first: face 3 (line 10)"));
  CHECK(of_obj(broken + "f 1 2 4\n").source.faces == std::vector<Index>{0, 1, 9});
  CHECK(of_obj(whole, {.strict = true}).mesh.triangles.size() == 2);
  CHECK_THROWS_WITH(
      of_obj(whole + "f 2 1 3\n", {.strict = true}),
      ContainsSubstring("m.obj: has 1 face that is none: 1 has the same vertices as another; the first: face 3 "
                        "(line 10); leave --strict out"));
  CHECK_THROWS_WITH(of_obj(square + "f 1 1 2\n"),
                    ContainsSubstring("has 4 vertex positions and no face that has an area"));
  // With keep_unused, positions come from another file, so areas are unknown.
  CHECK(of_obj("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\nf 1 1 2\nf 3 2 1\n", {.keep_unused = true}).mesh.triangles ==
        std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("what has no area in single precision is left out where stages are to see it", "[unit]") {
  const std::string sliver = square + "v 1.00000000001 0 0\nf 1 2 3\nf 1 3 4\nf 2 5 3\n";
  CHECK(of_obj(sliver).mesh.triangles.size() == 3);
  CHECK(of_obj(sliver, {.rounded = true}).mesh.triangles.size() == 2);
  const std::string dust = square + "v 2 1e-17 0\nf 1 2 3\nf 1 3 4\nf 1 2 5\n";
  CHECK(of_obj(dust).mesh.triangles.size() == 3);
  CHECK(of_obj(dust, {.rounded = true}).mesh.triangles.size() == 2);
}

TEST_CASE("welding merges vertices at exactly one place, and counts them", "[unit]") {
  const std::string split = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  CHECK(of_obj(split).mesh.positions.size() == 6);
  const LoadedMesh welded = of_obj(split, {.weld = true});
  CHECK(welded.mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(welded.notes ==
        std::vector<std::string>{
            "m.obj: 2 corners with exactly the coordinates of another were merged with it: 4 vertices are left"});
  CHECK(ElementNames(welded.source).vertex(3) == "vertex 6 (line 6)");
}
