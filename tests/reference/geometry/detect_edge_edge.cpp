// Tests detect_edge_edge: contacts derived by hand, Algorithm 2 against the definition of method.md §1.2 to §1.4,
// smallest distances, invariances and grey decisions.
#include "reference/geometry/detect_edge_edge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/closest_points.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::EdgeEdgeContact;
using compare::EdgeFeature;
using compare::Face;
using compare::FaceKind;
using reference::edge_face;
using reference::vertex_face;

namespace {

compare::DetectEdgeEdgeTruth detect(const Surface& surface, float r, float r_q) {
  const auto topology = surface.topology();
  return reference::detect_edge_edge(question(surface, topology, r, r_q));
}

/// All pairs of edges as one batch of closest_points, the lower number first.
struct Pairs {
  std::vector<std::array<Index, 2>> edges;
  compare::ClosestPointsTruth truth;
};

Pairs all_pairs(const Surface& surface, const compare::Topology& topology) {
  Pairs pairs;
  compare::ClosestPointsIn in;
  const auto at = [&](Index v) { return surface.positions[static_cast<std::size_t>(v)]; };
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    for (std::size_t f = e + 1; f < topology.edges.size(); ++f) {
      const auto [a, b] = topology.edges[e];
      const auto [c, d] = topology.edges[f];
      if (a == c || a == d || b == c || b == d) continue;
      pairs.edges.push_back({static_cast<Index>(e), static_cast<Index>(f)});
      in.first.push_back({at(a), at(b)});
      in.second.push_back({at(c), at(d)});
    }
  }
  pairs.truth = reference::closest_points(in);
  return pairs;
}

Face face_of(const compare::Topology& topology, Index e, EdgeFeature feature) {
  if (feature == EdgeFeature::interior) return edge_face(e);
  return vertex_face(topology.edges[static_cast<std::size_t>(e)][static_cast<std::size_t>(feature)]);
}

/// Checks Eq. 15 for the closest point c in double, without exact predicates.
bool in_vertex_block(const compare::Topology& topology, const Surface& surface, Index v,
                     const std::array<double, 3>& c) {
  const auto& x = surface.positions[static_cast<std::size_t>(v)];
  for (const Index u : topology.vertex_neighbours[static_cast<std::size_t>(v)]) {
    const auto& y = surface.positions[static_cast<std::size_t>(u)];
    const double dx = static_cast<double>(x.x) - y.x, dy = static_cast<double>(x.y) - y.y,
                 dz = static_cast<double>(x.z) - y.z;
    if ((c[0] - x.x) * dx + (c[1] - x.y) * dy + (c[2] - x.z) * dz < 0) return false;
  }
  return true;
}

std::array<double, 3> point_on(const compare::Topology& topology, const Surface& surface, Index e, double s) {
  const auto [i, j] = topology.edges[static_cast<std::size_t>(e)];
  const auto &a = surface.positions[static_cast<std::size_t>(i)], &b = surface.positions[static_cast<std::size_t>(j)];
  return {a.x + s * (static_cast<double>(b.x) - a.x), a.y + s * (static_cast<double>(b.y) - a.y),
          a.z + s * (static_cast<double>(b.z) - a.z)};
}

/// Returns E_OGC from closest points in double. Random states have no case too close to a boundary.
std::vector<EdgeEdgeContact> by_definition(const Surface& surface, float r) {
  const auto topology = surface.topology();
  const Pairs pairs = all_pairs(surface, topology);
  std::map<std::pair<Face, Face>, std::array<Index, 2>> found;
  for (std::size_t i = 0; i < pairs.edges.size(); ++i) {
    if (!(pairs.truth.exact.distance_below[i] < r)) continue;
    const auto [e, f] = pairs.edges[i];
    const auto [s, t] = pairs.truth.parameters[i];
    const Face p = face_of(topology, e, pairs.truth.exact.first_feature[i]),
               q = face_of(topology, f, pairs.truth.exact.second_feature[i]);
    if (p.kind == FaceKind::vertex && !in_vertex_block(topology, surface, p.index, point_on(topology, surface, f, t)))
      continue;
    if (q.kind == FaceKind::vertex && !in_vertex_block(topology, surface, q.index, point_on(topology, surface, e, s)))
      continue;
    found.try_emplace(std::minmax(p, q), std::array<Index, 2>{e, f});
  }
  std::vector<EdgeEdgeContact> contacts;
  for (const auto& [faces, edges] : found) {
    const auto [a, b] = topology.edges[static_cast<std::size_t>(edges[0])];
    const bool first_on_lower = faces.first == edge_face(edges[0]) || faces.first == vertex_face(a) ||
                                faces.first == vertex_face(b);
    contacts.push_back({faces.first, faces.second, edges[first_on_lower ? 0 : 1], edges[first_on_lower ? 1 : 0]});
  }
  return contacts;
}

