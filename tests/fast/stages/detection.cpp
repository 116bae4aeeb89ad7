#include "fast/stages/detection.hpp"

#include <algorithm>
#include <set>

#include "fast/cpu/backend.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/probes/download.hpp"
#include "fast/stages/step_detection.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

namespace {

using namespace ogc;
using namespace ogc::fast;
using tests::TestMesh;

ContactSets find(const compare::Topology& topology, const std::vector<compare::Vec3f>& positions, float r, float r_q,
                 std::span<const compare::Index> groups = {}, int capacity = 0) {
  CpuBackend backend;
  BackendContactEngine<CpuBackend> engine(backend, topology, groups, capacity);
  return engine.find(positions, {.contact_radius = r, .query_radius = r_q});
}

ContactSets find(const TestMesh& surface, float r, float r_q) {
  const compare::Topology topology = surface.topology();
  return find(topology, surface.positions, r, r_q);
}

/// Returns three crumpled layers, closer to each other than r.
TestMesh layers(std::uint32_t seed) {
  TestMesh surface;
  for (int k = 0; k < 3; ++k)
    surface.add(tests::jittered(tests::sheet(9, 1.0F, 0.4F * static_cast<float>(k)), 0.15F,
                                seed + static_cast<std::uint32_t>(k)));
  return surface;
}

std::vector<compare::VertexFacetContact> of_vertex(const ContactSets& sets, compare::Index v) {
  std::vector<compare::VertexFacetContact> found;
  std::copy_if(sets.vertex_facet.begin(), sets.vertex_facet.end(), std::back_inserter(found),
               [v](const auto& c) { return c.vertex == v; });
  return found;
}

/// Returns a triangle with corner 0 at x. Its other corners are 50 above x.
TestMesh probe(const compare::Vec3f& x) {
  TestMesh surface;
  surface.positions = {x, {x.x + 0.5F, x.y + 50, x.z}, {x.x, x.y + 50, x.z + 0.5F}};
  surface.triangles = {{0, 1, 2}};
  return surface;
}

}  // namespace

TEST_CASE("detection: lists that start with room for one contact grow to the same sets", "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  CHECK(find(topology, surface.positions, 0.3F, 1.0F, {}, 1) ==
        find(topology, surface.positions, 0.3F, 1.0F, {}, 100000));
}

TEST_CASE("detection: one set of lists serves positions after positions, grown on the way or not, as fresh lists would",
          "[property]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  std::vector<std::vector<compare::Vec3f>> states{surface.positions, layers(15).positions,
                                                  tests::scaled(surface.positions, 0.5F), surface.positions};
  for (const int capacity : {1, 30, 100, 300, 1000, 100000}) {
    CpuBackend backend;
    BackendContactEngine<CpuBackend> engine(backend, topology, {}, capacity);
    for (const auto& positions : states) {
      CHECK(engine.find(positions, {.contact_radius = 0.3F, .query_radius = 1.0F}) ==
            find(topology, positions, 0.3F, 1.0F, {}, 100000));
    }
  }
}

TEST_CASE(
    "detection: there is room for as many contacts as the capacity says, and for one less a growth by the count of "
    "them",
    "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  const auto* x = reinterpret_cast<const Vec*>(surface.positions.data());
  const ContactSets sets = find(surface, 0.3F, 1.0F);
  const int contacts = static_cast<int>(sets.vertex_facet.size() + sets.edge_edge.size());
  for (const int missing : {0, 1, contacts / 3}) {
    CpuBackend backend;
    Detection<CpuBackend> detection(backend, topology, {}, contacts - missing);
    const float r_q = 1;
    detection.detect(x, 0.3F, &r_q, 0.45F);
    CHECK((*detection.overflow() != 0) == (missing > 0));
    CHECK(detection.grow() == (missing > 0));
    CHECK(detection.capacity() == (missing > 0 ? contacts + contacts / 2 : contacts));
  }
}

TEST_CASE("detection: lists grow wherever a contact found no slot", "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  CpuBackend backend;
  Surface<CpuBackend> mesh(topology, {});
  Lists<CpuBackend> lists(mesh.view(), 10);
  const ListsView view = lists.view();
  view.table[3] = {1, 2};
  *view.contact_count = 2, *view.without_slot = 1, *view.overflow = 1;
  CHECK(lists.grow());
  CHECK(lists.capacity() == 16);
  const ListsView grown = lists.view();
  CHECK(grown.slot_mask == 31);
  for (std::uint32_t i = 0; i <= grown.slot_mask; ++i) CHECK(grown.table[i].key == 0);
  *grown.without_slot = 20, *grown.overflow = 1;
  CHECK(lists.grow());
  CHECK(lists.capacity() == 30);
}

TEST_CASE("detection: if pairs had no room only their list grows, since the contacts of the others are not all",
          "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  CpuBackend backend;
  Surface<CpuBackend> mesh(topology, {});
  Lists<CpuBackend> lists(mesh.view(), 10);
  lists.reserve(10, 20);
  const ListsView view = lists.view();
  *view.noted_count = 21, *view.contact_count = 15, *view.overflow = 1;
  CHECK(lists.grow());
  CHECK(lists.capacity() == 10);
  CHECK(lists.noted_capacity() == 31);
}

