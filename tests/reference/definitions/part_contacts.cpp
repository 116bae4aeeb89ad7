// Tests contacts with volumes of triangles in three ways:
//
// - For closed parts, a contact is inside exactly if the winding number of its point is not 0. Contacts do not use
//   winding numbers; the nearest face decides.
// - If a volume has several parts, each part has the contacts that it has alone.
// - In simple cases contacts have the values derived by hand.
#include "reference/definitions/part_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/volumes.hpp"
#include "reference/definitions/closed_surface.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using reference::FaceKind;
using reference::PartContact;

namespace {

struct Body {
  Surface surface;
  compare::Topology topology;
  explicit Body(Surface from) : surface(std::move(from)), topology(surface.topology()) {}
  reference::Complex mesh() const { return {topology, surface.positions}; }
  std::vector<PartContact> ask(const Vec3f& x, float r) const { return part_contacts(mesh(), x, r); }
};

Surface shifted(const Surface& surface, const Vec3f& by) {
  return mapped(surface, [&](Vec3f x) { return Vec3f{x.x + by.x, x.y + by.y, x.z + by.z}; });
}

/// Returns a cube with a corner moved inward: a reentrant vertex, valleys, ridges.
Surface dented_cube() {
  Surface surface = cube();
  surface.positions[7] = {0.5f, 0.75f, 0.5f};
  return surface;
}

/// Returns the cube [0, 2]³ [m] without the two triangles at z = 2.
Surface open_cube() {
  Surface surface = cube();
  std::erase_if(surface.triangles, [&](const compare::Triangle& t) {
    return std::ranges::all_of(t, [&](Index v) { return surface.positions[static_cast<std::size_t>(v)].z == 2; });
  });
  return surface;
}

/// Returns points on a grid that contains vertices, edges, triangles and medial axes, and points off the grid.
std::vector<Vec3f> points(std::mt19937& random) {
  std::vector<Vec3f> all;
  std::uniform_int_distribution<int> eighth(-4, 20);
  std::uniform_real_distribution<float> anywhere(-0.5f, 2.5f);
  for (int k = 0; k < 150; ++k) {
    const auto coordinate = [&] { return k % 2 == 0 ? static_cast<float>(eighth(random)) / 8 : anywhere(random); };
    const float x = coordinate(), y = coordinate();
    all.push_back({x, y, coordinate()});
  }
  return all;
}

compare::Vec3 closest_point(const Body& body, const PartContact& contact) {
  compare::Vec3 c;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& corners = body.surface.triangles[static_cast<std::size_t>(contact.triangle)];
    const Vec3f& x = body.surface.positions[static_cast<std::size_t>(corners[k])];
    c = {c.x + contact.weights[k] * x.x, c.y + contact.weights[k] * x.y, c.z + contact.weights[k] * x.z};
  }
  return c;
}

}  // namespace

TEST_CASE("a closed part that does not pass through itself holds the points that it winds around", "[property]") {
  std::mt19937 random(29);
  std::size_t inside = 0, outside = 0;
  for (const Surface& surface : {tetrahedron(), octahedron(), cube(), dented_cube(), mapped(dented_cube(), turned)}) {
    const Body body(surface);
    const reference::ClosedSurface closed(body.mesh());
    const bool is_turned = surface.positions[1].y != 0;
    for (Vec3f x : points(random)) {
      if (is_turned) x = turned(x);
      const bool winds = closed.locate(x).inside();
      const std::vector<PartContact> contacts = body.ask(x, 0.25f);
      INFO(x.x << " " << x.y << " " << x.z);
      if (winds) REQUIRE(contacts.size() == 1);
      for (const PartContact& contact : contacts) CHECK(contact.inside == winds);
      (winds ? inside : outside) += 1;
    }
  }
  CHECK(inside > 50);
  CHECK(outside > 50);
}

TEST_CASE("a point is held by each of several parts as if it were alone, wherever others lie", "[property]") {
  std::mt19937 random(30);
  const Surface second = shifted(dented_cube(), {0.75f, 0.5f, 0.25f});
  const Body first(cube()), other(second), both(together(cube(), second));
  const auto triangles = static_cast<Index>(first.surface.triangles.size());
  std::size_t in_both = 0;
  for (const Vec3f& x : points(random)) {
    const std::vector<PartContact> all = both.ask(x, 0.5f);
    for (const bool of_first : {true, false}) {
      std::vector<PartContact> own;
      std::ranges::copy_if(all, std::back_inserter(own),
                           [&](const PartContact& c) { return (c.triangle < triangles) == of_first; });
      const std::vector<PartContact> alone = (of_first ? first : other).ask(x, 0.5f);
      REQUIRE(own.size() == alone.size());
      for (std::size_t k = 0; k < own.size(); ++k) {
        CHECK(own[k].inside == alone[k].inside);
        CHECK(own[k].triangle - (of_first ? 0 : triangles) == alone[k].triangle);
        CHECK(own[k].face.kind == alone[k].face.kind);
        CHECK(own[k].depth == alone[k].depth);
        CHECK(own[k].weights == alone[k].weights);
        CHECK(own[k].direction == alone[k].direction);
      }
    }
    in_both += std::ranges::count_if(all, &PartContact::inside) == 2;
  }
  CHECK(in_both > 3);
}

