#include "compare/problem/tetrahedra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "compare/problem/expansion.hpp"
#include "compare/problem/problem_kind.hpp"
#include "compare/problem/validate_mesh.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 4> opposite{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

TetrahedronFace face_of(const Tetrahedron& tetrahedron, std::size_t number, std::size_t k) {
  TetrahedronFace face{opposite_face(tetrahedron, k), static_cast<Index>(number), static_cast<Index>(k), true};
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
    Index &a = face.vertices[static_cast<std::size_t>(i)], &b = face.vertices[static_cast<std::size_t>(j)];
    if (a <= b) continue;
    std::swap(a, b);
    face.even = !face.even;
  }
  return face;
}

/// Adds sign · det(p, q, r) as six triple products.
void add_determinant(const Vec3& p, const Vec3& q, const Vec3& r, double sign, Expansion<96>& sum) {
  sum.add_product(sign * p.x, q.y, r.z);
  sum.add_product(-sign * p.x, q.z, r.y);
  sum.add_product(sign * p.y, q.z, r.x);
  sum.add_product(-sign * p.y, q.x, r.z);
  sum.add_product(sign * p.z, q.x, r.y);
  sum.add_product(-sign * p.z, q.y, r.x);
}

std::string tetrahedron_name(const MeshCheck& check, Index t) {
  return check.names.tetrahedron(t, check.mesh.tetrahedra[at(t)]);
}

/// Returns whether 6V is below 2⁻⁸⁰ m³, or V ∇N_k·∇N_l = n_k·n_l/(36 V) may be above 2⁶⁰ m. n_k is the normal of a
/// face; its length is twice the face's area.
bool is_sliver(const std::vector<Vec3>& positions, const Tetrahedron& corners) {
  const auto edge = [&](Index from, Index to) {
    const Vec3 &p = positions[at(from)], &q = positions[at(to)];
    return Vec3{q.x - p.x, q.y - p.y, q.z - p.z};
  };
  const auto outer = [](const Vec3& a, const Vec3& b) {
    return Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Triangle face = opposite_face(corners, k);
    const Vec3 normal = outer(edge(face[0], face[1]), edge(face[0], face[2]));
    largest = std::max(largest, normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
  }
  const Vec3 normal = outer(edge(corners[0], corners[2]), edge(corners[0], corners[3])),
             first = edge(corners[0], corners[1]);
  const double six_volumes = first.x * normal.x + first.y * normal.y + first.z * normal.z;
  return !(six_volumes >= 0x1p-80) || largest > 0x1p60 * 6 * six_volumes;
}

}  // namespace

Triangle opposite_face(const Tetrahedron& tetrahedron, std::size_t k) {
  return {tetrahedron[opposite[k][0]], tetrahedron[opposite[k][1]], tetrahedron[opposite[k][2]]};
}

std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra) {
  std::vector<TetrahedronFace> faces;
  faces.reserve(4 * tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) faces.push_back(face_of(tetrahedra[t], t, k));
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra) {
  const std::vector<TetrahedronFace> faces = sorted_faces(tetrahedra);
  std::vector<std::pair<Index, Index>> alone;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].vertices == faces[i].vertices) ++end;
    if (end == i + 1) alone.emplace_back(faces[i].tetrahedron, faces[i].corner);
  }
  std::sort(alone.begin(), alone.end());
  std::vector<Triangle> triangles;
  triangles.reserve(alone.size());
  for (const auto& [t, k] : alone)
    triangles.push_back(opposite_face(tetrahedra[static_cast<std::size_t>(t)], static_cast<std::size_t>(k)));
  return triangles;
}

