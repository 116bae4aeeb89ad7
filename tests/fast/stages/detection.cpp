#include "fast/stages/detection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
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

/// Returns the smallest distances over all pairs, without trees, lists or rejections.
ContactSets all_pairs(const TestMesh& surface, float r_q) {
  const compare::Topology topology = surface.topology();
  const auto* x = reinterpret_cast<const Vec*>(surface.positions.data());
  ContactSets sets;
  sets.d_min_vertex.assign(surface.positions.size(), r_q);
  sets.d_min_edge.assign(topology.edges.size(), r_q);
  sets.d_min_triangle.assign(topology.triangles.size(), r_q);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const Facet facet = facet_of(topology, t);
    const Corners corners{x[facet.corner[0]], x[facet.corner[1]], x[facet.corner[2]]};
    Box box;
    for (int k = 0; k < 3; ++k) box.include(corners[k]);
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
      if (std::count(facet.corner, facet.corner + 3, static_cast<int>(v)) > 0) continue;
      Box point;
      point.include(x[v]);
      const float d = std::max(point_triangle_distance(x[v], corners).below(), gap_below(squared_gap(point, box)));
      sets.d_min_vertex[v] = std::min(sets.d_min_vertex[v], d);
      sets.d_min_triangle[t] = std::min(sets.d_min_triangle[t], d);
    }
  }
  for (std::size_t i = 0; i < topology.edges.size(); ++i) {
    for (std::size_t k = i + 1; k < topology.edges.size(); ++k) {
      const compare::Edge &e = topology.edges[i], &f = topology.edges[k];
      if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) continue;
      Box first, second;
      first.include(x[e[0]]), first.include(x[e[1]]), second.include(x[f[0]]), second.include(x[f[1]]);
      const float d = std::max(edge_edge_distance({x[e[0]], x[e[1]]}, {x[f[0]], x[f[1]]}).below(),
                               gap_below(squared_gap(first, second)));
      sets.d_min_edge[i] = std::min(sets.d_min_edge[i], d);
      sets.d_min_edge[k] = std::min(sets.d_min_edge[k], d);
    }
  }
  return sets;
}

std::vector<compare::VertexFacetContact> of_vertex(const ContactSets& sets, compare::Index v) {
  std::vector<compare::VertexFacetContact> found;
  std::copy_if(sets.vertex_facet.begin(), sets.vertex_facet.end(), std::back_inserter(found),
               [v](const auto& c) { return c.vertex == v; });
  return found;
}

/// Returns a triangle far above the plane, except its corner 0, vertex `first`, which is at x.
TestMesh probe(const compare::Vec3f& x) {
  TestMesh surface;
  surface.positions = {x, {x.x + 0.5F, x.y + 50, x.z}, {x.x, x.y + 50, x.z + 0.5F}};
  surface.triangles = {{0, 1, 2}};
  return surface;
}

}  // namespace

TEST_CASE("detection: smallest distances through the trees are those over all pairs, bit for bit", "[property]") {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const TestMesh surface = layers(seed);
    for (const float r_q : {0.5F, 1.2F, 30.0F}) {
      const ContactSets sets = find(surface, 0.3F, r_q), exact = all_pairs(surface, r_q);
      CHECK(sets.d_min_vertex == exact.d_min_vertex);
      CHECK(sets.d_min_edge == exact.d_min_edge);
      CHECK(sets.d_min_triangle == exact.d_min_triangle);
    }
  }
}

TEST_CASE("detection: sets do not depend on the query radius beyond r, only the bounds do", "[property]") {
  const TestMesh surface = layers(4);
  const ContactSets narrow = find(surface, 0.3F, 0.3F), wide = find(surface, 0.3F, 3.0F);
  CHECK(narrow.vertex_facet.size() > 40);
  CHECK(narrow.edge_edge.size() > 100);
  CHECK(narrow.vertex_facet == wide.vertex_facet);
  CHECK(narrow.edge_edge == wide.edge_edge);
  CHECK(std::is_sorted(wide.vertex_facet.begin(), wide.vertex_facet.end()));
  CHECK(std::is_sorted(wide.edge_edge.begin(), wide.edge_edge.end()));
}

