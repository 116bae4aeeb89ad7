#include "fast/contact_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "compare/problem/error.hpp"
#include "compare/stages/bound.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

using namespace ogc;

namespace {

tests::TestMesh two_sheets() {
  tests::TestMesh mesh = tests::jittered(tests::sheet(6, 1.0F, 0), 0.1F, 1);
  mesh.add(tests::jittered(tests::sheet(6, 1.0F, 0.5F), 0.1F, 2));
  return mesh;
}

/// Returns the message of the input error that `action` throws; empty if it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const compare::InputError& error) {
    return error.what();
  }
  return {};
}

bool names(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

fast::ContactFinder finder_of(const tests::TestMesh& mesh) { return fast::ContactFinder(mesh.connectivity()); }

/// Returns sets whose lengths are multiplied by a power of two.
fast::ContactSets scaled(fast::ContactSets sets, float factor) {
  for (std::vector<float>* lengths : {&sets.d_min_vertex, &sets.d_min_edge, &sets.d_min_triangle, &sets.bound})
    for (float& length : *lengths) length *= factor;
  return sets;
}

/// Returns the sets that columns on the host hold.
fast::ContactSets sets_of(const fast::ContactColumns& columns) {
  const auto kind = [](std::uint8_t k) { return static_cast<compare::FaceKind>(k); };
  const auto numbers = [](std::span<const float> column) { return std::vector<float>(column.begin(), column.end()); };
  fast::ContactSets sets{{},
                         {},
                         numbers(columns.d_min_vertex),
                         numbers(columns.d_min_edge),
                         numbers(columns.d_min_triangle),
                         numbers(columns.bound)};
  for (std::size_t i = 0; i < columns.vertex_facet.size(); ++i) {
    const auto& [vertex, face, owner] = columns.vertex_facet[i];
    sets.vertex_facet.push_back({vertex, {kind(columns.vertex_facet_kind[i]), face}, owner});
  }
  for (std::size_t i = 0; i < columns.edge_edge.size(); ++i) {
    const auto& [p, q, first, second] = columns.edge_edge[i];
    const auto [p_kind, q_kind] = columns.edge_edge_kind[i];
    sets.edge_edge.push_back({{kind(p_kind), p}, {kind(q_kind), q}, first, second});
  }
  return sets;
}

}  // namespace

TEST_CASE(
    "contact_sets: a finder gives the sets of the contestant's stages, on the host and where it computes, also after "
    "it was moved",
    "[unit]") {
  const tests::TestMesh mesh = two_sheets();
  fast::ContactFinder first = finder_of(mesh);
  fast::ContactFinder finder = std::move(first);
  const fast::ContactQuery query{.contact_radius = 0.6F, .query_radius = 1.0F};
  const fast::ContactSets sets = finder.find(mesh.positions, query);
  const compare::DetectIn in{&finder.mesh().topology(), {}, mesh.positions, query.contact_radius, query.query_radius};
  const compare::Contestant cpu = fast::contestant(fast::Backend::cpu);
  CHECK(sets.vertex_facet.size() > 20);
  CHECK(sets.vertex_facet == cpu.detect_vertex_facet(in).contacts);
  CHECK(sets.d_min_triangle == cpu.detect_vertex_facet(in).d_min_triangle);
  CHECK(sets.edge_edge == cpu.detect_edge_edge(in).contacts);
  CHECK(sets.bound == cpu.bound({&finder.mesh().topology(), sets.d_min_vertex, sets.d_min_edge, sets.d_min_triangle,
                                 query.bounds_relaxation})
                          .bound);
  const fast::ContactView view = finder.find_resident(mesh.positions.data(), query);
  CHECK(*view.vertex_facet_count == static_cast<int>(sets.vertex_facet.size()));
  CHECK(*view.edge_edge_count == static_cast<int>(sets.edge_edge.size()));
  CHECK(view.bound[7] == sets.bound[7]);
}