std::vector<Index> joined_components(const Topology& topology, std::span<const Tetrahedron> tetrahedra,
                                     std::span<const Edge> cavities) {
  std::vector<Index> lowest(topology.component.size());  // by component: itself or a lower component of the same set
  std::iota(lowest.begin(), lowest.end(), 0);
  const auto root = [&](Index v) {
    Index c = topology.component[static_cast<std::size_t>(v)];
    while (lowest[static_cast<std::size_t>(c)] != c) c = lowest[static_cast<std::size_t>(c)];
    return c;
  };
  const auto join = [&](Index a, Index b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    lowest[static_cast<std::size_t>(high)] = low;
  };
  for (const Tetrahedron& t : tetrahedra)
    for (std::size_t k = 1; k < 4; ++k) join(t[0], t[k]);
  for (const auto& [inner, outer] : cavities) join(inner, outer);
  std::vector<Index> joined;
  joined.reserve(topology.component.size());
  for (Index v = 0; v < topology.vertex_count; ++v) joined.push_back(root(v));
  return joined;
}

// A filter decides most cases. Rounding errors: differences of coordinates (1), a product (1), the difference of two
// products (1), the third factor (1 + 1), two sums (2). So the error is at most 7ε of the sum of the moduli, ε = 2⁻⁵³;
// 8ε covers second order.
//
// The exact sum uses no differences of coordinates: det(b − a, c − a, d − a) is det(b, c, d) − det(a, c, d) + det(a, b,
// d) − det(a, b, c). These are 24 triple products, each stored as four doubles.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p{b.x - a.x, b.y - a.y, b.z - a.z}, q{c.x - a.x, c.y - a.y, c.z - a.z}, r{d.x - a.x, d.y - a.y, d.z - a.z};
  const double rounded = p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
  const double moduli = std::abs(p.x) * (std::abs(q.y * r.z) + std::abs(q.z * r.y)) +
                        std::abs(p.y) * (std::abs(q.z * r.x) + std::abs(q.x * r.z)) +
                        std::abs(p.z) * (std::abs(q.x * r.y) + std::abs(q.y * r.x));
  if (std::abs(rounded) > 0x8p-53 * moduli) return rounded > 0 ? 1 : -1;
  Expansion<96> sum;
  add_determinant(b, c, d, 1, sum);
  add_determinant(a, c, d, -1, sum);
  add_determinant(a, b, d, 1, sum);
  add_determinant(a, b, c, -1, sum);
  return sum.sign();
}

void TetrahedraOfMesh::check(const MeshCheck& check) {
  ProblemKind shared(check.problems, check.limit, "has a face that two other tetrahedra have",
                     "of a face there are two tetrahedra at most, one on each side: remove the others");
  ProblemKind doubled(check.problems, check.limit, "lies on the same side of a face as another tetrahedron",
                      "remove one of them, or reorder the vertices of the one that is inside out");
  const std::vector<TetrahedronFace> faces = sorted_faces(check.mesh.tetrahedra);
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].vertices == faces[i].vertices) ++end;
    const auto names = [&](std::size_t k) { return tetrahedron_name(check, faces[k].tetrahedron); };
    const std::string where = check.names.vertices(faces[i].vertices);
    if (end - i > 2) shared.add(names(end - 1), where + " of " + names(i) + " and " + names(i + 1));
    if (end - i == 2 && faces[i].even == faces[i + 1].even) doubled.add(names(i + 1), where + " of " + names(i));
  }
}

void TetrahedraOfMesh::check_rest(const MeshCheck& check, const std::vector<Vec3>& rest_positions) {
  ProblemKind flat(check.problems, check.limit, "is flat at rest", "remove the tetrahedron or move its vertices");
  ProblemKind inverted(check.problems, check.limit, "is inverted at rest",
                       "exchange two of its vertices, or untangle the mesh");
  for (std::size_t t = 0; t < check.mesh.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = check.mesh.tetrahedra[t];
    const auto usable = [&](Index v) { return is_finite(rest_positions[at(v)]); };
    if (!std::ranges::all_of(check.mesh.tetrahedra[t], usable)) continue;
    const int side = orientation(rest_positions[at(a)], rest_positions[at(b)], rest_positions[at(c)],
                                 rest_positions[at(d)]);
    if (side == 0 || (side > 0 && is_sliver(rest_positions, check.mesh.tetrahedra[t])))
      flat.add(tetrahedron_name(check, static_cast<Index>(t)));
    if (side < 0) inverted.add(tetrahedron_name(check, static_cast<Index>(t)));
  }
}

}  // namespace ogc::compare