TEST_CASE("detection: a flat sheet has no contact with itself at rest, parallel strands keep theirs", "[unit]") {
  for (const float r : {1.1F, 1.5F, 2.5F}) CHECK(find(tests::sheet(9, 1.0F, 0.0F), r, 2 * r).edge_edge.empty());
  constexpr int n = 100;
  for (const float tilt : {0.0F, 1e-12F, -1e-12F, 1e-6F}) {
    TestMesh strands;
    for (int k = 0; k <= n; ++k) strands.positions.push_back({static_cast<float>(k), 0, 0});
    for (int k = 0; k <= n; ++k) {
      const auto x = static_cast<float>(k);
      strands.positions.push_back({x + 0.25F, tilt * x, 1});
    }
    for (int k = 0; k < n; ++k) {
      strands.loose_edges.push_back({k, k + 1});
      strands.loose_edges.push_back({n + 1 + k, n + 2 + k});
    }
    const auto is_interior = [](const auto& c) { return c.first.kind == compare::FaceKind::edge; };
    CHECK(std::ranges::count_if(find(strands, 1.0001F, 2.0F).edge_edge, is_interior) == 2 * n - 1);
  }
}

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
    for (int k = view.incidence_offsets[v]; k < view.incidence_offsets[v + 1]; ++k) {
      found.insert({v, view.incidences[k].code});
      ascending &= k == view.incidence_offsets[v] || view.incidences[k - 1].code < view.incidences[k].code;
    }
  }
  CHECK(ascending);
  CHECK(found == expected);
}

TEST_CASE("detection: renumbered vertices and triangles give the renumbered sets, smallest distances and bounds",
          "[property]") {
  const TestMesh surface = layers(8);
  std::vector<int> number(surface.positions.size()), place(surface.triangles.size());
  std::iota(number.begin(), number.end(), 0), std::iota(place.begin(), place.end(), 0);
  std::mt19937 random(8);
  std::shuffle(number.begin(), number.end(), random), std::shuffle(place.begin(), place.end(), random);
  TestMesh other = surface;
  for (std::size_t v = 0; v < number.size(); ++v)
    other.positions[static_cast<std::size_t>(number[v])] = surface.positions[v];
  for (std::size_t t = 0; t < place.size(); ++t) {
    const compare::Triangle& corners = surface.triangles[t];
    const auto at = [&](std::size_t k) { return number[static_cast<std::size_t>(corners[(k + t) % 3])]; };
    other.triangles[static_cast<std::size_t>(place[t])] = {at(0), at(1), at(2)};
  }
  const compare::Topology from = surface.topology(), to = other.topology();
  const ContactSets a = find(surface, 0.3F, 1.0F), b = find(other, 0.3F, 1.0F);
  const auto renamed = [&](const compare::Face& face) -> compare::Face {
    const auto i = static_cast<std::size_t>(face.index);
    if (face.kind == compare::FaceKind::vertex) return {face.kind, number[i]};
    if (face.kind == compare::FaceKind::triangle) return {face.kind, place[i]};
    return {face.kind, compare::find_edge(to, number[static_cast<std::size_t>(from.edges[i][0])],
                                          number[static_cast<std::size_t>(from.edges[i][1])])};
  };
  std::set<std::pair<int, compare::Face>> expected, found;
  for (const auto& c : a.vertex_facet) expected.insert({number[static_cast<std::size_t>(c.vertex)], renamed(c.face)});
  for (const auto& c : b.vertex_facet) found.insert({c.vertex, c.face});
  CHECK(found == expected);
  std::set<std::pair<compare::Face, compare::Face>> expected_edges, found_edges;
  for (const auto& c : a.edge_edge) expected_edges.insert(std::minmax(renamed(c.first), renamed(c.second)));
  for (const auto& c : b.edge_edge) found_edges.insert({c.first, c.second});
  CHECK(found_edges == expected_edges);
  for (std::size_t v = 0; v < number.size(); ++v) {
    CHECK(b.d_min_vertex[static_cast<std::size_t>(number[v])] == a.d_min_vertex[v]);
    CHECK(b.bound[static_cast<std::size_t>(number[v])] == a.bound[v]);
  }
  for (std::size_t t = 0; t < place.size(); ++t)
    CHECK(b.d_min_triangle[static_cast<std::size_t>(place[t])] == a.d_min_triangle[t]);
}

TEST_CASE("detection: scaling by powers of two scales distances and keeps the sets", "[property]") {
  const TestMesh surface = layers(9);
  const compare::Topology topology = surface.topology();
  const ContactSets unit = find(topology, surface.positions, 0.3F, 1.0F);
  for (const int exponent : {-20, -10, 10, 20}) {
    const float factor = std::ldexp(1.0F, exponent);
    const ContactSets sets = find(topology, tests::scaled(surface.positions, factor), 0.3F * factor, factor);
    CHECK(sets.vertex_facet == unit.vertex_facet);
    CHECK(sets.edge_edge == unit.edge_edge);
    std::vector<float> bound = unit.bound;
    for (float& b : bound) b *= factor;
    CHECK(sets.bound == bound);
  }
}