TEST_CASE("contact_sets: columns hold the sets, beyond later calls and the finder", "[unit]") {
  tests::TestMesh mesh = two_sheets();
  mesh.loose_edges = {{0, 40}, {3, 50}};
  mesh.add({{{-0.4F, 0, -0.4F}, {-1.4F, 0, -0.4F}, {-0.4F, 0, -1.4F}}, {{0, 1, 2}}, {}});  // off a corner
  std::optional<fast::ContactFinder> finder = finder_of(mesh);
  const fast::ContactQuery query{.contact_radius = 0.95F, .query_radius = 1.0F};
  const fast::ContactSets sets = finder->find(mesh.positions, query);
  const fast::ContactColumns columns = finder->find_columns(mesh.positions, query),
                             there = finder->find_columns_resident(mesh.positions.data(), query);
  std::set<std::uint8_t> kinds(columns.vertex_facet_kind.begin(), columns.vertex_facet_kind.end());
  CHECK(kinds.size() == 3);
  float least = 1;
  for (const auto* distances : {&sets.d_min_vertex, &sets.d_min_edge, &sets.d_min_triangle})
    least = std::min(least, std::ranges::min(*distances));
  CHECK(columns.smallest_distance == least);
  CHECK(finder->find_columns(mesh.positions, {.contact_radius = 1e-9F, .query_radius = 1e-9F}).smallest_distance ==
        1e-9F);
  finder->find_columns(tests::scaled(mesh.positions, 0.5F), query);
  finder.reset();
  CHECK((sets_of(columns) == sets));
  CHECK((sets_of(there) == sets));
  const fast::ContactColumns same = columns.copied_to_host();
  CHECK(same.bound.data() == columns.bound.data());
}

TEST_CASE("contact_sets: a mesh without faces has empty columns", "[unit]") {
  fast::ContactFinder finder(fast::Mesh(0, {}));
  const fast::ContactColumns columns = finder.find_columns({}, {.contact_radius = 1, .query_radius = 2});
  CHECK((columns.vertex_facet.empty() && columns.edge_edge.empty() && columns.bound.empty()));
  CHECK(columns.smallest_distance == 2);
}

// Multiplication by a power of two is exact, so the sets must be the same, and each distance this multiple. In single
// precision squares and higher powers would lose bits, or overflow, beyond the limits.
TEST_CASE("contact_sets: at the limits of lengths the sets are those of a mesh of ordinary size", "[property]") {
  const tests::TestMesh mesh = two_sheets();
  fast::ContactFinder finder = finder_of(mesh);
  const fast::ContactQuery query{.contact_radius = 0.5F, .query_radius = 1.0F};
  const fast::ContactSets sets = finder.find(mesh.positions, query);
  CHECK(sets.vertex_facet.size() > 20);
  for (const float factor : {2 * fast::least_radius, fast::most_query_radius}) {
    INFO("factor " << factor);
    const fast::ContactQuery far{factor * query.contact_radius, factor * query.query_radius};
    CHECK((finder.find(tests::scaled(mesh.positions, factor), far) == scaled(sets, factor)));
  }
}

// Floats between 2²⁹ and 2³⁰ are multiples of 64, so the moved mesh has the same differences.
TEST_CASE("contact_sets: at the largest coordinates the sets are those at the origin", "[property]") {
  tests::TestMesh mesh = two_sheets();
  for (compare::Vec3f& x : mesh.positions)
    x = {std::round(32 * x.x) * 64, std::round(32 * x.y) * 64, std::round(32 * x.z) * 64};
  fast::ContactFinder finder = finder_of(mesh);
  const fast::ContactQuery query{.contact_radius = 1024, .query_radius = 2048};
  const fast::ContactSets sets = finder.find(mesh.positions, query);
  CHECK(sets.vertex_facet.size() > 20);
  std::vector<compare::Vec3f> moved = mesh.positions;
  const float shift = fast::most_coordinate - 0x1p14F;
  for (compare::Vec3f& x : moved) x = {x.x + shift, x.y - shift, x.z + shift};
  CHECK((finder.find(moved, query) == sets));
}

TEST_CASE("contact_sets: far more contacts than the first guess of the lists are all kept", "[unit]") {
  tests::TestMesh mesh;
  for (int k = 0; k < 12; ++k) mesh.add(tests::sheet(4, 1.0F, 0.01F * static_cast<float>(k)));
  fast::ContactFinder finder = finder_of(mesh);
  const fast::ContactSets sets = finder.find(mesh.positions, {.contact_radius = 0.5F, .query_radius = 0.5F});
  CHECK(sets.vertex_facet.size() == 12 * 11 * 16);  // each vertex touches its twin in each other layer
}

