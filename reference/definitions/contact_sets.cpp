// The functions `…_over_all_pairs` share with the detections only the predicates of Algorithms 1 and 2. The functions
// `…_by_definition` use none of these predicates.
#include "reference/definitions/contact_sets.hpp"

#include <algorithm>
#include <set>

#include "reference/definitions/defined_blocks_exact.hpp"
#include "reference/geometry/closest_face.hpp"

namespace ogc::reference {
namespace {

using compare::VertexFacetContact;

Corners corners_of(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  return {mesh.at(a), mesh.at(b), mesh.at(c)};
}

/// Returns the corners, edges and interior of a triangle.
std::array<Face, 7> faces_of(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  const auto [ab, bc, ca] = mesh.topology.triangle_edges[static_cast<std::size_t>(t)];
  return {vertex_face(a), vertex_face(b), vertex_face(c),  edge_face(ab),
          edge_face(bc),  edge_face(ca),  triangle_face(t)};
}

bool contains(std::span<const Index> vertices, Index v) {
  return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
}

/// Returns the triangle with the lowest index that contains a face.
Index owner_of(const Complex& mesh, Face face) {
  const auto i = static_cast<std::size_t>(face.index);
  if (face.kind == FaceKind::vertex) return mesh.topology.vertex_triangles[i].front();
  return face.kind == FaceKind::edge ? mesh.topology.edge_triangles[i].front() : face.index;
}

/// Returns whether vertex v and triangle t are on the surface, t does not contain v, and the pair is not excluded.
bool is_candidate(const compare::DetectIn& in, Index v, Index t) {
  if (!in.topology->on_surface(v)) return false;
  const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(t)];
  return in.topology->on_surface(corners) && !contains(corners, v) && !is_excluded(in.exclusions, {&v, 1}, corners);
}

bool in_planes(const Complex& mesh, Face face, const Vec3f& x) {
  bool inside = true;
  visit_block(mesh, face, x, [&](const Boundary& boundary) { return inside = holds(boundary.condition); });
  return inside;
}

/// Returns d² − r², where d is the distance from x to a closed triangle.
Margin triangle_gap(const Complex& mesh, Index t, const Vec3f& x, float contact_radius) {
  const Corners corners = corners_of(mesh, t);
  return with_radius(feature_gap(corners, closest_feature(corners, x), x), contact_radius);
}

/// Executes lines 7–20 of Alg. 1 for one vertex and one triangle.
void enter(const compare::DetectIn& in, const Complex& mesh, Index v, Index t, std::set<VertexFacetContact>& entered) {
  if (!is_candidate(in, v, t) || sign(triangle_gap(mesh, t, mesh.at(v), in.contact_radius)) >= 0) return;
  const auto feature = static_cast<std::size_t>(closest_feature(corners_of(mesh, t), mesh.at(v)));
  const Face a = faces_of(mesh, t)[feature];
  if (a.kind == FaceKind::triangle || in_planes(mesh, a, mesh.at(v))) entered.insert({v, a, owner_of(mesh, a)});
}

/// Returns the squared distance from x to triangle t as an exact quotient.
Quotient<Exact> exact_squared_distance(const Complex& mesh, Index t, const Vec3f& x) {
  Quotient<Exact> smallest{Exact(-1), Exact(1)};
  for (const Face face : faces_of(mesh, t)) {
    const auto found = connection(mesh, face, {exact(x)});
    if (!found) continue;
    const Quotient<Exact> d{dot(found->along, found->along), found->weight * found->weight};
    if (sign_of(smallest.numerator) < 0 ||
        sign_of(d.numerator * smallest.denominator - smallest.numerator * d.denominator) < 0)
      smallest = d;
  }
  return smallest;
}

}  // namespace

std::vector<VertexFacetContact> vertex_facet_by_definition(const compare::DetectIn& in) {
  const Complex mesh{*in.topology, in.positions};
  const DefinedBlocks blocks(mesh);
  std::set<VertexFacetContact> found;
  for (Index v = 0; v < in.topology->vertex_count; ++v) {
    if (!in.topology->on_surface(v)) continue;
    for (Index t = 0; t < static_cast<Index>(in.topology->triangles.size()); ++t) {
      if (!in.topology->on_surface(mesh.triangle(t)) || is_excluded(in.exclusions, {&v, 1}, mesh.triangle(t))) continue;
      for (const Face face : faces_of(mesh, t)) {
        // Eq. 12 requires only v ⊄ a. So triangles that contain v are visited, too: the edge opposite to v may belong
        // to no other triangle.
        if (!contains(mesh.vertices(face).span(), v) && blocks.in_contact(face, mesh.at(v), in.contact_radius))
          found.insert({v, face, owner_of(mesh, face)});
      }
    }
  }
  return {found.begin(), found.end()};
}

std::vector<VertexFacetContact> vertex_facet_over_all_pairs(const compare::DetectIn& in) {
  const Complex mesh{*in.topology, in.positions};
  std::set<VertexFacetContact> entered;
  for (Index v = 0; v < in.topology->vertex_count; ++v) {
    for (Index t = 0; t < static_cast<Index>(in.topology->triangles.size()); ++t) enter(in, mesh, v, t, entered);
  }
  return {entered.begin(), entered.end()};
}

std::vector<std::vector<Index>> vertices_near_facets(const compare::Topology& topology,
                                                     std::span<const VertexFacetContact> contacts) {
  std::vector<std::vector<Index>> rows(topology.triangles.size());
  for (const VertexFacetContact& c : contacts) rows[static_cast<std::size_t>(c.owner)].push_back(c.vertex);
  for (auto& row : rows) std::sort(row.begin(), row.end());
  return rows;
}

std::vector<Index> layers(const compare::Topology& topology, std::span<const VertexFacetContact> contacts) {
  std::vector<Index> counts(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const VertexFacetContact& c : contacts) ++counts[static_cast<std::size_t>(c.vertex)];
  return counts;
}

std::vector<double> penetration_depths(const Complex& mesh, std::span<const VertexFacetContact> contacts,
                                       float contact_radius) {
  std::vector<double> depths;
  for (const VertexFacetContact& c : contacts)
    depths.push_back(-signed_length(face_gap(mesh, c.face, mesh.at(c.vertex), contact_radius)));
  return depths;
}

std::vector<Index> ipc_face_set(const Complex& mesh, Index vertex, float contact_radius) {
  std::vector<Index> triangles;
  for (Index t = 0; t < static_cast<Index>(mesh.topology.triangles.size()); ++t) {
    if (!contains(mesh.triangle(t), vertex) && sign(triangle_gap(mesh, t, mesh.at(vertex), contact_radius)) < 0)
      triangles.push_back(t);
  }
  return triangles;
}

std::vector<Index> sdf_face_set(const Complex& mesh, const Vec3f& x, float contact_radius) {
  std::vector<Index> closest;
  Quotient<Exact> smallest{Exact(static_cast<double>(contact_radius)) * Exact(static_cast<double>(contact_radius)),
                           Exact(1)};
  for (Index t = 0; t < static_cast<Index>(mesh.topology.triangles.size()); ++t) {
    const Quotient<Exact> d = exact_squared_distance(mesh, t, x);
    const int order = sign_of(d.numerator * smallest.denominator - smallest.numerator * d.denominator);
    if (order < 0) {
      closest.assign(1, t);
      smallest = d;
    } else if (order == 0 && !closest.empty()) {
      closest.push_back(t);
    }
  }
  return closest;
}

}  // namespace ogc::reference