TEST_CASE("detection: a vertex exactly above a vertex, an edge or a triangle has one contact with the sheet",
          "[unit]") {
  const TestMesh flat = tests::sheet(5, 1.0F, 0);
  const auto contact = [&](const compare::Vec3f& x) {
    TestMesh surface = flat;
    surface.add(probe(x));
    const auto found = of_vertex(find(surface, 0.5F, 1.0F), 25);
    REQUIRE(found.size() == 1);
    return found[0].face;
  };
  const compare::Topology topology = flat.topology();
  CHECK(contact({2, 0.25F, 2}) == compare::Face{compare::FaceKind::vertex, 12});
  CHECK(contact({2.5F, 0.25F, 2}) == compare::Face{compare::FaceKind::edge, compare::find_edge(topology, 12, 13)});
  CHECK(contact({2.5F, 0.25F, 2.5F}) == compare::Face{compare::FaceKind::edge, compare::find_edge(topology, 12, 18)});
  CHECK(contact({2.75F, 0.25F, 2.5F}).kind == compare::FaceKind::triangle);
  CHECK(contact({-0.25F, 0, 2}) == compare::Face{compare::FaceKind::vertex, 10});  // beside the boundary, in the plane
}

TEST_CASE(
    "detection: of two identical sheets one above the other each vertex touches its twin only, and parallel edges are "
    "interior pairs",
    "[unit]") {
  TestMesh surface = tests::sheet(5, 1.0F, 0);
  surface.add(tests::sheet(5, 1.0F, 0.25F));
  const ContactSets sets = find(surface, 0.5F, 0.75F);
  REQUIRE(sets.vertex_facet.size() == 50);
  for (const auto& c : sets.vertex_facet)
    CHECK(c.face == compare::Face{compare::FaceKind::vertex, (c.vertex + 25) % 50});
  const compare::Topology topology = surface.topology();
  std::size_t twins = 0;
  for (const auto& c : sets.edge_edge) {
    if (c.first.kind == compare::FaceKind::edge && c.second.kind == compare::FaceKind::edge) {
      const compare::Edge &e = topology.edges[static_cast<std::size_t>(c.first.index)],
                          &f = topology.edges[static_cast<std::size_t>(c.second.index)];
      twins += f[0] == e[0] + 25 && f[1] == e[1] + 25;
    }
  }
  CHECK(twins == topology.edges.size() / 2);
  for (const float d : sets.d_min_vertex) CHECK((d <= 0.25F && d >= std::nextafter(0.25F, 0.0F)));
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

TEST_CASE("detection: covering, a vertex closer than r to a sheet with lattice coordinates always has a contact there",
          "[property]") {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> height(-2, 2), half(0, 20);
  int uncovered = 0, near = 0;
  for (int round = 0; round < 60; ++round) {
    TestMesh surface = tests::sheet(6, 1.0F, 0);
    for (auto& x : surface.positions) x.y = 0.5F * static_cast<float>(height(random));
    const compare::Index first = 36;
    for (int k = 0; k < 60; ++k) {
      surface.add(probe({0.25F * static_cast<float>(half(random)), 0.25F * static_cast<float>(height(random)),
                         0.25F * static_cast<float>(half(random))}));
    }
    const ContactSets sets = find(surface, 0.75F, 0.75F);
    std::set<compare::Index> covered;
    for (const auto& c : sets.vertex_facet) {
      if (c.owner < 50) covered.insert(c.vertex);
    }
    const auto* x = reinterpret_cast<const Vec*>(surface.positions.data());
    for (compare::Index v = first; v < first + 180; v += 3) {
      bool is_near = false;
      for (std::size_t t = 0; t < 50; ++t) {
        const compare::Triangle& c = surface.triangles[t];
        is_near |= point_triangle_distance(x[v], {x[c[0]], x[c[1]], x[c[2]]}).value < 0.75 - 1e-9;
      }
      near += is_near;
      uncovered += is_near && !covered.contains(v);
    }
  }
  CHECK(near > 1000);
  CHECK(uncovered == 0);
}

TEST_CASE("detection: edges of yarn meet edges, and two vertices of crossing strands are one pair", "[unit]") {
  TestMesh strands;
  strands.positions = {{0, 0, 0},     {2, 0, 0},     {4, 0, 0},      {2, 0.25F, -2},
                       {2, 0.25F, 0}, {2, 0.25F, 2}, {1, 0.25F, -1}, {1, 0.25F, 1}};
  strands.loose_edges = {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}};
  const ContactSets sets = find(strands, 0.5F, 1.0F);
  const compare::EdgeEdgeContact vertices{{compare::FaceKind::vertex, 1}, {compare::FaceKind::vertex, 4}, 0, 2};
  const compare::EdgeEdgeContact crossing{{compare::FaceKind::edge, 0}, {compare::FaceKind::edge, 4}, 0, 4};
  CHECK(sets.edge_edge == std::vector<compare::EdgeEdgeContact>{vertices, crossing});
  CHECK(sets.vertex_facet.empty());
  for (const float d : sets.d_min_edge) CHECK((d <= 0.25F && d >= std::nextafter(0.25F, 0.0F)));
}