TEST_CASE("contact_sets: wrong input is refused with the element's name", "[unit]") {
  const tests::TestMesh mesh = two_sheets();
  const std::vector<compare::Triangle> beyond{{0, 1, 2}, {0, 1, 3}}, twice{{0, 1, 1}};
  const std::string outside = error_of([&] { fast::Mesh(3, beyond); }),
                    repeated = error_of([&] { fast::Mesh(3, twice); });
  CHECK((names(outside, "triangle 1") && names(outside, "vertex 3")));
  CHECK((names(repeated, "triangle 0") && names(repeated, "twice")));
  fast::ContactFinder finder = finder_of(mesh);
  const fast::ContactQuery good{.contact_radius = 0.1F, .query_radius = 0.2F};
  CHECK(names(error_of([&] { finder.find(std::span(mesh.positions).first(5), good); }),
              "positions: 5 vectors for 72 vertices"));
  std::vector<compare::Vec3f> broken = mesh.positions;
  broken[9].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(names(error_of([&] { finder.find(broken, good); }), "positions: vertex 9 has ("));
  const auto refusal = [&](float radius, float query_radius) {
    return error_of([&] { finder.find(mesh.positions, {radius, query_radius}); });
  };
  const float vast = std::nextafter(fast::most_query_radius, 2 * fast::most_query_radius),
              tiny = std::nextafter(fast::least_radius, 0.0F), nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(names(refusal(0.2F, 0.1F), "contact_radius is 0.2, but a length from 9.094947e-13 to 0.1 m is needed"));
  for (const float radius : {0.0F, tiny, -1.0F, nan}) CHECK(names(refusal(radius, 0.1F), "contact_radius is "));
  for (const float radius : {0.0F, tiny, vast, nan})
    CHECK(names(refusal(fast::least_radius, radius), "query_radius is "));
  CHECK(names(refusal(0.1F, vast), "but a length from 9.094947e-13 to 1048576 m is needed"));
  CHECK_NOTHROW(finder.find(mesh.positions, {.contact_radius = 0.1F, .query_radius = fast::most_query_radius}));
  CHECK_NOTHROW(finder.find(mesh.positions, {fast::least_radius, fast::least_radius}));
  std::vector<compare::Vec3f> far = mesh.positions;
  far[5].z = -fast::most_coordinate;
  CHECK_NOTHROW(finder.find(far, good));
  far[5].z = std::nextafter(far[5].z, -2 * fast::most_coordinate);
  CHECK(names(error_of([&] { finder.find_columns(far, good); }),
              "coordinates from -1073741824 to 1073741824 m are needed"));
  CHECK(names(error_of([&] { finder.find(far, good); }), "positions: vertex 5 has ("));
  CHECK_THROWS_AS(
      finder.find(mesh.positions, {.contact_radius = 0.1F, .query_radius = 0.1F, .bounds_relaxation = 0.5F}),
      compare::InputError);
  const std::vector<compare::Index> groups(3, 0);
  CHECK_THROWS_AS(fast::Mesh(72, mesh.triangles, {}, groups), compare::InputError);
}

TEST_CASE("contact_sets: without CUDA the backend says so and what to do", "[unit]") {
  const fast::BackendInfo info = fast::backend_info(fast::Backend::cuda);
  if (info.usable) return;
  CHECK_FALSE(info.description.empty());
  CHECK_THROWS_AS(fast::contestant(fast::Backend::cuda), compare::ResourceError);
  // The command line and Python spell the choice differently, so the library's messages spell neither.
  CHECK_THROWS_WITH(fast::contestant(fast::Backend::cuda),
                    ContainsSubstring("the backend cpu") && !ContainsSubstring("--backend"));
  CHECK_THROWS_AS(fast::ContactFinder(fast::Mesh(0, {}), fast::Backend::cuda), compare::ResourceError);
  CHECK(fast::backend_info(fast::Backend::cpu).usable);
}