/// Returns whether an answer differs from the exact one only as grey decisions allow.
bool accepted(const compare::DetectEdgeEdgeTruth& truth, const std::vector<EdgeEdgeContact>& answer) {
  std::multimap<EdgeEdgeContact, const compare::GreyDecision<EdgeEdgeContact>*> decisions;
  for (const auto& decision : truth.grey) {
    for (const auto& c : decision.contacts) decisions.emplace(c, &decision);
  }
  const std::set<EdgeEdgeContact> exact(truth.exact.contacts.begin(), truth.exact.contacts.end()),
      given(answer.begin(), answer.end());
  const auto replaced = [&](const EdgeEdgeContact& c) {
    const auto [first, last] = decisions.equal_range(c);
    return std::any_of(first, last, [&](const auto& entry) {
      const auto& list = entry.second->contacts;
      return entry.second->absence_accepted ||
             std::any_of(list.begin(), list.end(), [&](const auto& other) { return given.contains(other); });
    });
  };
  return std::all_of(exact.begin(), exact.end(), [&](const auto& c) { return given.contains(c) || replaced(c); }) &&
         std::all_of(given.begin(), given.end(),
                     [&](const auto& c) { return exact.contains(c) || decisions.contains(c); });
}

Surface two_edges(Vec3f a, Vec3f b, Vec3f c, Vec3f d) { return {{a, b, c, d}, {}, {{0, 1}, {2, 3}}, {}}; }

/// Returns whether all vertices of the face are inner vertices of a sheet of n × n vertices.
bool inner(const reference::Complex& mesh, Face face, int n) {
  const auto vertices = mesh.vertices(face);
  return std::all_of(vertices.span().begin(), vertices.span().end(), [&](Index v) {
    const int i = v % (n * n) % n, j = v % (n * n) / n;
    return i > 0 && j > 0 && i + 1 < n && j + 1 < n;
  });
}

}  // namespace

TEST_CASE("detect_edge_edge: crossing, end to interior and end to end", "[unit]") {
  const auto crossing = detect(two_edges({-2, 0, 0}, {2, 0, 0}, {0, -2, 1}, {0, 2, 1}), 2, 3);
  CHECK(crossing.exact.contacts == std::vector<EdgeEdgeContact>{{edge_face(0), edge_face(1), 0, 1}});
  CHECK(crossing.exact.d_min_edge == std::vector<float>{1, 1});
  const auto end = detect(two_edges({-2, 0, 0}, {2, 0, 0}, {3, -2, 0}, {3, 2, 0}), 2, 3);
  CHECK(end.exact.contacts == std::vector<EdgeEdgeContact>{{vertex_face(1), edge_face(1), 0, 1}});
  const auto ends = detect(two_edges({-2, 0, 0}, {2, 0, 0}, {5, 4, 1}, {3, 1, 0}), 2, 3);
  CHECK(ends.exact.contacts == std::vector<EdgeEdgeContact>{{vertex_face(1), vertex_face(3), 0, 1}});
  CHECK(detect(two_edges({-2, 0, 0}, {2, 0, 0}, {0, -2, 1}, {0, 2, 1}), 1, 3).exact.contacts.empty());
  CHECK(detect(two_edges({-2, 0, 0}, {2, 0, 0}, {0, -2, 5}, {0, 2, 5}), 1, 3).exact.d_min_edge ==
        std::vector<float>{3, 3});
}