TEST_CASE("detection: pairs inside one rigid group are left out, of contacts and of distances", "[unit]") {
  TestMesh surface = tests::sheet(4, 1.0F, 0);
  surface.add(tests::sheet(4, 1.0F, 0.25F));
  const compare::Topology topology = surface.topology();
  const std::vector<compare::Index> one(32, 0);
  const ContactSets none = find(topology, surface.positions, 0.5F, 2.0F, one);
  CHECK(none.vertex_facet.empty());
  CHECK(none.edge_edge.empty());
  CHECK(std::count(none.d_min_edge.begin(), none.d_min_edge.end(), 2.0F) ==
        static_cast<std::ptrdiff_t>(topology.edges.size()));
  std::vector<compare::Index> two(32, 0);
  std::fill(two.begin() + 16, two.end(), 1);
  CHECK(find(topology, surface.positions, 0.5F, 0.75F, two).vertex_facet ==
        find(topology, surface.positions, 0.5F, 0.75F).vertex_facet);
}

TEST_CASE("detection: pairs beside excluded ones are left out, of contacts and of distances, and of nothing else",
          "[property]") {
  TestMesh surface = tests::sheet(5, 1.0F, 0);
  surface.add(tests::jittered(tests::sheet(5, 1.0F, 0.25F), 0.1F, 3));
  const compare::Topology topology = surface.topology();
  std::vector<std::array<compare::Index, 2>> pairs;
  for (compare::Index v = 0; v < 5; ++v) pairs.push_back({v, 25 + v}), pairs.push_back({25 + v, std::max(0, v - 1)});
  const compare::Exclusions exclusions{{}, compare::partner_rows(50, pairs)};
  CpuBackend backend;
  const auto found = [&](const compare::ExclusionView& left_out) {
    BackendContactEngine<CpuBackend> engine(backend, topology, left_out);
    return engine.find(surface.positions, {.contact_radius = 0.5F, .query_radius = 1.0F});
  };
  const ContactSets all = found({}), some = found(exclusions);
  const auto beside = [&](std::span<const compare::Index> a, std::span<const compare::Index> b) {
    return std::any_of(a.begin(), a.end(), [&](compare::Index v) {
      const auto row = exclusions.partners[static_cast<std::size_t>(v)];
      return std::find_first_of(row.begin(), row.end(), b.begin(), b.end()) != row.end();
    });
  };
  int lost = 0;
  for (const auto& contact : all.edge_edge) {
    const bool kept = std::find(some.edge_edge.begin(), some.edge_edge.end(), contact) != some.edge_edge.end();
    lost += !kept;
    // A pair of faces with a vertex may be generated by several pairs of edges; two interiors have one pair only.
    if (contact.first.kind != compare::FaceKind::edge || contact.second.kind != compare::FaceKind::edge) continue;
    CHECK(kept != beside(topology.edges[static_cast<std::size_t>(contact.first_edge)],
                         topology.edges[static_cast<std::size_t>(contact.second_edge)]));
  }
  CHECK(lost > 0);
  for (const auto& contact : some.vertex_facet)
    CHECK(std::find(all.vertex_facet.begin(), all.vertex_facet.end(), contact) != all.vertex_facet.end());
  CHECK(some.vertex_facet.size() < all.vertex_facet.size());
  for (std::size_t v = 0; v < 50; ++v) CHECK(some.d_min_vertex[v] >= all.d_min_vertex[v]);
  CHECK(std::equal(some.d_min_vertex.begin() + 10, some.d_min_vertex.begin() + 25, all.d_min_vertex.begin() + 10));
}

TEST_CASE("detection: the bound is the relaxed minimum over the vertex, its edges and its triangles, rounded down",
          "[unit]") {
  const TestMesh surface = layers(12);
  const compare::Topology topology = surface.topology();
  const ContactSets sets = find(surface, 0.3F, 1.0F);
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    float d = sets.d_min_vertex[v];
    for (const compare::Index e : topology.vertex_edges[v])
      d = std::min(d, sets.d_min_edge[static_cast<std::size_t>(e)]);
    for (const compare::Index t : topology.vertex_triangles[v])
      d = std::min(d, sets.d_min_triangle[static_cast<std::size_t>(t)]);
    const double product = static_cast<double>(0.45F) * d;
    CHECK(static_cast<double>(sets.bound[v]) <= product);
    CHECK(static_cast<double>(std::nextafter(sets.bound[v], 10.0F)) > product);
  }
}
