// Tests the paper's statements about blocks and contact sets (§3.3, §4.1) on the whole zoo. Statements that hold only
// on some meshes are also in counterexamples.cpp.
#include <algorithm>
#include <numeric>
#include <set>

#include "reference/definitions/contact_sets.hpp"
#include "reference/definitions/defined_blocks.hpp"
#include "reference/definitions/gauss_map.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::FaceKind;
using reference::Complex;
using reference::TriangleFeature;

namespace {

/// Returns the faces of one triangle in the order of TriangleFeature.
std::array<Face, 7> faces_of(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  const auto [ab, bc, ca] = mesh.topology.triangle_edges[static_cast<std::size_t>(t)];
  return {reference::vertex_face(a), reference::vertex_face(b), reference::vertex_face(c),  reference::edge_face(ab),
          reference::edge_face(bc),  reference::edge_face(ca),  reference::triangle_face(t)};
}

reference::Corners corners_of(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  return {mesh.at(a), mesh.at(b), mesh.at(c)};
}

/// Returns the face of an edge that is closest to x: an end or the interior.
Face closest_on_edge(const Complex& mesh, Index e, const Vec3f& x) {
  const auto [a, b] = mesh.edge(e);
  const auto feature = reference::closest_features({{mesh.at(a), mesh.at(b)}, {x, x}}).first;
  return feature == compare::EdgeFeature::interior
             ? reference::edge_face(e)
             : reference::vertex_face(mesh.edge(e)[static_cast<std::size_t>(feature)]);
}

bool near_edge(const Complex& mesh, Index e, const Vec3f& x, float r) {
  const auto [a, b] = mesh.edge(e);
  const reference::EdgePair pair{{mesh.at(a), mesh.at(b)}, {x, x}};
  return reference::sign(reference::with_radius(reference::feature_gap(pair, reference::closest_features(pair)), r)) <=
         0;
}

bool near_triangle(const Complex& mesh, Index t, const Vec3f& x, float r) {
  const auto corners = corners_of(mesh, t);
  return reference::sign(reference::with_radius(
             reference::feature_gap(corners, reference::closest_feature(corners, x), x), r)) <= 0;
}

/// Returns whether dis(x, M) ≤ r, over vertices, edges and triangles.
bool near_mesh(const Complex& mesh, const Vec3f& x, float r) {
  for (Index v = 0; v < mesh.topology.vertex_count; ++v) {
    if (reference::sign(reference::gap_points(mesh.at(v), x, r)) <= 0) return true;
  }
  for (std::size_t e = 0; e < mesh.topology.edges.size(); ++e) {
    if (near_edge(mesh, static_cast<Index>(e), x, r)) return true;
  }
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
    if (near_triangle(mesh, static_cast<Index>(t), x, r)) return true;
  }
  return false;
}

std::set<Face> blocks_at(const Complex& mesh, const Vec3f& x, float r) {
  std::set<Face> found;
  const auto ask = [&](FaceKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Face face{kind, static_cast<Index>(i)};
      if (reference::in_block(mesh, face, x, r)) found.insert(face);
    }
  };
  ask(FaceKind::vertex, mesh.positions.size());
  ask(FaceKind::edge, mesh.topology.edges.size());
  ask(FaceKind::triangle, mesh.topology.triangles.size());
  return found;
}

struct Findings {
  std::size_t covered = 0, uncovered = 0, shared = 0, not_closest = 0, twice_on_triangle = 0;
};

void examine_edges(const Complex& mesh, const std::set<Face>& blocks, const Vec3f& x, Findings& findings) {
  for (std::size_t i = 0; i < mesh.topology.edges.size(); ++i) {
    const auto e = static_cast<Index>(i);
    for (const Face a :
         {reference::edge_face(e), reference::vertex_face(mesh.edge(e)[0]), reference::vertex_face(mesh.edge(e)[1])}) {
      if (!blocks.contains(a)) continue;
      if (a.kind == FaceKind::vertex) findings.shared += blocks.contains(reference::edge_face(e));
      findings.not_closest += closest_on_edge(mesh, e, x) != a;
    }
  }
}

/// Checks for each triangle t: if the block of its face a holds x, a is the closest face of t. Then dis(x, a) ≤ dis(x,
/// b) for all faces b of t, with < if b ⊂ a. Also counts triangles with two faces whose blocks hold x.
void examine_triangles(const Complex& mesh, const std::set<Face>& blocks, const Vec3f& x, Findings& findings) {
  for (std::size_t i = 0; i < mesh.topology.triangles.size(); ++i) {
    const auto t = static_cast<Index>(i);
    const auto faces = faces_of(mesh, t);
    const Face closest = faces[static_cast<std::size_t>(reference::closest_feature(corners_of(mesh, t), x))];
    int here = 0;
    for (const Face a : faces) {
      if (!blocks.contains(a)) continue;
      ++here;
      findings.not_closest += closest != a;
      if (a.kind != FaceKind::triangle) findings.shared += blocks.contains(reference::triangle_face(t));
    }
    findings.twice_on_triangle += here > 1;
  }
}