TEST_CASE(
    "detect_edge_edge: a bend meets what passes outside it with its vertex, once, and what passes inside with both "
    "edges",
    "[unit]") {
  Surface bend{{{-2, 0, 2}, {0, 0, 0}, {2, 0, 2}, {0, -2, -0.5f}, {0, 2, -0.5f}}, {}, {{0, 1}, {1, 2}, {3, 4}}, {}};
  CHECK(detect(bend, 1, 2).exact.contacts == std::vector<EdgeEdgeContact>{{vertex_face(1), edge_face(2), 0, 2}});
  bend.positions[3].z = bend.positions[4].z = 0.5f;
  CHECK(detect(bend, 1, 2).exact.contacts ==
        std::vector<EdgeEdgeContact>{{edge_face(0), edge_face(2), 0, 2}, {edge_face(1), edge_face(2), 1, 2}});
  // Vertices 1 and 4 of two bends are in contact through four pairs of edges.
  const Surface bends{{{-2, 0, 2}, {0, 0, 0.5f}, {2, 0, 2}, {0, -2, -2}, {0, 0, -0.5f}, {0, 2, -2}},
                      {},
                      {{0, 1}, {1, 2}, {3, 4}, {4, 5}},
                      {}};
  CHECK(detect(bends, 2, 3).exact.contacts == std::vector<EdgeEdgeContact>{{vertex_face(1), vertex_face(4), 0, 2}});
}

TEST_CASE("detect_edge_edge: nearly parallel edges are one interior pair, from their true distance on", "[unit]") {
  const auto overlap = detect(two_edges({0, 0, 0}, {4, 0, 0}, {1, 0, 1}, {5, 0, 1}), 2, 3);
  CHECK(overlap.exact.contacts == std::vector<EdgeEdgeContact>{{edge_face(0), edge_face(1), 0, 1}});
  const auto one_point = detect(two_edges({0, 0, 0}, {4, 0, 0}, {4, 0, 1}, {8, 0, 1}), 2, 3);
  CHECK(one_point.exact.contacts == std::vector<EdgeEdgeContact>{{vertex_face(1), vertex_face(2), 0, 1}});
  // End 0 of the second edge is nearest (d = 1). The middle of the overlap is farther than r = 1.0001, but the pair is
  // a contact.
  const auto sloped = detect(two_edges({0, 0, 0}, {4, 0, 0}, {1, 0, 1}, {5, 0, 1.002f}), 1.0001f, 3);
  CHECK(sloped.exact.contacts == std::vector<EdgeEdgeContact>{{edge_face(0), edge_face(1), 0, 1}});
  CHECK(sloped.exact.d_min_edge[0] == 1);
}

TEST_CASE("detect_edge_edge: nearly parallel edges count where closest points lie in the blocks", "[unit]") {
  // Edge 01 of a triangle lies below edge 23 of another triangle; `below` and `above` are their third vertices.
  const auto pair_with = [](Vec3f below, Vec3f above, float tilt, float shift) {
    const Surface surface{{{0, 0, 0}, {4, 0, 0}, {1 + shift, 0, 1}, {5 + shift, 0, 1 + tilt}, below, above},
                          {{0, 1, 4}, {2, 3, 5}},
                          {},
                          {}};
    const auto topology = surface.topology();
    const Index e = compare::find_edge(topology, 0, 1), f = compare::find_edge(topology, 2, 3);
    const auto found = detect(surface, 1.25f, 3).exact.contacts;
    return std::find(found.begin(), found.end(), EdgeEdgeContact{edge_face(e), edge_face(f), e, f}) != found.end();
  };
  const Vec3f down{2, 3, -1}, up{3, 3, 2}, aside{2, 3, 0}, beside{3, 3, 1};
  for (const float shift : {0.0f, -1.0f}) {
    for (const float tilt : {0.0f, 0x1p-40f, -0x1p-40f, 0x1p-11f}) {
      CHECK(pair_with(down, up, tilt, shift));
      CHECK(pair_with(aside, beside, 0, shift));
      // at both ends, each triangle leans towards the other edge
      CHECK_FALSE(pair_with({2, 3, 1}, {3, 3, 0}, tilt, shift));
    }
  }
  // Another triangle leans over vertex 1 only: there is no contact at that end of the overlap, but there is one at
  // vertex 2.
  const auto leaning_at = [](float tilt) {
    const Surface surface{
        {{0, 0, 0}, {4, 0, 0}, {1, 0, 1}, {5, 0, 1 + tilt}, {4, 2, 1}, {5, 2, 1}, {2, 2, -1}, {2, 2, 2}},
        {{0, 1, 6}, {1, 4, 5}, {2, 3, 7}},
        {},
        {}};
    const auto topology = surface.topology();
    const Index e = compare::find_edge(topology, 0, 1), f = compare::find_edge(topology, 2, 3);
    const auto found = detect(surface, 1.25f, 3).exact.contacts;
    return std::find(found.begin(), found.end(), EdgeEdgeContact{edge_face(e), edge_face(f), e, f}) != found.end();
  };
  CHECK(leaning_at(0));
  CHECK(leaning_at(0x1p-20f));         // vertex 2 is nearest
  CHECK_FALSE(leaning_at(-0x1p-20f));  // vertex 1 is nearest
}

