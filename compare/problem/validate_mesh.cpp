// Each kind of problem is one loop over one array. Lengths and areas are computed only from valid coordinates, and only
// for faces with valid indices.
#include "compare/problem/validate_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <span>

#include "compare/problem/problem_kind.hpp"
#include "compare/problem/scene.hpp"
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

template <class List>
std::string element_name(const MeshCheck& check, std::size_t i) {
  return std::invoke(List::named, check.names, static_cast<Index>(i), (check.mesh.*List::list)[i]);
}

/// Calls `use` with the two ends of each edge of an element. The edges of a triangle follow its orientation; any other
/// element has an edge between any two of its vertices.
template <std::size_t corners, class Use>
void each_edge(const std::array<Index, corners>& element, const Use& use) {
  for (std::size_t k = 0; k < corners; ++k) {
    if (corners == 3) use(element[k], element[(k + 1) % 3]);
    for (std::size_t l = k + 1; l < corners && corners != 3; ++l) use(element[k], element[l]);
  }
}

// Visits each edge once for each element that has it; a bad edge is listed once, with the first element. Whether a
// length is 0 is decided exactly. At the limits of the range a rounding error of the length does not matter.
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
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    const auto& all = check.mesh.*List::list;
    for (std::size_t i = 0; i < all.size(); ++i)
      each_edge(all[i], [&](Index a, Index b) { check_edge(a, b, [&] { return element_name<List>(check, i); }); });
  });
}

void check_areas(const MeshCheck& check, const std::vector<Vec3>& positions, const std::string& kind) {
  ProblemKind zero(check.problems, check.limit, kind + "triangle of zero area",
                   "remove the triangle or move its vertices");
  for (std::size_t t = 0; t < check.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = check.mesh.triangles[t];
    if (has_zero_area(positions[at(a)], positions[at(b)], positions[at(c)]))
      zero.add(element_name<TrianglesOfMesh>(check, t));
  }
}

// Lists elements with equal vertices, which stand next to each other after sorting.
template <class List>
void check_repeated(const MeshCheck& check) {
  const auto& all = check.mesh.*List::list;
  ProblemKind repeated(check.problems, check.limit, std::string("has the same vertices as another ") + List::name,
                       "keep one of them");
  std::vector<std::pair<ElementOf<List>, std::size_t>> sorted;
  sorted.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    sorted.emplace_back(all[i], i);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first)
      repeated.add(element_name<List>(check, sorted[i].second), element_name<List>(check, sorted[i - 1].second));
  }
}

void check_loose_edges(const MeshCheck& check) {
  if (check.mesh.loose_edges.empty()) return;
  ProblemKind in_triangle(check.problems, check.limit, "is an edge of a triangle too", "remove the loose edge");
  std::set<Edge> of_triangles;
  for (const auto& [a, b, c] : check.mesh.triangles) of_triangles.insert({ordered(a, b), ordered(b, c), ordered(c, a)});
  for (std::size_t e = 0; e < check.mesh.loose_edges.size(); ++e) {
    const auto& [a, b] = check.mesh.loose_edges[e];
    if (of_triangles.contains(ordered(a, b))) in_triangle.add(element_name<LooseEdgesOfMesh>(check, e));
  }
}

void check_isolated_vertices(const MeshCheck& check) {
  ProblemKind isolated(check.problems, check.limit, "belongs to no triangle, no edge and no tetrahedron",
                       "remove the vertex");
  std::vector<bool> used(check.mesh.positions.size());
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    for (const auto& element : check.mesh.*List::list)
      for (const Index v : element) used[at(v)] = true;
  });
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) isolated.add(check.names.vertex(static_cast<Index>(v)));
  }
}

}  // namespace

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string printed(const Vec3& v) { return "(" + shortest(v.x) + ", " + shortest(v.y) + ", " + shortest(v.z) + ")"; }

void check_volumes(const MeshCheck& check, const std::vector<Vec3>& rest_positions) {
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) List::check_rest(check, rest_positions);
  });
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
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    const auto& all = check.mesh.*List::list;
    for (std::size_t i = 0; i < all.size(); ++i) check_face(all[i], [&] { return element_name<List>(check, i); });
  });
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
    for_each_of<MeshLists>([&]<class List, std::size_t>() { check_repeated<List>(check); });
    check_loose_edges(check);
    check_isolated_vertices(check);
    for_each_of<MeshLists>([&]<class List, std::size_t>() {
      if constexpr (requires { List::check(check); }) List::check(check);
    });
    check_positions(check, mesh.positions, "");
  } else {
    check_coordinates(check, mesh.positions, "");
  }
  return problems;
}

}  // namespace ogc::compare
