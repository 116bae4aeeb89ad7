// Tests detect_vertex_facet: contacts derived by hand, Algorithm 1 against the definition (Eq. 12), smallest distances,
// invariances and grey decisions.
#include "reference/geometry/detect_vertex_facet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/closest_face.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::FaceKind;
using compare::VertexFacetContact;
using reference::edge_face;
using reference::triangle_face;
using reference::vertex_face;

namespace {

compare::DetectVertexFacetTruth detect(const Surface& surface, float r, float r_q) {
  const auto topology = surface.topology();
  return reference::detect_vertex_facet(question(surface, topology, r, r_q));
}

std::vector<VertexFacetContact> contacts_of(const compare::DetectVertexFacetTruth& truth, Index vertex) {
  std::vector<VertexFacetContact> result;
  for (const auto& contact : truth.exact.contacts) {
    if (contact.vertex == vertex) result.push_back(contact);
  }
  return result;
}

/// Returns the set of Eq. 12 over all faces of triangles, with the strict test of Alg. 1 line 7.
std::vector<VertexFacetContact> by_definition(const Surface& surface, float r) {
  const auto topology = surface.topology();
  const reference::Complex mesh{topology, surface.positions};
  std::vector<VertexFacetContact> contacts;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    std::set<VertexFacetContact> found;
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      const auto number = static_cast<Index>(t);
      std::vector<Face> faces{triangle_face(number)};
      for (const Index u : topology.triangles[t]) faces.push_back(vertex_face(u));
      for (const Index e : topology.triangle_edges[t]) faces.push_back(edge_face(e));
      for (const Face face : faces) {
        const auto vertices = mesh.vertices(face);
        if (std::find(vertices.span().begin(), vertices.span().end(), v) != vertices.span().end()) continue;
        if (!reference::in_block(mesh, face, mesh.at(v), r) ||
            reference::sign(reference::face_gap(mesh, face, mesh.at(v), r)) >= 0)
          continue;
        const auto same = [&](const VertexFacetContact& c) { return c.face == face; };
        // triangles ascend, so the first one is the owner
        if (std::none_of(found.begin(), found.end(), same)) found.insert({v, face, number});
      }
    }
    contacts.insert(contacts.end(), found.begin(), found.end());
  }
  return contacts;
}

struct Distances {
  std::vector<float> of_vertex, of_triangle;
};

/// Returns the distances of Eq. 22 and 26 over all pairs.
Distances smallest_by_definition(const Surface& surface, float r_q) {
  Distances result{std::vector<float>(surface.positions.size(), r_q),
                   std::vector<float>(surface.triangles.size(), r_q)};
  compare::ClosestFaceIn in;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto& c = surface.triangles[t];
      if (std::find(c.begin(), c.end(), static_cast<Index>(v)) != c.end()) continue;
      const auto at = [&](std::size_t k) { return surface.positions[static_cast<std::size_t>(c[k])]; };
      in.point.push_back(surface.positions[v]);
      in.triangle.push_back({at(0), at(1), at(2)});
      pairs.emplace_back(v, t);
    }
  }
  const auto below = reference::closest_face(in).exact.distance_below;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto &a = result.of_vertex[pairs[i].first], &b = result.of_triangle[pairs[i].second];
    a = std::min(a, below[i]);
    b = std::min(b, below[i]);
  }
  return result;
}

/// Returns whether an answer differs from the exact one only as grey decisions allow.
bool accepted(const compare::DetectVertexFacetTruth& truth, const std::vector<VertexFacetContact>& answer) {
  const std::set<VertexFacetContact> exact(truth.exact.contacts.begin(), truth.exact.contacts.end()),
      given(answer.begin(), answer.end());
  const auto listed = [&](const VertexFacetContact& c, auto condition) {
    return std::any_of(truth.grey.begin(), truth.grey.end(), [&](const auto& decision) {
      return std::find(decision.contacts.begin(), decision.contacts.end(), c) != decision.contacts.end() &&
             condition(decision);
    });
  };
  const auto replaced = [&](const auto& decision) {
    return decision.absence_accepted || std::any_of(decision.contacts.begin(), decision.contacts.end(),
                                                    [&](const VertexFacetContact& c) { return given.contains(c); });
  };
  const bool none_missing = std::all_of(exact.begin(), exact.end(),
                                        [&](const auto& c) { return given.contains(c) || listed(c, replaced); });
  return none_missing && std::all_of(given.begin(), given.end(), [&](const auto& c) {
           return exact.contains(c) || listed(c, [](const auto&) { return true; });
         });
}