TEST_CASE("detect_edge_edge: a flat sheet has no contact with itself at rest, whatever the radius", "[unit]") {
  const auto count = [](const Surface& surface, float r) { return detect(surface, r, 2 * r).exact.contacts.size(); };
  for (const float r : {0.9f, 1.1f, 1.5f, 2.5f}) {
    CHECK(count(grid(7), r) == 0);
    CHECK(count(mapped(grid(7), turned), turned_scale * r) == 0);
  }
  // Each edge of one sheet lies above an edge of the other.
  const Surface sheets = together(grid(5), grid(5, 0.5f));
  for (const auto& c : detect(sheets, 1.5f, 3).exact.contacts) CHECK((c.first_edge < 56) != (c.second_edge < 56));
  CHECK(count(sheets, 1.5f) > 56);
}

TEST_CASE("detect_edge_edge: parallel strands keep their contacts at any tilt", "[unit]") {
  const Index n = 100;
  for (const float tilt : {0.0f, 1e-12f, -1e-12f, 1e-9f, 1e-6f}) {
    Surface strands;
    for (Index k = 0; k <= n; ++k) strands.positions.push_back({static_cast<float>(k), 0, 0});
    for (Index k = 0; k <= n; ++k) {
      const auto x = static_cast<float>(k);
      strands.positions.push_back({x + 0.25f, tilt * x, 1});
    }
    for (Index k = 0; k < n; ++k) strands.loose_edges.push_back({k, k + 1});
    for (Index k = 0; k < n; ++k) strands.loose_edges.push_back({n + 1 + k, n + 2 + k});
    std::size_t interiors = 0;
    for (const auto& c : detect(strands, 1.0001f, 2).exact.contacts) interiors += c.first.kind == FaceKind::edge;
    CHECK(interiors == 2 * static_cast<std::size_t>(n) - 1);
  }
}

TEST_CASE("detect_edge_edge: two parallel flat sheets have interior pairs only, along the normal", "[unit]") {
  // The second sheet is rotated by the angle of a 3-4-5 triangle and shifted, so no edges of both sheets are parallel.
  const int n = 7;
  const Surface upper = mapped(grid(n), [](Vec3f x) {
    return Vec3f{0.6f * x.x - 0.8f * x.y + 3.37f, 0.8f * x.x + 0.6f * x.y - 1.21f, 0.5f};
  });
  const Surface sheets = together(grid(n), upper);
  const auto topology = sheets.topology();
  const reference::Complex mesh{topology, sheets.positions};
  const Pairs pairs = all_pairs(sheets, topology);
  std::size_t between = 0;
  for (const auto& c : detect(sheets, 0.7f, 1).exact.contacts) {
    if (!inner(mesh, c.first, n) || !inner(mesh, c.second, n)) continue;
    CHECK(c.first.kind == FaceKind::edge);
    CHECK(c.second.kind == FaceKind::edge);
    const auto it = std::find(pairs.edges.begin(), pairs.edges.end(),
                              std::array<Index, 2>{c.first.index, c.second.index});
    REQUIRE(it != pairs.edges.end());
    const auto [s, t] = pairs.truth.parameters[static_cast<std::size_t>(it - pairs.edges.begin())];
    const auto a = point_on(topology, sheets, c.first.index, s), b = point_on(topology, sheets, c.second.index, t);
    CHECK(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) <= 1e-14);
    ++between;
  }
  CHECK(between > 20);
}

TEST_CASE("detect_edge_edge: Algorithm 2 gives the set of the definition, with the lowest generating edges",
          "[property]") {
  std::mt19937 random(14);
  for (int k = 0; k < 4; ++k) {
    Surface surface = k % 2 == 0 ? folded(6, 0.4f, random, 0.3f) : soup(18, 12, random);
    const auto free = static_cast<Index>(surface.positions.size());
    surface = together(surface, soup(2, 0, random));
    surface.loose_edges = {{free, free + 1}, {0, free}};
    const float r = k % 2 == 0 ? 0.7f : 0.3f;
    const auto truth = detect(surface, r, 1.5f * r);
    CHECK(truth.exact.contacts.size() > 50);
    CHECK(truth.exact.contacts == by_definition(surface, r));
  }
}