namespace {

/// A cube with a cavity of half its size in its middle. The cavity's triangles begin at number 12; `part` joins both
/// surfaces in one part.
struct Hollow {
  Body body{together(cube(), void_inside())};
  std::vector<Index> part = compare::joined_components(body.topology, {}, std::vector<compare::Edge>{{8, 0}});
  std::vector<PartContact> ask(const Vec3f& x, float r) const { return part_contacts(body.mesh(), x, r, part); }

  static Surface void_inside() {
    Surface surface = mapped(cube(), [](Vec3f x) { return Vec3f{0.5f + x.x / 2, 0.5f + x.y / 2, 0.5f + x.z / 2}; });
    for (compare::Triangle& t : surface.triangles) std::swap(t[1], t[2]);
    return surface;
  }
};

}  // namespace

TEST_CASE("a part with a cavity holds the points that both of its shells together wind around", "[property]") {
  std::mt19937 random(33);
  const Hollow hollow;
  const reference::ClosedSurface closed(hollow.body.mesh());
  std::size_t inside = 0, in_void = 0;
  for (const Vec3f& x : points(random)) {
    const bool winds = closed.locate(x).inside();
    const std::vector<PartContact> contacts = hollow.ask(x, 0.25f);
    INFO(x.x << " " << x.y << " " << x.z);
    if (winds) REQUIRE(contacts.size() == 1);
    for (const PartContact& contact : contacts) CHECK(contact.inside == winds);
    inside += winds;
    in_void += std::max({std::abs(x.x - 1), std::abs(x.y - 1), std::abs(x.z - 1)}) < 0.5f;
  }
  CHECK(inside > 30);
  CHECK(in_void > 3);
}

TEST_CASE("the wall around a void pushes out of its nearer side, and the void's shell into the void", "[unit]") {
  const Hollow hollow;
  CHECK(hollow.ask({1, 1, 1}, 0.25f).empty());
  const auto contact = [&](float z) {
    const std::vector<PartContact> contacts = hollow.ask({0.75f, 1.125f, z}, 0.25f);
    REQUIRE(contacts.size() == 1);
    return contacts[0];
  };
  const PartContact outward = contact(1.875f), inward = contact(1.625f), beneath = contact(1.375f);
  CHECK((outward.inside && inward.inside && !beneath.inside));
  CHECK((outward.triangle < 12 && inward.triangle >= 12 && beneath.triangle >= 12));
  CHECK((outward.depth == 0.375 && inward.depth == 0.375 && beneath.depth == 0.125));
  CHECK(outward.direction == compare::Vec3{0, 0, 1});
  CHECK(inward.direction == compare::Vec3{0, 0, -1});
  CHECK(beneath.direction == compare::Vec3{0, 0, -1});
}

TEST_CASE("weights give the closest point, and the direction leads from it out of the part", "[property]") {
  std::mt19937 random(31);
  const Body body(mapped(dented_cube(), turned));
  std::size_t contacts = 0;
  const float r = turned_scale / 2;
  for (const Vec3f& point : points(random)) {
    const Vec3f x = turned(point);
    for (const PartContact& contact : body.ask(x, r)) {
      ++contacts;
      const compare::Vec3 c = closest_point(body, contact), n = contact.direction;
      CHECK(std::hypot(n.x, n.y, n.z) == Approx(1).epsilon(1e-14));
      const compare::Vec3 w{x.x - c.x, x.y - c.y, x.z - c.z};
      const double height = n.x * w.x + n.y * w.y + n.z * w.z;  // φ; the depth is r − φ
      CHECK(static_cast<double>(r) - height == Approx(contact.depth).margin(1e-12));
      CHECK(std::abs(height) == Approx(std::hypot(w.x, w.y, w.z)).margin(1e-12));
      CHECK((height < 0) == (contact.inside && std::hypot(w.x, w.y, w.z) > 0));
    }
  }
  CHECK(contacts > 50);
}

TEST_CASE("the depth is r from both sides of the surface, and every deep point is found", "[unit]") {
  const Body body(cube());
  const auto depth_at = [&](float z) {
    const std::vector<PartContact> contacts = body.ask({0.75f, 1, z}, 0.25f);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].direction == compare::Vec3{0, 0, 1});
    return contacts[0].depth;
  };
  const float above = std::nextafter(2.0f, 3.0f), below = std::nextafter(2.0f, 1.0f);
  CHECK(depth_at(2) == 0.25);
  CHECK(depth_at(above) == Approx(0.25).margin(1e-6));
  CHECK(depth_at(below) == Approx(0.25).margin(1e-6));
  CHECK(depth_at(2.125f) == 0.125);
  CHECK(depth_at(1.5f) == 0.75);
  CHECK(body.ask({0.75f, 1, 2.25f}, 0.25f).empty());
  // A small r does not limit the search inside: the middle is one metre from all faces.
  const std::vector<PartContact> middle = body.ask({1, 1, 1}, 0x1p-10f);
  REQUIRE(middle.size() == 1);
  CHECK(middle[0].depth == 1 + 0x1p-10);
}

