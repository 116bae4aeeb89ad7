// Each sort of problem is one loop over one array. Lengths and areas are asked only of usable coordinates, faces only of valid indices.
#include "compare/problem/validate_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "compare/problem/problem_sort.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/zero_area.hpp"

namespace ogc::compare {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

bool usable_length(double length) { return length == 0 || (std::abs(length) >= least_length && std::abs(length) <= most_length); }

bool check_coordinates(const std::vector<Vec3>& positions, const std::string& kind, std::size_t limit, std::vector<Problem>& problems) {
  ProblemSort not_finite(problems, limit, kind + "position is not finite", "give three finite coordinates [m]");
  ProblemSort out_of_range(problems, limit, kind + "coordinate is neither zero nor within 2⁻²⁰ … 2²⁰ m", "scale or move the mesh; coordinates are in metres");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto& [x, y, z] = positions[v];
    if (!is_finite(positions[v])) {
      not_finite.add(numbered("vertex", v), printed(positions[v]));
    } else if (!usable_length(x) || !usable_length(y) || !usable_length(z)) {
      out_of_range.add(numbered("vertex", v), printed(positions[v]));
    }
  }
  return not_finite.count() == 0 && out_of_range.count() == 0;
}

// Each edge is visited once for each triangle that has it; a bad edge is named with the first. Zero is decided exactly; at the ends of the range one
// rounding of the length does not matter.
void check_edges(const Mesh& mesh, const std::vector<Vec3>& positions, const std::string& kind, std::size_t limit, std::vector<Problem>& problems) {
  ProblemSort zero(problems, limit, kind + "edge of zero length", "merge the two vertices or move them apart");
  ProblemSort out_of_range(problems, limit, kind + "edge length is not within 2⁻²⁰ … 2²⁰ m", "scale the mesh; coordinates are in metres");
  std::set<Edge> named;
  const auto check = [&](const char* face, std::size_t i, Index a, Index b) {
    const Vec3 &p = positions[at(a)], &q = positions[at(b)];
    const bool is_zero = p == q;
    const double length = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    if ((!is_zero && usable_length(length)) || !named.insert(ordered(a, b)).second) return;
    const std::string where = numbered(face, i), ends = "vertices " + std::to_string(a) + " and " + std::to_string(b);
    is_zero ? zero.add(where, ends) : out_of_range.add(where, ends + ", " + shortest(length) + " m");
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) check("triangle", t, mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  }
  for (std::size_t e = 0; e < mesh.loose_edges.size(); ++e) check("loose edge", e, mesh.loose_edges[e][0], mesh.loose_edges[e][1]);
}

void check_areas(const Mesh& mesh, const std::vector<Vec3>& positions, const std::string& kind, std::size_t limit, std::vector<Problem>& problems) {
  ProblemSort zero(problems, limit, kind + "triangle of zero area", "remove the triangle or move its vertices off one line");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (!has_zero_area(positions[at(a)], positions[at(b)], positions[at(c)])) continue;
    zero.add(numbered("triangle", t), "vertices " + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c));
  }
}

// Sorted copies with their numbers stand next to each other where they are equal.
template <std::size_t corners>
void check_repeated(const std::string& kind, const std::vector<std::array<Index, corners>>& faces, std::size_t limit, std::vector<Problem>& problems) {
  ProblemSort repeated(problems, limit, "has the same vertices as another " + kind, "keep one of them");
  std::vector<std::pair<std::array<Index, corners>, std::size_t>> sorted;
  sorted.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    sorted.emplace_back(faces[i], i);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) repeated.add(numbered(kind, sorted[i].second), numbered(kind, sorted[i - 1].second));
  }
}

void check_loose_edges(const Mesh& mesh, std::size_t limit, std::vector<Problem>& problems) {
  if (mesh.loose_edges.empty()) return;
  ProblemSort in_triangle(problems, limit, "is an edge of a triangle too", "remove the loose edge");
  std::set<Edge> of_triangles;
  for (const auto& [a, b, c] : mesh.triangles) of_triangles.insert({ordered(a, b), ordered(b, c), ordered(c, a)});
  for (std::size_t e = 0; e < mesh.loose_edges.size(); ++e) {
    const auto& [a, b] = mesh.loose_edges[e];
    if (of_triangles.contains(ordered(a, b))) in_triangle.add(numbered("loose edge", e));
  }
}

void check_isolated_vertices(const Mesh& mesh, std::size_t limit, std::vector<Problem>& problems) {
  ProblemSort isolated(problems, limit, "belongs to no triangle and no edge", "remove the vertex");
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) used[at(v)] = true;
  }
  for (const Edge& e : mesh.loose_edges) {
    for (const Index v : e) used[at(v)] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) isolated.add(numbered("vertex", v));
  }
}

}  // namespace

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string printed(const Vec3& v) { return "(" + shortest(v.x) + ", " + shortest(v.y) + ", " + shortest(v.z) + ")"; }

bool check_indices(const Mesh& mesh, std::size_t limit, std::vector<Problem>& problems) {
  const std::size_t count = mesh.positions.size();
  ProblemSort range(problems, limit, "names a vertex that does not exist", "vertices are numbered from 0 to " + std::to_string(count - 1));
  ProblemSort repeated(problems, limit, "has the same vertex twice", "remove the face");
  const auto check = [&](const char* kind, std::size_t i, std::span<const Index> corners) {
    for (const Index v : corners) {
      if (v < 0 || at(v) >= count) return range.add(numbered(kind, i), std::to_string(v));
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (corners[k] == corners[(k + 1) % corners.size()]) return repeated.add(numbered(kind, i), numbered("vertex", at(corners[k])));
    }
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) check("triangle", t, mesh.triangles[t]);
  for (std::size_t e = 0; e < mesh.loose_edges.size(); ++e) check("loose edge", e, mesh.loose_edges[e]);
  return range.count() == 0 && repeated.count() == 0;
}

void check_positions(const Mesh& mesh, const std::vector<Vec3>& positions, const std::string& kind, std::size_t limit, std::vector<Problem>& problems) {
  if (!check_coordinates(positions, kind, limit, problems)) return;
  check_edges(mesh, positions, kind, limit, problems);
  check_areas(mesh, positions, kind, limit, problems);
}

std::vector<Problem> validate(const Mesh& mesh, std::size_t limit) {
  if (mesh.positions.empty()) return {{"mesh", "has no vertices", "give at least one triangle or edge"}};
  std::vector<Problem> problems;
  if (check_indices(mesh, limit, problems)) {
    check_repeated("triangle", mesh.triangles, limit, problems);
    check_repeated("loose edge", mesh.loose_edges, limit, problems);
    check_loose_edges(mesh, limit, problems);
    check_isolated_vertices(mesh, limit, problems);
    check_positions(mesh, mesh.positions, "", limit, problems);
  } else {
    check_coordinates(mesh.positions, "", limit, problems);
  }
  return problems;
}

}  // namespace ogc::compare
