#include "reference/definitions/volumetric_contact.hpp"

#include <algorithm>

namespace ogc::reference {
namespace {

std::vector<VolumetricContact> contacts_inside(const TetVolume& body, const Vec3f& x, float contact_radius, Index own) {
  std::vector<VolumetricContact> contacts;
  for (const std::vector<Index>& sheet : body.sheets(x)) {
    if (own >= 0 && std::all_of(sheet.begin(), sheet.end(), [&](Index t) { return body.has_vertex(t, own); })) continue;
    const BoundaryPath path = body.shortest_path_to_boundary(x, sheet.front()).path;
    contacts.push_back({true, triangle_face(path.triangle), path.length + static_cast<double>(contact_radius)});
  }
  return contacts;
}

}  // namespace

compare::Topology surface_topology(const TetVolume& body, Index vertex_count) {
  std::vector<compare::Triangle> triangles;
  for (const BoundaryTriangle& side : body.boundary()) triangles.push_back(side.vertices);
  return compare::build_topology(vertex_count, triangles);
}

std::vector<VolumetricContact> volumetric_contacts(const TetVolume& body, const ClosedSurface& surface, const Vec3f& x,
                                                   float contact_radius, Index own) {
  std::vector<VolumetricContact> contacts = contacts_inside(body, x, contact_radius, own);
  if (!contacts.empty()) return contacts;
  const Complex& mesh = surface.mesh();
  const auto ask = [&](FaceKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Face face{kind, static_cast<Index>(i)};
      const auto vertices = mesh.vertices(face);
      if (std::ranges::find(vertices.span(), own) != vertices.span().end() ||
          !surface.in_outward_block(face, x, contact_radius))
        continue;
      const Margin gap = face_gap(mesh, face, x, contact_radius);
      if (sign(gap) < 0) contacts.push_back({false, face, -signed_length(gap)});
    }
  };
  ask(FaceKind::vertex, static_cast<std::size_t>(mesh.topology.vertex_count));
  ask(FaceKind::edge, mesh.topology.edges.size());
  ask(FaceKind::triangle, mesh.topology.triangles.size());
  return contacts;
}

}  // namespace ogc::reference