bool same(const compare::DetectVertexFacetTruth& a, const compare::DetectVertexFacetTruth& b) {
  return a.exact.contacts == b.exact.contacts;
}

}  // namespace

TEST_CASE(
    "detect_vertex_facet: a vertex straight above a vertex, an edge or an interior has one contact, whatever the "
    "valence",
    "[unit]") {
  // Vertex 12 is (2,2). Triangle 20 is (12, 13, 17) with the centre (7/3, 7/3).
  const Surface sheet = grid(5);
  const auto topology = sheet.topology();
  const Index level = compare::find_edge(topology, 11, 12), slanted = compare::find_edge(topology, 12, 16);
  const struct {
    Vec3f above;
    Face face;
    Index owner;
  } expected[] = {
      {{2, 2, 0.25f}, vertex_face(12), topology.vertex_triangles[12].front()},
      {{1.5f, 2, 0.25f}, edge_face(level), topology.edge_triangles[static_cast<std::size_t>(level)].front()},
      {{1.5f, 2.5f, 0.25f}, edge_face(slanted), topology.edge_triangles[static_cast<std::size_t>(slanted)].front()},
      {{2.25f, 2.25f, 0.25f}, triangle_face(20), 20},
  };
  for (const auto& one : expected) {
    CAPTURE(one.above.x, one.above.y);
    for (const bool turn : {false, true}) {
      const Surface surface = with_vertex(sheet, one.above);
      const auto truth = turn ? detect(mapped(surface, turned), 0.5f * turned_scale, turned_scale)
                              : detect(surface, 0.5f, 1);
      CHECK(truth.exact.contacts == std::vector<VertexFacetContact>{{25, one.face, one.owner}});
      CHECK(truth.exact.d_min_vertex[25] == (turn ? 0.25f * turned_scale : 0.25f));
    }
  }
}

TEST_CASE("detect_vertex_facet: a vertex over a valley touches both slopes, over a ridge only the ridge", "[unit]") {
  Surface ridge{{{0, 0, 0}, {0, 4, 0}, {-3, 2, -1}, {3, 2, -1}}, {{0, 1, 2}, {0, 3, 1}}, {}, {}};
  const auto topology = ridge.topology();
  const Index crest = compare::find_edge(topology, 0, 1);
  const auto above = detect(with_vertex(ridge, {0, 2, 0.5f}), 1, 2);
  CHECK(contacts_of(above, 4) == std::vector<VertexFacetContact>{{4, edge_face(crest), 0}});
  const auto below = detect(with_vertex(ridge, {0, 2, -0.5f}), 1, 2);
  CHECK(contacts_of(below, 4) == std::vector<VertexFacetContact>{{4, triangle_face(0), 0}, {4, triangle_face(1), 1}});
}

TEST_CASE("detect_vertex_facet: d = r is no contact, and d_min counts faces whose blocks do not hold the vertex",
          "[unit]") {
  const Surface sheet = grid(3, 0, 4);
  CHECK(detect(with_vertex(sheet, {1, 1, 2}), 2, 3).exact.contacts.empty());
  CHECK(detect(with_vertex(sheet, {1, 1, std::nextafter(2.0f, 0.0f)}), 2, 3).exact.contacts.size() == 1);
  // All faces are beyond r. A triangle is nearer than the saddle's vertex, whose distance is 0.5.
  const Surface saddle{{{0, 0, 0}, {2, 0, 1}, {0, 2, -1}, {-2, 0, 1}, {0, -2, -1}},
                       {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}},
                       {},
                       {}};
  const auto truth = detect(with_vertex(saddle, {0, 0, 0.5f}), 0.125f, 3);
  CHECK(truth.exact.contacts.empty());
  CHECK(truth.exact.d_min_vertex[5] < 0.5f);
  CHECK(truth.exact.d_min_vertex[5] > 0.125f);
  CHECK(detect(with_vertex(saddle, {0, 0, 9}), 1, 2).exact.d_min_vertex[5] == 2);
}

TEST_CASE("detect_vertex_facet: Algorithm 1 gives the set of Eq. 12", "[property]") {
  std::mt19937 random(8);
  for (int k = 0; k < 6; ++k) {
    const Surface surface = k % 2 == 0 ? folded(8, 0.4f, random, 0.3f) : soup(24, 20, random);
    const float r = k % 2 == 0 ? 0.8f : 0.3f;
    const auto truth = detect(surface, r, 1.5f * r);
    CHECK(truth.exact.contacts.size() > 20);
    CHECK(truth.exact.contacts == by_definition(surface, r));
  }
  const Surface exact = together(mapped(grid(6), turned), mapped(grid(6, 0.25f), turned));
  CHECK(detect(exact, 10, 20).exact.contacts == by_definition(exact, 10));
}

