// Each kind of problem is one loop over one array. Lengths and areas are computed from usable coordinates only, faces
// are looked at with valid indices only.
#include "compare/problem/validate_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "compare/problem/problem_kind.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/zero_area.hpp"

namespace ogc::compare {
namespace {

Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

bool usable_coordinate(double x) { return std::abs(x) <= most_length; }

bool check_coordinates(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind) {
  ProblemKind not_finite(check.problems, check.limit, kind + "position is not finite",
                         "give three finite coordinates [m]");
  ProblemKind out_of_range(check.problems, check.limit, kind + "coordinate is beyond 2²⁰ m",
                           "scale or move the mesh; coordinates are in metres");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto& [x, y, z] = positions[v];
    if (!is_finite(positions[v])) {
      not_finite.add(check.names.vertex(static_cast<Index>(v)), printed(positions[v]));
    } else if (!usable_coordinate(x) || !usable_coordinate(y) || !usable_coordinate(z)) {
      out_of_range.add(check.names.vertex(static_cast<Index>(v)), printed(positions[v]));
    }
  }
  return not_finite.count() == 0 && out_of_range.count() == 0;
}

std::string triangle_name(const MeshCheck& check, std::size_t t) {
  return check.names.triangle(static_cast<Index>(t), check.mesh.triangles[t]);
}

std::string tetrahedron_name(const MeshCheck& check, std::size_t t) {
  return check.names.tetrahedron(static_cast<Index>(t), check.mesh.tetrahedra[t]);
}

std::string loose_edge_name(const MeshCheck& check, std::size_t e) {
  return check.names.loose_edge(static_cast<Index>(e), check.mesh.loose_edges[e]);
}

// Visits each edge once for each triangle that has it; a bad edge is named with the first. Zero is decided exactly; at
// the ends of the range one rounding of the length does not matter.
void check_edges(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind) {
  ProblemKind zero(check.problems, check.limit, kind + "edge of zero length",
                   "merge the two vertices or move them apart");
  ProblemKind out_of_range(check.problems, check.limit, kind + "edge length is not within 2⁻²⁰ … 2²⁰ m",
                           "merge the vertices or scale the mesh; coordinates are in metres");
  std::set<Edge> named;
  const auto check_edge = [&](Index a, Index b, const auto& face_name) {
    const Vec3 &p = positions[at(a)], &q = positions[at(b)];
    const bool is_zero = p == q;
    const double length = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    if ((!is_zero && length >= least_length && length <= most_length) || !named.insert(ordered(a, b)).second) return;
    const std::string ends = check.names.vertices(std::array{a, b});
    is_zero ? zero.add(face_name(), ends)
            : out_of_range.add(face_name(), (ends.empty() ? "" : ends + ": ") + shortest(length) + " m");
  };
  for (std::size_t t = 0; t < check.mesh.triangles.size(); ++t) {
    const Triangle& corners = check.mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k)
      check_edge(corners[k], corners[(k + 1) % 3], [&] { return triangle_name(check, t); });
  }
  for (std::size_t e = 0; e < check.mesh.loose_edges.size(); ++e) {
    const auto& [a, b] = check.mesh.loose_edges[e];
    check_edge(a, b, [&] { return loose_edge_name(check, e); });
  }
  for (std::size_t t = 0; t < check.mesh.tetrahedra.size(); ++t) {
    const Tetrahedron& corners = check.mesh.tetrahedra[t];
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = k + 1; l < 4; ++l)
        check_edge(corners[k], corners[l], [&] { return tetrahedron_name(check, t); });
    }
  }
}

void check_areas(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind) {
  ProblemKind zero(check.problems, check.limit, kind + "triangle of zero area",
                   "remove the triangle or move its vertices");
  for (std::size_t t = 0; t < check.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = check.mesh.triangles[t];
    if (has_zero_area(positions[at(a)], positions[at(b)], positions[at(c)])) zero.add(triangle_name(check, t));
  }
}

// Lists elements with equal vertices, which stand next to each other after sorting.
template <std::size_t corners, class Name>
void check_repeated(const MeshCheck& check, const std::string& kind,
                    const std::vector<std::array<Index, corners>>& faces, const Name& name) {
  ProblemKind repeated(check.problems, check.limit, "has the same vertices as another " + kind, "keep one of them");
  std::vector<std::pair<std::array<Index, corners>, std::size_t>> sorted;
  sorted.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    sorted.emplace_back(faces[i], i);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first)
      repeated.add(name(check, sorted[i].second), name(check, sorted[i - 1].second));
  }
}

void check_loose_edges(const MeshCheck& check) {
  if (check.mesh.loose_edges.empty()) return;
  ProblemKind in_triangle(check.problems, check.limit, "is an edge of a triangle too", "remove the loose edge");
  std::set<Edge> of_triangles;
  for (const auto& [a, b, c] : check.mesh.triangles) of_triangles.insert({ordered(a, b), ordered(b, c), ordered(c, a)});
  for (std::size_t e = 0; e < check.mesh.loose_edges.size(); ++e) {
    const auto& [a, b] = check.mesh.loose_edges[e];
    if (of_triangles.contains(ordered(a, b))) in_triangle.add(loose_edge_name(check, e));
  }
}