TEST_CASE("detection: a list that is more than seven eighths full after a detection is told, and gets room", "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  CpuBackend backend;
  Surface<CpuBackend> mesh(topology, {});
  for (const auto [contacts, noted, is_short] : {std::array{70, 140, 0}, {71, 140, 1}, {70, 141, 1}, {80, 160, 1}}) {
    Lists<CpuBackend> lists(mesh.view(), 80);
    lists.reserve(80, 160);
    const ListsView view = lists.view();
    *view.contact_count = contacts, *view.noted_count = noted;
    CHECK(lists.room().is_short() == (is_short != 0));
    CHECK_FALSE(lists.grow());
    CHECK(lists.make_room() == (is_short != 0));
    CHECK(lists.capacity() == (contacts > 70 ? contacts + contacts / 2 : 80));
    CHECK(lists.noted_capacity() == (noted > 140 ? noted + noted / 2 : 160));
    CHECK_FALSE(lists.make_room());
  }
  CHECK_FALSE(ListRoom{}.is_short());
}

TEST_CASE("detection: more pairs than a list may have are an error that says so, and are counted without wrapping",
          "[unit]") {
  const TestMesh surface = layers(5);
  const compare::Topology topology = surface.topology();
  CpuBackend backend;
  Surface<CpuBackend> mesh(topology, {});
  Lists<CpuBackend> lists(mesh.view(), 10);
  const ListsView view = lists.view();
  *view.noted_count = ListRoom::most_counted;
  view.note({1, 2}, false);
  CHECK(*view.noted_count == ListRoom::most_counted);
  *view.overflow = 1;
  CHECK_THROWS_WITH(lists.grow(), ContainsSubstring("1073741824 pairs") && ContainsSubstring("contact_radius"));
}

TEST_CASE("detection: after an overflow nothing runs until the lists have grown, and one growth is enough", "[unit]") {
  const TestMesh surface = layers(6);
  const compare::Topology topology = surface.topology();
  const auto* x = reinterpret_cast<const Vec*>(surface.positions.data());
  CpuBackend backend;
  Detection<CpuBackend> detection(backend, topology, {}, 7);
  const float r_q = 1;
  detection.detect(x, 0.3F, &r_q, 0.45F);
  CHECK(*detection.overflow() != 0);
  const float bound = detection.view().bound[0];
  detection.detect(x, 0.3F, &r_q, 0.25F);
  CHECK(detection.view().bound[0] == bound);
  CHECK(detection.grow());
  CHECK_FALSE(detection.grow());
  detection.detect(x, 0.3F, &r_q, 0.45F);
  CHECK(*detection.overflow() == 0);
  CHECK(*detection.view().vertex_facet_count > 40);
}

TEST_CASE(
    "detection: the same bits in each run, rebuilt or not, and the rows of the incidences are complete and ascending",
    "[property]") {
  const TestMesh surface = layers(7);
  const compare::Topology topology = surface.topology();
  const auto* x = reinterpret_cast<const Vec*>(surface.positions.data());
  CHECK(find(surface, 0.3F, 1.0F) == find(surface, 0.3F, 1.0F));
  CpuBackend backend;
  Detection<CpuBackend> detection(backend, topology, {});
  const float r_q = 1;
  detection.detect(x, 0.3F, &r_q, 0.45F);  // trees in index order
  const ContactView view = detection.view();
  CHECK(*view.vertex_facet_count == static_cast<int>(find(surface, 0.3F, 1.0F).vertex_facet.size()));
  std::set<std::pair<int, std::uint32_t>> expected, found;
  for (int i = 0; i < *view.vertex_facet_count; ++i) {
    const VertexFacetRecord& record = view.vertex_facet[i];
    expected.insert({record.vertex, static_cast<std::uint32_t>(i) << 2});
    for (unsigned k = 0; k < 3; ++k) expected.insert({record.corner[k], static_cast<std::uint32_t>(i) << 2 | (k + 1)});
  }
  for (int i = 0; i < *view.edge_edge_count; ++i) {
    const std::uint32_t code = 0x80000000U | static_cast<std::uint32_t>(i) << 2;
    for (unsigned k = 0; k < 2; ++k)
      expected.insert({view.edge_edge[i].first[k], code | k}),
          expected.insert({view.edge_edge[i].second[k], code | (k + 2)});
  }
  expected.erase(expected.begin(), expected.lower_bound({0, 0}));
  bool ascending = true;
  for (int v = 0; v < topology.vertex_count; ++v) {
    for (const bool edge_edge : {false, true}) {
      const int row = view.rows(v, edge_edge), begin = view.incidence_offsets[row];
      for (int k = begin; k < view.incidence_offsets[row + 1]; ++k) {
        found.insert({v, view.incidences[k].code});
        ascending &= (view.incidences[k].code >> 31 != 0) == edge_edge;
        ascending &= k == begin || view.incidences[k - 1].code < view.incidences[k].code;
      }
    }
  }
  CHECK(ascending);
  CHECK(found == expected);
}

TEST_CASE("detection: a crowded vertex keeps all of its hundreds of contacts", "[unit]") {
  TestMesh surface = probe({0.3F, 0.01F, 0.3F});
  for (int k = 0; k < 400; ++k) {
    TestMesh triangle;
    const float y = -0.0005F * static_cast<float>(k);
    triangle.positions = {{0, y, 0}, {1, y, 0}, {0, y, 1}};
    triangle.triangles = {{0, 1, 2}};
    surface.add(triangle);
  }
  const auto found = of_vertex(find(surface, 0.5F, 0.5F), 0);
  REQUIRE(found.size() == 400);
  for (std::size_t k = 0; k < 400; ++k)
    CHECK(found[k].face == compare::Face{compare::FaceKind::triangle, static_cast<int>(k) + 1});
}
