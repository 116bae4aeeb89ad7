#include "compare/problem/tetrahedra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "compare/problem/expansion.hpp"

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

// A filter decides most cases. Rounding errors: differences (1), a product (1), their difference (1), the third factor
// (1 + 1), two sums (2). So the error is at most 7ε of the sum of the moduli, ε = 2⁻⁵³; 8ε covers second order.
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

}  // namespace ogc::compare
