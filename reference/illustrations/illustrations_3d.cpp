// Computes Fig. 5 to 8: normals and blocks of single faces, each on the smallest surface that has such a face.
#include "reference/illustrations/block_picture.hpp"
#include "reference/illustrations/illustration_parts.hpp"

namespace ogc::reference {
namespace {

struct Shape {
  std::vector<Vec3f> positions;
  compare::Topology topology;

  Shape(std::vector<Vec3f> at, const std::vector<compare::Triangle>& triangles,
        const std::vector<compare::Edge>& loose = {})
      : positions(std::move(at)),
        topology(compare::build_topology(static_cast<Index>(positions.size()), triangles, loose)) {}
  Complex mesh() const { return {topology, positions}; }
};

/// Returns a closed fan of triangles around vertex 0. The i-th neighbour of vertex 0 has the height heights[i].
Shape star(const std::vector<float>& heights) {
  const auto k = static_cast<Index>(heights.size());
  std::vector<Vec3f> positions{{0, 0, 0}};
  std::vector<compare::Triangle> triangles;
  for (Index i = 0; i < k; ++i) {
    const auto [x, y] = on_circle(i, k);
    positions.push_back({static_cast<float>(x), static_cast<float>(y), heights[static_cast<std::size_t>(i)]});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % k});
  }
  return {positions, triangles};
}

DrawingLayer surface_of(const Complex& mesh) {
  DrawingLayer layer{"surface", {}, {}, {}, {}, true};
  for (const Vec3f& x : mesh.positions) layer.points.push_back({x.x, x.y, x.z});
  for (const auto& t : mesh.topology.triangles) layer.triangles.push_back({t[0], t[1], t[2]});
  for (const auto& e : mesh.topology.edges) layer.lines.push_back({e[0], e[1]});
  return layer;
}

DrawingLayer face_layer(const Complex& mesh, Face face) {
  DrawingLayer layer{"face", {}, {}, {}, {}, true};
  const auto vertices = mesh.vertices(face);
  std::vector<int> all;
  for (const Index v : vertices.span()) {
    const Vec3f& x = mesh.at(v);
    all.push_back(static_cast<int>(layer.points.size()));
    layer.points.push_back({x.x, x.y, x.z});
  }
  if (face.kind == FaceKind::triangle) layer.triangles.push_back({0, 1, 2});
  layer.lines.push_back(all);
  return layer;
}

void add_block(DrawingPanel& panel, const Complex& mesh, Face face, float contact_radius, bool edge_only) {
  const BlockPicture picture = block_picture(mesh, face, contact_radius, edge_only, 0.06);
  for (const BlockPatch& patch : picture.patches)
    panel.layers.push_back({"block", picture.points, patch.triangles, patch.outlines, {}, patch.closed});
}

DrawingLayer curve(const std::string& name, const std::vector<Unit>& points) {
  DrawingLayer layer{name, points, {}, {}, {}, true};
  std::vector<int> all;
  for (std::size_t k = 0; k < points.size(); ++k) all.push_back(static_cast<int>(k));
  layer.lines.push_back(all);
  return layer;
}

/// Adds N_a on the unit sphere, and for a vertex of the surface the indicatrix (polygon of the triangles' normals).
void add_normals(DrawingPanel& panel, const Complex& mesh, Face face, bool edge_only) {
  const GaussMap map = gauss_map(mesh, face, edge_only);
  if (map.dimension == 0) {
    panel.layers.push_back({"gauss_map", map.corners, {}, {}, {}, true});
  } else if (map.dimension > 0) {
    panel.layers.push_back(curve("gauss_map", outline(map, 0.05)));
  }
  if (face.kind != FaceKind::vertex || edge_only) return;
  const auto polygon = indicatrix(mesh, face.index);
  if (!polygon) return;
  GaussMap ring{1, polygon->normals, polygon->closed};
  panel.layers.push_back(curve("indicatrix", outline(ring, 0.05)));
  panel.layers.push_back({"corners", polygon->normals, {}, {}, {polygon->area}, true});
}

DrawingPanel panel_of(const std::string& name, const std::string& caption, const Shape& shape, Face face,
                      float contact_radius, bool edge_only = false) {
  const Complex mesh = shape.mesh();
  DrawingPanel panel{name, caption, {surface_of(mesh), face_layer(mesh, face)}};
  add_block(panel, mesh, face, contact_radius, edge_only);
  add_normals(panel, mesh, face, edge_only);
  return panel;
}

Shape roof() { return {{{-1, 0, 0}, {1, 0, 0}, {0, 1.2f, -0.7f}, {0, -1.2f, -0.7f}}, {{0, 1, 2}, {1, 0, 3}}}; }

}  // namespace

std::vector<DrawingPanel> vertex_kinds() {
  return {
      panel_of("convex", "a convex vertex: the indicatrix is the boundary of N_v",
               star({-0.6f, -0.6f, -0.6f, -0.6f, -0.6f}), vertex_face(0), 0.8f),
      panel_of("mixed", "a mixed vertex: N_v is the part of positive curvature, the rest of the polygon is inverted",
               star({-0.4f, -0.9f, -0.4f, -0.4f, -0.4f, -0.4f}), vertex_face(0), 0.8f),
      panel_of("saddle", "a saddle vertex: no normals", star({0.5f, -0.5f, 0.5f, -0.5f}), vertex_face(0), 0.8f)};
}

std::vector<DrawingPanel> face_normals() {
  return {panel_of("triangle", "a triangle: two opposite normals (Eq. 6)", roof(), triangle_face(0), 0.8f),
          panel_of("edge", "an edge: the arc between its triangles' normals", roof(), edge_face(0), 0.8f)};
}

std::vector<DrawingPanel> surface_blocks() {
  const Shape sheet{{{-1, 0, 0}, {1, 0, 0}, {0, 1.4f, 0}}, {{0, 1, 2}}};
  return {panel_of("triangle", "U_t (Eq. 10)", sheet, triangle_face(0), 0.7f),
          panel_of("edge", "U_e (Eq. 9)", roof(), edge_face(0), 0.7f),
          panel_of("boundary edge", "U_e of a boundary edge", sheet, edge_face(0), 0.7f),
          panel_of("vertex", "U_v (Eq. 8)", star({-0.6f, -0.6f, -0.6f, -0.6f, -0.6f}), vertex_face(0), 0.7f)};
}

std::vector<DrawingPanel> edge_only_blocks() {
  const Shape line{{{-1, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}};
  const Shape bend{{{0, 0, 0}, {-1, 0, -0.6f}, {1, 0.3f, -0.6f}}, {}, {{0, 1}, {0, 2}}};
  return {
      panel_of("edge", "U_e of M^e (Eq. 14): N_e is a circle", line, edge_face(0), 0.6f, true),
      panel_of("vertex", "U_v of M^e (Eq. 15): N_v is the sphere cut by two planes", bend, vertex_face(0), 0.6f, true)};
}

}  // namespace ogc::reference
