#include "fast/stages/colouring.hpp"

#include <random>
#include <set>

#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;

namespace {

RestState rest_of(const compare::Scene& scene) { return build_rest_state(scene, compare::build_topology(scene)); }

void require_valid(const RestState& rest, const Colouring& colouring) {
  const auto free = [&](int v) { return rest.mobility[static_cast<std::size_t>(v)] == Mobility::free; };
  const auto apart = [&](int a, int b) {
    return a == b || !free(a) || !free(b) ||
           colouring.colour[static_cast<std::size_t>(a)] != colouring.colour[static_cast<std::size_t>(b)];
  };
  for (const TriangleRest& t : rest.triangles) {
    for (const int a : t.corner) {
      for (const int b : t.corner) REQUIRE(apart(a, b));
    }
  }
  for (const HingeRest& h : rest.hinges) {
    for (const int a : h.vertex) {
      for (const int b : h.vertex) REQUIRE(apart(a, b));
    }
  }
  for (const SpringRest& s : rest.springs) {
    for (int a = 0; a < end_count(s); ++a) {
      for (int b = 0; b < a; ++b) REQUIRE(apart(s.end[a], s.end[b]));
    }
  }
  std::set<int> seen;
  REQUIRE(colouring.begin.size() == static_cast<std::size_t>(colouring.count) + 1);
  for (int c = 0; c < colouring.count; ++c) {
    REQUIRE(colouring.begin[static_cast<std::size_t>(c)] < colouring.begin[static_cast<std::size_t>(c) + 1]);
    for (int i = colouring.begin[static_cast<std::size_t>(c)]; i < colouring.begin[static_cast<std::size_t>(c) + 1];
         ++i) {
      const int v = colouring.order[static_cast<std::size_t>(i)];
      REQUIRE(colouring.colour[static_cast<std::size_t>(v)] == c);
      seen.insert(v);
    }
  }
  for (std::size_t v = 0; v < rest.mobility.size(); ++v) {
    REQUIRE((seen.count(static_cast<int>(v)) == 1) == free(static_cast<int>(v)));
    if (!free(static_cast<int>(v))) REQUIRE(colouring.colour[v] == -1);
  }
}

// Returns a mesh of 300 vertices. Each vertex adds up to two random triangles. An edge may have more than two
// triangles.
compare::Scene random_mesh(unsigned seed) {
  std::mt19937 random(seed);
  compare::Scene scene = test::empty_scene();
  std::uniform_real_distribution<double> place(0, 1);
  for (int i = 0; i < 300; ++i) scene.mesh.positions.push_back({place(random), place(random), place(random)});
  std::set<std::set<int>> used;
  for (int v = 0; v < 300; ++v) {
    for (int k = 0; k < 2; ++k) {
      const int b = static_cast<int>(random() % 300), c = (b + 1 + static_cast<int>(random() % 4)) % 300;
      if (v == b || v == c || !used.insert({v, b, c}).second) continue;
      scene.mesh.triangles.push_back({v, b, c});
    }
  }
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(300);
  compare::Body body;
  body.vertex_count = 300;
  body.triangle_count = static_cast<compare::Index>(scene.mesh.triangles.size());
  scene.bodies.push_back(body);
  return scene;
}

}  // namespace

TEST_CASE("no two free vertices of a triangle or bending stencil share a colour, on grids of any size", "[property]") {
  for (const int n : {2, 3, 5, 10, 33, 70}) {
    compare::Scene scene = test::empty_scene();
    test::add_sheet(scene, n, 1, 0, false);
    const RestState rest = rest_of(scene);
    const Colouring colouring = colour_vertices(rest);
    require_valid(rest, colouring);
    CHECK(colouring.count <= 6);  // alternating diagonals can be coloured with 6
  }
}

TEST_CASE("colours are valid on random non-manifold meshes", "[property]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const RestState rest = rest_of(random_mesh(seed));
    require_valid(rest, colour_vertices(rest));
  }
}

TEST_CASE("passes visit 20 million neighbours at most, where four passes do not visit more", "[unit]") {
  CHECK(colouring_passes(0) == 100);
  CHECK(colouring_passes(100000000) == 4);
  for (const std::size_t neighbours : {1000, 199999, 200001, 1000000, 3000000, 4999999, 5000001}) {
    const auto passes = static_cast<std::size_t>(colouring_passes(neighbours));
    CHECK((passes == 4 || passes * neighbours <= 20000000));
    CHECK((passes == 100 || (passes + 1) * (neighbours + 1) > 20000000));
  }
}

TEST_CASE("colours of random meshes have as many vertices as each other, but for one", "[property]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Colouring colouring = colour_vertices(rest_of(random_mesh(seed)));
    int least = 300, most = 0;
    for (std::size_t c = 0; c + 1 < colouring.begin.size(); ++c) {
      const int size = colouring.begin[c + 1] - colouring.begin[c];
      least = std::min(least, size), most = std::max(most, size);
    }
    INFO("seed " << seed);
    CHECK(most - least <= 1);
  }
}

TEST_CASE("no two free vertices of a spring or a stitch share a colour, its third vertex among them", "[property]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    compare::Scene scene = test::empty_scene();
    test::add_sheet(scene, 8, 1, 0, false);
    test::add_sheet(scene, 8, 1, 0.1, false);
    for (int k = 0; k < 40; ++k) {
      const auto first = static_cast<compare::Index>(random() % 64),
                 edge = static_cast<compare::Index>(64 + random() % 63);
      if (k % 4 == 0)
        scene.springs.push_back({first, edge, 1, 0, 0});
      else
        scene.springs.push_back({first, edge, 1, 0, 0, edge + 1, 0.5});
    }
    const RestState rest = rest_of(scene);
    REQUIRE(rest.springs.size() == 40);
    require_valid(rest, colour_vertices(rest));
  }
}

TEST_CASE("prescribed and fixed vertices have no colour and stand in nobody's way", "[unit]") {
  compare::Scene scene = test::empty_scene();
  test::add_sheet(scene, 4, 1, 0.1, false);
  test::add_sheet(scene, 4, 1, 0, true);
  compare::PrescribedMotion motion;
  motion.vertices = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  scene.motions.push_back(motion);
  const RestState rest = rest_of(scene);
  const Colouring colouring = colour_vertices(rest);
  require_valid(rest, colouring);
  CHECK(colouring.order.size() == 4);
  CHECK(colouring.count <= 4);
}

TEST_CASE("the colouring is the same each time", "[property]") {
  const RestState rest = rest_of(random_mesh(3));
  CHECK(colour_vertices(rest).colour == colour_vertices(rest).colour);
}

TEST_CASE("facing vertices of identical cloths share no colour, and no more colours are needed than for one",
          "[property]") {
  // Contacts are Jacobi within a colour, so partners with the same colour would both remove their whole overlap
  // (method.md §7.3).
  compare::Scene one = test::empty_scene();
  test::add_sheet(one, 12, 1, 0, false);
  const int alone = colour_vertices(rest_of(one)).count;
  for (const int sheets : {2, 3, 10}) {
    compare::Scene scene = test::empty_scene();
    for (int k = 0; k < sheets; ++k) test::add_sheet(scene, 12, 1, 0.01 * k, false);
    const RestState rest = rest_of(scene);
    const Colouring colouring = colour_vertices(rest);
    require_valid(rest, colouring);
    CHECK(colouring.count == alone);
    for (std::size_t v = 144; v < colouring.colour.size(); ++v) CHECK(colouring.colour[v] != colouring.colour[v - 144]);
  }
}