TEST_CASE("ridges, valleys and corners: the side is that of the dihedral, not of one triangle's normal", "[unit]") {
  const Body body(cube());
  const std::vector<PartContact> ridge = body.ask({1, 2.25f, 2.125f}, 0.5f);
  REQUIRE(ridge.size() == 1);
  CHECK(!ridge[0].inside);
  CHECK(ridge[0].face.kind == FaceKind::edge);
  CHECK(ridge[0].depth == Approx(0.5 - std::hypot(0.25, 0.125)).epsilon(1e-15));
  const std::vector<PartContact> corner = body.ask({2.25f, 2.25f, 2.25f}, 0.5f);
  REQUIRE(corner.size() == 1);
  CHECK(corner[0].face.kind == FaceKind::vertex);
  CHECK(!corner[0].inside);
  // At a corner of an inverted cube, the inner side faces away from the cube. Still, a point outside a part's bounding
  // box is never inside.
  Surface inner = cube();
  for (compare::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  CHECK(Body(inner).ask({2.25f, 2.25f, 2.25f}, 0.5f).empty());
}

TEST_CASE("a rim has no inner side, and what lies behind a surface with rims is inside", "[unit]") {
  const Body body(open_cube());
  // Above the opening the rim is nearest.
  const std::vector<PartContact> over = body.ask({1, 0.25f, 2.25f}, 0.5f);
  REQUIRE(!over.empty());
  CHECK(std::ranges::none_of(over, &PartContact::inside));
  CHECK(over.front().face.kind == FaceKind::edge);
  const std::vector<PartContact> below = body.ask({1, 0.25f, 1.5f}, 0.5f);
  REQUIRE(below.size() == 1);
  CHECK(below[0].inside);
  CHECK(below[0].depth == 0.75);
  // At the rim's height, the foot of the perpendicular lies on the rim.
  const std::vector<PartContact> level = body.ask({1, 0.25f, 2}, 0.5f);
  CHECK(std::ranges::none_of(level, &PartContact::inside));
  // The triangles of this cube face inward. A point outside its box is not inside, neither beside a vertical edge nor
  // beside the upper end of this edge, at the rim.
  Surface inward = open_cube();
  for (compare::Triangle& t : inward.triangles) std::swap(t[1], t[2]);
  const std::vector<PartContact> along = Body(inward).ask({2.25f, 2.25f, 1.5f}, 0.5f),
                                 end = Body(inward).ask({2.25f, 2.25f, 2}, 0.5f);
  CHECK(along.empty());
  REQUIRE(!end.empty());
  CHECK(std::ranges::none_of(end, &PartContact::inside));
}

TEST_CASE("of equally near faces the lowest-dimensional, then the lowest-numbered one answers", "[unit]") {
  const Body body(cube());
  // The middle has twelve nearest triangles and six nearest diagonals; the feet lie on the diagonals.
  const std::vector<PartContact> middle = body.ask({1, 1, 1}, 0.5f);
  REQUIRE(middle.size() == 1);
  CHECK(middle[0].face.kind == FaceKind::edge);
  for (Index e = 0; e < middle[0].face.index; ++e) {
    const auto [a, b] = body.topology.edges[static_cast<std::size_t>(e)];
    const Vec3f &p = body.surface.positions[static_cast<std::size_t>(a)],
                &q = body.surface.positions[static_cast<std::size_t>(b)];
    CHECK(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) == 2);  // no diagonal
  }
  CHECK(middle[0].triangle == body.topology.edge_triangles[static_cast<std::size_t>(middle[0].face.index)].front());
}

TEST_CASE("a scene's parts are the components that the definition asks", "[unit]") {
  compare::Scene scene;
  const Surface surface = together(cube(), shifted(open_cube(), {1, 0, 0}));
  compare::Mesh mesh{compare::to_double(surface.positions), surface.triangles, {}};
  append_body(scene, {.name = "two", .fixed = true, .material = {}, .contact = compare::BodyContact::volume}, mesh);
  const compare::Topology topology = surface.topology();
  const std::vector<compare::VolumePart> parts = volume_parts(scene);
  REQUIRE(parts.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    for (const Index t : parts[k].triangles) {
      const auto corner = static_cast<std::size_t>(surface.triangles[static_cast<std::size_t>(t)][0]);
      CHECK(topology.component[corner] == static_cast<Index>(k));
    }
  }
}