Findings examine(const Specimen& specimen) {
  const auto topology = specimen.surface.topology();
  const Complex mesh{topology, specimen.surface.positions};
  Findings findings;
  for (const Vec3f& x : specimen.points) {
    const std::set<Face> blocks = blocks_at(mesh, x, specimen.radius);
    findings.covered += !blocks.empty();
    findings.uncovered += blocks.empty() == near_mesh(mesh, x, specimen.radius);
    examine_edges(mesh, blocks, x, findings);
    examine_triangles(mesh, blocks, x, findings);
  }
  return findings;
}

/// Both contact sets and the bounds of one mesh.
struct Answer {
  std::vector<compare::VertexFacetContact> facets;
  std::vector<compare::EdgeEdgeContact> edges;
  std::vector<float> bounds;
};

Answer answer(const Surface& surface, float r) {
  const auto topology = surface.topology();
  const auto in = question(surface, topology, r, 1.25f * r);
  const auto facets = reference::detect_vertex_facet(in).exact;
  const auto edges = reference::detect_edge_edge(in).exact;
  return {
      facets.contacts, edges.contacts,
      reference::bound({&topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, 0.5f}).exact.bound};
}

/// Contacts by the vertices of their faces, because renumbering changes the indices of edges and triangles.
using Named = std::set<std::vector<std::vector<Index>>>;

Named named(const Surface& surface, const Answer& given, const std::vector<Index>& name) {
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const auto vertices = [&](Face face) {
    std::vector<Index> list;
    const auto corners = mesh.vertices(face);
    for (const Index v : corners.span()) list.push_back(name[static_cast<std::size_t>(v)]);
    std::sort(list.begin(), list.end());
    return list;
  };
  Named result;
  for (const auto& c : given.facets)
    result.insert({{name[static_cast<std::size_t>(c.vertex)]}, {-1}, vertices(c.face)});
  for (const auto& c : given.edges) {
    const auto p = vertices(c.first), q = vertices(c.second);
    result.insert({std::min(p, q), std::max(p, q)});
  }
  return result;
}

std::vector<Index> shuffled(std::size_t n, std::mt19937& random) {
  std::vector<Index> names(n);
  std::iota(names.begin(), names.end(), 0);
  std::shuffle(names.begin(), names.end(), random);
  return names;
}

/// Renames vertex v to name[v] and shuffles the triangles. Each triangle begins at another corner, and every second one
/// has the opposite orientation.
Surface renumbered(const Surface& surface, const std::vector<Index>& name, std::mt19937& random) {
  Surface result = surface;
  for (std::size_t v = 0; v < name.size(); ++v)
    result.positions[static_cast<std::size_t>(name[v])] = surface.positions[v];
  const auto of = [&](Index v) { return name[static_cast<std::size_t>(v)]; };
  for (auto& t : result.triangles)
    t = random() % 2 == 0 ? compare::Triangle{of(t[1]), of(t[2]), of(t[0])}
                          : compare::Triangle{of(t[1]), of(t[0]), of(t[2])};
  for (auto& e : result.loose_edges) e = {of(e[0]), of(e[1])};
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

Vec3f scaled(Vec3f x, float factor) { return {factor * x.x, factor * x.y, factor * x.z}; }

/// Returns whether the map and its inverse are exact. If the map moves the origin, it must also move every point by the
/// same amount.
template <class Map>
bool is_exact(const Surface& surface, Map map, Map back) {
  const float shift = map({0, 0, 0}).x;
  return std::all_of(surface.positions.begin(), surface.positions.end(), [&](const Vec3f& x) {
    return back(map(x)) == x && (shift == 0 || static_cast<double>(map(x).x) - x.x == shift);
  });
}

}  // namespace

TEST_CASE(
    "theorems: covering, local exclusiveness, local closest-ness, one face of each triangle at most, on every mesh of "
    "the zoo",
    "[property]") {
  std::size_t covered = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const Findings findings = examine(specimen);
    covered += findings.covered;
    CHECK(findings.uncovered == 0);
    CHECK(findings.shared == 0);
    if (specimen.collapsed) continue;  // counterexamples.cpp tests these
    CHECK(findings.not_closest == 0);
    CHECK(findings.twice_on_triangle == 0);
  }
  CHECK(covered > 3000);
}