TEST_CASE("detect_vertex_facet: smallest distances are those over all pairs, never above the exact ones",
          "[property]") {
  std::mt19937 random(9);
  for (const float r_q : {0.35f, 1.5f}) {
    const Surface surface = folded(9, 0.4f, random, 0.3f);
    const auto truth = detect(surface, 0.3f, r_q);
    const Distances expected = smallest_by_definition(surface, r_q);
    CHECK(truth.exact.d_min_vertex == expected.of_vertex);
    CHECK(truth.exact.d_min_triangle == expected.of_triangle);
  }
}

TEST_CASE("detect_vertex_facet: scaling by powers of two gives the same set, distances scale", "[property]") {
  std::mt19937 random(10);
  const Surface surface = folded(8, 0.4f, random, 0.3f);
  const auto truth = detect(surface, 0.8f, 1.25f);
  for (const float scale : {0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f}) {
    const auto scaled = detect(mapped(surface,
                                      [&](Vec3f x) {
                                        return Vec3f{scale * x.x, scale * x.y, scale * x.z};
                                      }),
                               scale * 0.8f, scale * 1.25f);
    CHECK(same(scaled, truth));
    CHECK(scaled.pairs == truth.pairs);
    CHECK(scaled.grey.size() == truth.grey.size());
    for (std::size_t v = 0; v < surface.positions.size(); ++v)
      CHECK(scaled.exact.d_min_vertex[v] == scale * truth.exact.d_min_vertex[v]);
  }
}

TEST_CASE("detect_vertex_facet: renumbered vertices give the renumbered set", "[property]") {
  std::mt19937 random(11);
  const Surface surface = folded(7, 0.4f, random, 0.3f);
  const auto topology = surface.topology();
  std::vector<Index> name(surface.positions.size());
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), random);
  Surface renamed = surface;
  for (std::size_t v = 0; v < name.size(); ++v)
    renamed.positions[static_cast<std::size_t>(name[v])] = surface.positions[v];
  for (auto& t : renamed.triangles)
    t = {name[static_cast<std::size_t>(t[1])], name[static_cast<std::size_t>(t[2])],
         name[static_cast<std::size_t>(t[0])]};
  const auto renamed_topology = renamed.topology();
  std::vector<VertexFacetContact> expected;
  for (VertexFacetContact c : detect(surface, 0.8f, 1.25f).exact.contacts) {
    c.vertex = name[static_cast<std::size_t>(c.vertex)];
    if (c.face.kind == FaceKind::vertex) c.face.index = name[static_cast<std::size_t>(c.face.index)];
    if (c.face.kind == FaceKind::edge) {
      const auto [a, b] = topology.edges[static_cast<std::size_t>(c.face.index)];
      c.face.index = compare::find_edge(renamed_topology, name[static_cast<std::size_t>(a)],
                                        name[static_cast<std::size_t>(b)]);
    }
    expected.push_back(c);
  }
  std::sort(expected.begin(), expected.end());
  CHECK(detect(renamed, 0.8f, 1.25f).exact.contacts == expected);
}

TEST_CASE("detect_vertex_facet: pairs inside one rigid group are neither contacts nor distances", "[unit]") {
  Surface surface = with_vertex(grid(3), {1, 1, 0.25f});
  surface.groups.assign(10, 2);
  const auto rigid = detect(surface, 0.5f, 1);
  CHECK(rigid.exact.contacts.empty());
  CHECK(rigid.exact.d_min_vertex[9] == 1);
  CHECK(rigid.pairs == 0);
  surface.groups[9] = 1;
  CHECK(detect(surface, 0.5f, 1).exact.contacts.size() == 1);
  // Vertex 4, below vertex 9, is in the group, but vertex 5 is not. Triangles with vertices 4 and 5 still generate the
  // contact.
  surface.groups.assign(10, 0);
  surface.groups[5] = -1;
  CHECK(detect(surface, 0.5f, 1).exact.contacts == std::vector<VertexFacetContact>{{9, vertex_face(4), 1}});
}