TEST_CASE("detect_edge_edge: smallest distances are those over all pairs, never above the exact ones", "[property]") {
  std::mt19937 random(15);
  const Surface surface = folded(7, 0.4f, random, 0.3f);
  const auto topology = surface.topology();
  const Pairs pairs = all_pairs(surface, topology);
  for (const float r_q : {0.35f, 1.5f}) {
    std::vector<float> expected(topology.edges.size(), r_q);
    for (std::size_t i = 0; i < pairs.edges.size(); ++i) {
      for (const Index e : pairs.edges[i]) {
        float& d = expected[static_cast<std::size_t>(e)];
        d = std::min(d, pairs.truth.exact.distance_below[i]);
      }
    }
    CHECK(detect(surface, 0.3f, r_q).exact.d_min_edge == expected);
  }
}

TEST_CASE("detect_edge_edge: scaling by powers of two gives the same set, distances scale", "[property]") {
  std::mt19937 random(16);
  const Surface surface = folded(6, 0.4f, random, 0.3f);
  const auto truth = detect(surface, 0.7f, 1.25f);
  for (const float scale : {0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f}) {
    const auto scaled = detect(mapped(surface,
                                      [&](Vec3f x) {
                                        return Vec3f{scale * x.x, scale * x.y, scale * x.z};
                                      }),
                               scale * 0.7f, scale * 1.25f);
    CHECK(scaled.exact.contacts == truth.exact.contacts);
    CHECK(scaled.pairs == truth.pairs);
    for (std::size_t e = 0; e < truth.exact.d_min_edge.size(); ++e)
      CHECK(scaled.exact.d_min_edge[e] == scale * truth.exact.d_min_edge[e]);
  }
}

TEST_CASE(
    "detect_edge_edge: the set is symmetric: renumbered vertices, and with them the roles of the edges, give the "
    "renamed pairs",
    "[property]") {
  std::mt19937 random(17);
  const Surface surface = folded(6, 0.4f, random, 0.3f);
  const auto topology = surface.topology();
  std::vector<Index> name(surface.positions.size());
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), random);
  Surface renamed = surface;
  const auto renumbered = [&](Index v) { return name[static_cast<std::size_t>(v)]; };
  for (std::size_t v = 0; v < name.size(); ++v)
    renamed.positions[static_cast<std::size_t>(name[v])] = surface.positions[v];
  for (auto& t : renamed.triangles) t = {renumbered(t[1]), renumbered(t[2]), renumbered(t[0])};
  const auto renamed_topology = renamed.topology();
  const auto renamed_face = [&](Face face) {
    if (face.kind == FaceKind::vertex) return vertex_face(renumbered(face.index));
    const auto [a, b] = topology.edges[static_cast<std::size_t>(face.index)];
    return edge_face(compare::find_edge(renamed_topology, renumbered(a), renumbered(b)));
  };
  std::set<std::pair<Face, Face>> expected, found;
  for (const auto& c : detect(surface, 0.7f, 1.25f).exact.contacts)
    expected.insert(std::minmax(renamed_face(c.first), renamed_face(c.second)));
  for (const auto& c : detect(renamed, 0.7f, 1.25f).exact.contacts) found.insert({c.first, c.second});
  CHECK(found == expected);
}

TEST_CASE("detect_edge_edge: pairs inside one rigid group are neither contacts nor distances", "[unit]") {
  Surface surface = two_edges({-2, 0, 0}, {2, 0, 0}, {0, -2, 1}, {0, 2, 1});
  surface.groups = {1, 1, 1, 1};
  const auto rigid = detect(surface, 2, 3);
  CHECK(rigid.exact.contacts.empty());
  CHECK(rigid.exact.d_min_edge == std::vector<float>{3, 3});
  surface.groups = {1, 1, 1, 2};
  CHECK(detect(surface, 2, 3).exact.contacts.size() == 1);
  surface.groups = {-1, -1, -1, -1};
  CHECK(detect(surface, 2, 3).exact.contacts.size() == 1);
}

