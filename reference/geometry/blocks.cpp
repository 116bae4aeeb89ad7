// Multiplies squared distances and plane tests by positive lengths. So every test is the sign of a polynomial, and
// nothing is rounded.
#include "reference/geometry/blocks.hpp"

#include <algorithm>

namespace ogc::reference {

Index Complex::opposite(Index t, Index e) const {
  const compare::Triangle& corners = triangle(t);
  const compare::Edge& ends = edge(e);
  return *std::find_if(corners.begin(), corners.end(), [&](Index v) { return v != ends[0] && v != ends[1]; });
}

Complex::Vertices Complex::vertices(Face face) const {
  if (face.kind == FaceKind::vertex) return {{face.index, -1, -1}, 1};
  if (face.kind == FaceKind::edge) return {{edge(face.index)[0], edge(face.index)[1], -1}, 2};
  return {triangle(face.index), 3};
}

Margin face_gap(const Complex& mesh, Face face, const Vec3f& x, float contact_radius) {
  const auto v = mesh.vertices(face).items;
  if (face.kind == FaceKind::vertex) return gap_points(mesh.at(v[0]), x, contact_radius);
  if (face.kind == FaceKind::edge) return gap_line(mesh.at(v[0]), mesh.at(v[1]), x, contact_radius);
  return gap_plane(mesh.at(v[0]), mesh.at(v[1]), mesh.at(v[2]), x, contact_radius);
}

bool in_block(const Complex& mesh, Face face, const Vec3f& x, float contact_radius) {
  bool inside = true;
  visit_block(mesh, face, x, [&](const Boundary& boundary) { return inside = holds(boundary.condition); });
  return inside && sign(face_gap(mesh, face, x, contact_radius)) <= 0;
}

bool in_edge_only_block(const Complex& mesh, Face face, const Vec3f& x, float contact_radius) {
  bool inside = true;
  visit_block(mesh, face, x, [&](const Boundary& boundary) {
    if (boundary.condition.margin.kind == MarginKind::along) inside = holds(boundary.condition);
    return inside;
  });
  return inside && sign(face_gap(mesh, face, x, contact_radius)) <= 0;
}

Margin pair_gap(const Complex& mesh, const FacePair& pair, float contact_radius) {
  const auto a = mesh.vertices(pair.first).items, b = mesh.vertices(pair.second).items;
  if (pair.first.kind == FaceKind::edge)
    return gap_lines(mesh.at(a[0]), mesh.at(a[1]), mesh.at(b[0]), mesh.at(b[1]), contact_radius);
  if (pair.second.kind == FaceKind::edge) return gap_line(mesh.at(b[0]), mesh.at(b[1]), mesh.at(a[0]), contact_radius);
  return gap_points(mesh.at(a[0]), mesh.at(b[0]), contact_radius);
}

bool is_excluded(const compare::ExclusionView& exclusions, std::span<const Index> first,
                 std::span<const Index> second) {
  if (exclusions.partners != nullptr)
    for (const Index v : first)
      for (const Index partner : (*exclusions.partners)[static_cast<std::size_t>(v)])
        if (std::find(second.begin(), second.end(), partner) != second.end()) return true;
  const std::span<const Index> groups = exclusions.groups;
  if (groups.empty()) return false;
  const Index group = groups[static_cast<std::size_t>(first.front())];
  const auto same = [&](Index v) { return groups[static_cast<std::size_t>(v)] == group; };
  return group >= 0 && std::all_of(first.begin(), first.end(), same) && std::all_of(second.begin(), second.end(), same);
}

}  // namespace ogc::reference