TEST_CASE("theorems: the block of a vertex without normals is the vertex itself, and these are the saddle vertices",
          "[property]") {
  std::size_t saddles = 0;
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    const reference::DefinedBlocks blocks(mesh);
    std::size_t elsewhere = 0;
    for (Index v = 0; v < topology.vertex_count; ++v) {
      const bool saddle = reference::classify(mesh, v) == reference::VertexKind::saddle;
      CHECK(saddle != blocks.has_normals(reference::vertex_face(v)));
      if (!saddle) continue;
      ++saddles;
      CHECK(reference::in_block(mesh, reference::vertex_face(v), mesh.at(v), specimen.radius));
      for (const Vec3f& x : specimen.points) {
        elsewhere += !(x == mesh.at(v)) && reference::in_block(mesh, reference::vertex_face(v), x, specimen.radius);
      }
    }
    CHECK(elsewhere == 0);
  }
  CHECK(saddles > 100);
}

TEST_CASE("theorems: orthogonality, the connection of a point in a block with the face is perpendicular to it",
          "[property]") {
  // The shortest line from x to the face a is perpendicular to a if it ends in the interior of a. Where it ends is
  // decided without rounding.
  for (const Specimen& specimen : mesh_zoo()) {
    if (specimen.collapsed) continue;
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const Complex mesh{topology, specimen.surface.positions};
    std::size_t slanted = 0;
    for (const Vec3f& x : specimen.points) {
      for (const Face a : blocks_at(mesh, x, specimen.radius)) {
        if (a.kind == FaceKind::edge) slanted += closest_on_edge(mesh, a.index, x) != a;
        if (a.kind == FaceKind::triangle)
          slanted += reference::closest_feature(corners_of(mesh, a.index), x) != TriangleFeature::interior;
      }
    }
    CHECK(slanted == 0);
  }
}

TEST_CASE("theorems: renumbered, reordered and turned-over meshes give the renumbered sets and bounds", "[property]") {
  std::mt19937 random(31);
  for (const Specimen& specimen : mesh_zoo()) {
    if (specimen.collapsed) continue;
    CAPTURE(specimen.name);
    const auto name = shuffled(specimen.surface.positions.size(), random);
    std::vector<Index> same(name.size());
    std::iota(same.begin(), same.end(), 0);
    const Surface other = renumbered(specimen.surface, name, random);
    const Answer before = answer(specimen.surface, specimen.radius), after = answer(other, specimen.radius);
    const bool equal = named(specimen.surface, before, name) == named(other, after, same);
    CHECK(equal);
    std::size_t different = 0;
    for (std::size_t v = 0; v < name.size(); ++v)
      different += before.bounds[v] != after.bounds[static_cast<std::size_t>(name[v])];
    CHECK(different == 0);
  }
}

TEST_CASE("theorems: mirrors, powers of two and dyadic translations that lose no digit leave the sets as they are",
          "[property]") {
  using Map = Vec3f (*)(Vec3f);
  struct Change {
    Map map, back;
    float scale;
  };
  const Change changes[] = {
      {[](Vec3f x) {
         return Vec3f{-x.x, x.y, x.z};
       },
       [](Vec3f x) {
         return Vec3f{-x.x, x.y, x.z};
       },
       1},
      {[](Vec3f x) {
         return Vec3f{x.y, x.z, x.x};
       },
       [](Vec3f x) {
         return Vec3f{x.z, x.x, x.y};
       },
       1},
      {[](Vec3f x) { return scaled(x, 0x1p10f); }, [](Vec3f x) { return scaled(x, 0x1p-10f); }, 0x1p10f},
      {[](Vec3f x) { return scaled(x, 0x1p-13f); }, [](Vec3f x) { return scaled(x, 0x1p13f); }, 0x1p-13f},
      {[](Vec3f x) {
         return Vec3f{x.x + 8, x.y - 16, x.z + 4};
       },
       [](Vec3f x) {
         return Vec3f{x.x - 8, x.y + 16, x.z - 4};
       },
       1},
  };
  std::array<std::size_t, std::size(changes)> used{};
  for (const Specimen& specimen : mesh_zoo()) {
    if (specimen.collapsed) continue;
    CAPTURE(specimen.name);
    const Answer before = answer(specimen.surface, specimen.radius);
    for (std::size_t k = 0; k < std::size(changes); ++k) {
      const auto [map, back, scale] = changes[k];
      if (!is_exact(specimen.surface, map, back) || scale * specimen.radius / scale != specimen.radius) continue;
      CAPTURE(k);
      const Answer after = answer(mapped(specimen.surface, map), scale * specimen.radius);
      const bool facets = before.facets == after.facets, edges = before.edges == after.edges;
      CHECK(facets);
      CHECK(edges);
      ++used[k];
    }
  }
  CHECK(*std::min_element(used.begin(), used.end()) > 50);
}