TEST_CASE("detect_edge_edge: boundaries of every kind are grey on both sides", "[unit]") {
  const auto one_up = [](float x) { return std::nextafter(x, 1e9f); };
  // The second edge lies in the plane x + y = 8 through the end of an oblique edge (vertex 1), up to one unit in the
  // last place; 8 − 5.1 and 8 − 5.7 are exact.
  for (const float x : {5.1f, one_up(5.1f)}) {
    const auto truth = detect(two_edges({0, 0, 0}, {4, 4, 0}, {x, 8 - 5.1f, 2}, {8 - 5.7f, 5.7f, 2}), 3, 4);
    REQUIRE(truth.grey.size() == 1);
    CHECK_FALSE(truth.grey[0].absence_accepted);
    CHECK(truth.grey[0].contacts ==
          std::vector<EdgeEdgeContact>{{vertex_face(1), edge_face(1), 0, 1}, {edge_face(0), edge_face(1), 0, 1}});
  }
  // If the distance is nearly r, below or above, a missing contact is accepted.
  for (const float z : {std::nextafter(1.0f, 0.0f), 1.0f, one_up(1.0f)}) {
    const auto truth = detect(two_edges({-2, 0, 0}, {2, 0, 0}, {0, -2, z}, {0, 2, z}), 1, 1);
    REQUIRE(truth.grey.size() == 1);
    CHECK(truth.grey[0].absence_accepted);
  }
  // At the limit of the rule for nearly parallel edges, the other accepted answer is a contact of an end with an
  // interior.
  const auto limit = detect(two_edges({0, 0, 0}, {4, 0, 0}, {1, 0, 1}, {5, 0, 1.004f}), 2, 3);
  REQUIRE(limit.grey.size() == 1);
  CHECK(limit.grey[0].contacts ==
        std::vector<EdgeEdgeContact>{{vertex_face(2), edge_face(0), 1, 0}, {edge_face(0), edge_face(1), 0, 1}});
}

TEST_CASE("detect_edge_edge: moving every coordinate by a unit in the last place stays within the grey decisions",
          "[property]") {
  // Coordinates and their differences have the same size, so one unit in the last place is less than 16 · 2⁻²⁴ of every
  // difference.
  std::mt19937 random(18);
  std::uniform_int_distribution<int> step(-1, 1);
  const Surface flat = together(mapped(grid(4), turned), mapped(grid(4, 0.5f), turned));
  const auto moved = [&](Vec3f x) {
    const auto nudge = [&](float c) { return c + static_cast<float>(step(random)) * 0x1p-17f; };
    return Vec3f{nudge(x.x), nudge(x.y), nudge(x.z)};
  };
  for (const float r : {12.5f, 15.0f, 20.0f, 30.0f}) {
    const auto truth = detect(flat, r, 30);
    CHECK(accepted(truth, truth.exact.contacts));
    for (int k = 0; k < 10; ++k) CHECK(accepted(truth, detect(mapped(flat, moved), r, 30).exact.contacts));
  }
  // Edges 01 and 23 are exactly parallel. The 81 cases differ in the blocks: each end of the overlap lies inside,
  // outside or on the boundary of the blocks of each edge.
  for (int way = 0; way < 81; ++way) {
    const auto lean = [way](int place) { return static_cast<float>(way / place % 3 - 1); };
    const Surface surface{{{0, 0, 0},
                           {4, 0, 0},
                           {1, 0, 1},
                           {5, 0, 1},
                           {4, 2, lean(1)},
                           {5, 2, lean(3)},
                           {1, 2, 1 + lean(9)},
                           {0, 2, 1 + lean(27)},
                           {2, 2, -1},
                           {2, 2, 2}},
                          {{0, 1, 8}, {1, 4, 5}, {2, 3, 9}, {2, 6, 7}},
                          {},
                          {}};
    const Surface oblique = mapped(surface, turned);
    const auto truth = detect(oblique, 1.25f * turned_scale, 60);
    CHECK(accepted(truth, truth.exact.contacts));
    for (int k = 0; k < 10; ++k)
      CHECK(accepted(truth, detect(mapped(oblique, moved), 1.25f * turned_scale, 60).exact.contacts));
  }
}

TEST_CASE("detect_edge_edge: random states are hardly ever grey, aligned axis-parallel sheets not at all",
          "[property]") {
  std::mt19937 random(19);
  const auto truth = detect(folded(30, 0.4f, random, 0.3f), 0.7f, 1.5f);
  CHECK(truth.pairs > 50000);
  CHECK(truth.grey.size() <= truth.pairs / 100000 + 1);
  const auto aligned = detect(together(grid(8), grid(8, 0.5f)), 0.6f, 1);
  CHECK(aligned.exact.contacts.size() > 200);
  CHECK(aligned.grey.empty());
}
