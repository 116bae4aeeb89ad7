#include "fast/contact_sets.hpp"

#include <cmath>
#include <limits>
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
  CHECK_THROWS_AS(finder.find(mesh.positions, {.contact_radius = 0.2F, .query_radius = 0.1F}), compare::InputError);
  CHECK_THROWS_AS(finder.find(mesh.positions, {.contact_radius = 0, .query_radius = 0.1F}), compare::InputError);
  // searches would read beyond the tree if r_q² overflowed
  const float vast = std::nextafter(fast::most_query_radius, std::numeric_limits<float>::infinity());
  CHECK_THROWS_AS(finder.find(mesh.positions, {.contact_radius = 0.1F, .query_radius = vast}), compare::InputError);
  CHECK_NOTHROW(finder.find(mesh.positions, {.contact_radius = 0.1F, .query_radius = fast::most_query_radius}));
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
  CHECK_THROWS_AS(fast::ContactFinder(fast::Mesh(0, {}), fast::Backend::cuda), compare::ResourceError);
  CHECK(fast::backend_info(fast::Backend::cpu).usable);
}