void check_isolated_vertices(const MeshCheck& check) {
  ProblemKind isolated(check.problems, check.limit, "belongs to no triangle, no edge and no tetrahedron",
                       "remove the vertex");
  std::vector<bool> used(check.mesh.positions.size());
  for (const Triangle& t : check.mesh.triangles) {
    for (const Index v : t) used[at(v)] = true;
  }
  for (const Edge& e : check.mesh.loose_edges) {
    for (const Index v : e) used[at(v)] = true;
  }
  for (const Tetrahedron& t : check.mesh.tetrahedra) {
    for (const Index v : t) used[at(v)] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) isolated.add(check.names.vertex(static_cast<Index>(v)));
  }
}

/// Returns whether 6V is below 2⁻⁸⁰ m³, or V ∇N_k·∇N_l = n_k·n_l/(36 V) may be above 2⁶⁰ m; n_k is the normal of twice
/// a face's area.
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

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string printed(const Vec3& v) { return "(" + shortest(v.x) + ", " + shortest(v.y) + ", " + shortest(v.z) + ")"; }

void check_tetrahedra(const MeshCheck& check) {
  check_repeated(check, "tetrahedron", check.mesh.tetrahedra, tetrahedron_name);
  ProblemKind shared(check.problems, check.limit, "has a face that two other tetrahedra have",
                     "of a face there are two tetrahedra at most, one on each side: remove the others");
  ProblemKind doubled(check.problems, check.limit, "lies on the same side of a face as another tetrahedron",
                      "remove one of them, or reorder the vertices of the one that is inside out");
  const std::vector<TetrahedronFace> faces = sorted_faces(check.mesh.tetrahedra);
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].vertices == faces[i].vertices) ++end;
    const auto names = [&](std::size_t k) { return tetrahedron_name(check, at(faces[k].tetrahedron)); };
    const std::string where = check.names.vertices(faces[i].vertices);
    if (end - i > 2) shared.add(names(end - 1), where + " of " + names(i) + " and " + names(i + 1));
    if (end - i == 2 && faces[i].even == faces[i + 1].even) doubled.add(names(i + 1), where + " of " + names(i));
  }
}

void check_volumes(const MeshCheck& check, const std::vector<Vec3>& rest_positions) {
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
      flat.add(tetrahedron_name(check, t));
    if (side < 0) inverted.add(tetrahedron_name(check, t));
  }
}

bool check_indices(const MeshCheck& check) {
  const std::size_t count = check.mesh.positions.size();
  ProblemKind range(check.problems, check.limit, "names a vertex that does not exist",
                    "vertices are numbered from 0 to " + std::to_string(count - 1));
  ProblemKind repeated(check.problems, check.limit, "has the same vertex twice", "remove it");
  const auto check_face = [&](std::span<const Index> corners, const auto& face_name) {
    for (const Index v : corners) {
      if (v < 0 || at(v) >= count) return range.add(face_name(), std::to_string(v));
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto rest = corners.subspan(k + 1);
      if (std::find(rest.begin(), rest.end(), corners[k]) != rest.end())
        return repeated.add(face_name(), check.names.vertex(corners[k]));
    }
  };
  for (std::size_t t = 0; t < check.mesh.triangles.size(); ++t)
    check_face(check.mesh.triangles[t], [&] { return triangle_name(check, t); });
  for (std::size_t e = 0; e < check.mesh.loose_edges.size(); ++e)
    check_face(check.mesh.loose_edges[e], [&] { return loose_edge_name(check, e); });
  for (std::size_t t = 0; t < check.mesh.tetrahedra.size(); ++t)
    check_face(check.mesh.tetrahedra[t], [&] { return tetrahedron_name(check, t); });
  return range.count() == 0 && repeated.count() == 0;
}

void check_positions(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind) {
  if (!check_coordinates(check, positions, kind)) return;
  check_edges(check, positions, kind);
  check_areas(check, positions, kind);
}

std::vector<Problem> validate(const Mesh& mesh, std::size_t limit, const ElementNames& names) {
  if (mesh.positions.empty()) return {{"mesh", "has no vertices", "give at least one triangle, edge or tetrahedron"}};
  std::vector<Problem> problems;
  const MeshCheck check{mesh, names, limit, problems};
  if (check_indices(check)) {
    check_repeated(check, "triangle", mesh.triangles, triangle_name);
    check_repeated(check, "loose edge", mesh.loose_edges, loose_edge_name);
    check_loose_edges(check);
    check_isolated_vertices(check);
    check_tetrahedra(check);
    check_positions(check, mesh.positions, "");
  } else {
    check_coordinates(check, mesh.positions, "");
  }
  return problems;
}

}  // namespace ogc::compare