TEST_CASE("detect_vertex_facet: loose edges are no faces of triangles, coinciding and collapsed ones give no NaN",
          "[unit]") {
  Surface yarn{{{0, 0, 0}, {4, 0, 0}, {2, 0, 0.5f}}, {}, {{0, 1}}, {}};
  const auto loose = detect(yarn, 1, 2);
  CHECK(loose.exact.contacts.empty());
  CHECK(loose.exact.d_min_vertex == std::vector<float>{2, 2, 2});
  Surface collapsed{{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {2, 0, 0.5f}, {2, 0, 0}}, {{0, 1, 2}}, {}, {}};
  const auto truth = detect(collapsed, 1, 2);
  CHECK(contacts_of(truth, 3).size() == 1);
  CHECK(truth.exact.d_min_vertex[3] == 0.5f);
  CHECK(truth.exact.d_min_vertex[4] == 0);
  // Corners 1 and 2 of triangle 0 coincide, so both are closest to vertex 3. The exact answer takes corner 1, which has
  // the lower index. Because of neighbour 4, the block of corner 1 does not contain vertex 3. Corner 2 would give a
  // contact.
  Surface coinciding{
      {{4, 0, 0}, {0, 0, 0}, {0, 0, 0}, {-1, 0, 1}, {-1, 0, 2}, {-1, 1, 2}}, {{0, 1, 2}, {1, 4, 5}}, {}, {}};
  const auto tie = detect(coinciding, 2, 3);
  const VertexFacetContact other{3, vertex_face(2), 0};
  std::vector<VertexFacetContact> answer = tie.exact.contacts;
  CHECK(std::find(answer.begin(), answer.end(), other) == answer.end());
  CHECK(accepted(tie, answer));
  answer.push_back(other);
  CHECK(accepted(tie, answer));
}

TEST_CASE(
    "detect_vertex_facet: a vertex one unit in the last place beside a shared edge is grey between the edge and its "
    "triangles",
    "[unit]") {
  const Surface sheet = mapped(grid(3), turned);
  const auto topology = sheet.topology();
  const Index shared = compare::find_edge(topology, 4, 6);
  const Vec3f on = turned({0.5f, 1.5f, 0.25f});
  for (const float to : {-1e9f, 1e9f}) {
    const auto truth = detect(with_vertex(sheet, {std::nextafter(on.x, to), on.y, on.z}), 10, 20);
    REQUIRE(truth.grey.size() == 1);
    CHECK_FALSE(truth.grey[0].absence_accepted);
    const auto triangles = topology.edge_triangles[static_cast<std::size_t>(shared)];
    CHECK(truth.grey[0].contacts.size() == 3);
    CHECK(accepted(truth, {{9, edge_face(shared), triangles[0]}}));
    CHECK(accepted(truth, {{9, triangle_face(triangles[1]), triangles[1]}}));
    CHECK_FALSE(accepted(truth, {}));
    CHECK_FALSE(accepted(truth, {{9, vertex_face(4), topology.vertex_triangles[4].front()}}));
  }
}

TEST_CASE("detect_vertex_facet: a distance next to r is grey, and absence is accepted", "[unit]") {
  const Surface sheet = grid(3, 0, 4);
  for (const float z : {std::nextafter(2.0f, 0.0f), 2.0f, std::nextafter(2.0f, 3.0f)}) {
    const auto truth = detect(with_vertex(sheet, {1, 1, z}), 2, 2);
    REQUIRE(truth.grey.size() == 1);
    CHECK(truth.grey[0].absence_accepted);
    CHECK(truth.grey[0].contacts == std::vector<VertexFacetContact>{{9, triangle_face(0), 0}});
  }
  CHECK(detect(with_vertex(sheet, {1, 1, 1.99f}), 2, 2).grey.empty());
}

TEST_CASE("detect_vertex_facet: moving every coordinate by a unit in the last place stays within the grey decisions",
          "[property]") {
  // Coordinates and their differences have the same size, so one unit in the last place is less than 16 · 2⁻²⁴ of every
  // difference.
  std::mt19937 random(12);
  std::uniform_int_distribution<int> step(-1, 1);
  const Surface flat = together(mapped(grid(4), turned), mapped(grid(4, 0.5f), turned));
  const auto moved = [&](Vec3f x) {
    const auto nudge = [&](float c) { return c + static_cast<float>(step(random)) * 0x1p-17f; };
    return Vec3f{nudge(x.x), nudge(x.y), nudge(x.z)};
  };
  for (const float r : {12.5f, 20.0f, 25.0f}) {
    const auto truth = detect(flat, r, 30);
    CHECK(accepted(truth, truth.exact.contacts));
    for (int k = 0; k < 20; ++k) CHECK(accepted(truth, detect(mapped(flat, moved), r, 30).exact.contacts));
  }
}

TEST_CASE("detect_vertex_facet: random states are hardly ever grey", "[property]") {
  std::mt19937 random(13);
  const auto truth = detect(folded(40, 0.4f, random, 0.3f), 0.8f, 2);
  CHECK(truth.pairs > 50000);
  CHECK(truth.grey.size() <= truth.pairs / 100000 + 1);
}
