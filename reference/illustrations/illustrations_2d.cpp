// Computes Fig. 2c to e, 3, 4 and 22a as slices of swept polylines. Contact sets, layers and distances come from the
// swept surface; only the drawing is two-dimensional.
#include <algorithm>

#include "reference/definitions/contact_sets.hpp"
#include "reference/definitions/gauss_map.hpp"
#include "reference/illustrations/illustration_parts.hpp"
#include "reference/illustrations/slice.hpp"

namespace ogc::reference {
namespace {

using Point2 = Slice::Point2;

DrawingLayer polyline_layer(const Slice& slice, const std::string& name = "surface") {
  DrawingLayer layer{name, {}, {}, {{}}, {}, true};
  for (const Point2& p : slice.polyline()) {
    layer.lines[0].push_back(static_cast<int>(layer.points.size()));
    layer.points.push_back({p[0], p[1], 0});
  }
  return layer;
}

DrawingLayer circle(const Point2& centre, double r) {
  DrawingLayer layer{"radius", {}, {}, {{}}, {}, true};
  for (int k = 0; k <= 96; ++k) {
    const auto [x, y] = on_circle(k, 96);
    layer.lines[0].push_back(k);
    layer.points.push_back({centre[0] + r * x, centre[1] + r * y, 0});
  }
  return layer;
}

/// The force of a point x on one face of the polyline, by the quadratic branch of the activation. It acts at the face's
/// closest point to x, away from x, with length r − d.
struct Push {
  SliceFace face;
  std::array<double, 2> from{}, force{};
};

Push push_on(const Slice& slice, SliceFace face, const Point2& x, double r) {
  const Point2& a = slice.polyline()[static_cast<std::size_t>(face.index)];
  std::array<double, 2> c{a[0], a[1]};
  if (face.segment) {
    const Point2& b = slice.polyline()[static_cast<std::size_t>(face.index) + 1];
    const double ex = static_cast<double>(b[0]) - a[0], ey = static_cast<double>(b[1]) - a[1];
    const double s = std::clamp(((x[0] - a[0]) * ex + (x[1] - a[1]) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    c = {a[0] + s * ex, a[1] + s * ey};
  }
  const double dx = c[0] - x[0], dy = c[1] - x[1], d = std::hypot(dx, dy);
  if (d == 0) return {face, c, {0, 0}};  // no direction
  return {face, c, {(r - d) * dx / d, (r - d) * dy / d}};
}

DrawingLayer arrows(const std::string& name, const Slice& slice, const std::vector<SliceFace>& faces, const Point2& x,
                    double r) {
  DrawingLayer layer{name, {}, {}, {}, {}, true};
  for (const SliceFace face : faces) {
    const Push push = push_on(slice, face, x, r);
    const int first = static_cast<int>(layer.points.size());
    layer.points.push_back({push.from[0], push.from[1], 0});
    layer.points.push_back({push.from[0] + push.force[0], push.from[1] + push.force[1], 0});
    layer.lines.push_back({first, first + 1});
    layer.values.push_back(face.index);  // number of the segment, for its colour
    layer.values.push_back(face.segment ? 1 : 0);
  }
  return layer;
}

/// Returns the segments that sweep the given triangles. Leaves out the segments that end at the vertex `without` if it
/// is ≥ 0, because these contain the vertex (Eq. 3).
std::vector<SliceFace> segments_of(const Slice& slice, const std::vector<Index>& triangles, Index without = -1) {
  const SliceFace own = without < 0 ? SliceFace{true, -2} : slice.face_of(vertex_face(without));
  std::vector<SliceFace> faces;
  for (const Index t : triangles) {
    const SliceFace face = slice.face_of(triangle_face(t));
    if (own.segment || (face.index != own.index && face.index + 1 != own.index)) faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Returns the faces in contact with the vertex by Eq. 12: faces whose blocks hold the vertex and that do not contain
/// it.
std::vector<SliceFace> ogc_faces(const Slice& slice, Index vertex, float r) {
  const Complex mesh = slice.mesh();
  const std::vector<Index> no_groups;
  const compare::DetectIn in{&mesh.topology, no_groups, mesh.positions, r, r};
  std::vector<SliceFace> faces;
  for (const auto& c : vertex_facet_over_all_pairs(in)) {
    if (c.vertex == vertex) faces.push_back(slice.face_of(c.face));
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

DrawingPanel face_set_panel(const std::string& name, const std::string& caption, const Slice& slice, Index vertex,
                            float r) {
  const Complex mesh = slice.mesh();
  const Point2 x{mesh.at(vertex).x, mesh.at(vertex).y};
  DrawingPanel panel{name, caption, {polyline_layer(slice), circle(x, r), {"x", {{x[0], x[1], 0}}, {}, {}, {}, true}}};
  const bool on_line = vertex < slice.extra(0);
  panel.layers.push_back(
      arrows("IPC", slice, segments_of(slice, ipc_face_set(mesh, vertex, r), on_line ? vertex : -1), x, r));
  panel.layers.push_back(arrows("SDF", slice, segments_of(slice, sdf_face_set(mesh, mesh.at(vertex), r)), x, r));
  panel.layers.push_back(arrows("OGC", slice, ogc_faces(slice, vertex, r), x, r));
  return panel;
}

/// Returns a grid of nx × ny points over a rectangle, x fastest. The offset 0.501 avoids points on boundaries.
template <class Value>
DrawingLayer field(const std::string& name, const std::array<double, 4>& rectangle, int nx, int ny, Value value) {
  DrawingLayer layer{name, {}, {}, {}, {}, true};
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const double x = rectangle[0] + (rectangle[1] - rectangle[0]) * (i + 0.501) / nx,
                   y = rectangle[2] + (rectangle[3] - rectangle[2]) * (j + 0.499) / ny;
      layer.points.push_back({x, y, 0});
      layer.values.push_back(value(Vec3f{static_cast<float>(x), static_cast<float>(y), 0}));
    }
  }
  return layer;
}

/// Returns the half-line from vertex i that bisects the angle at the vertex.
DrawingLayer bisector(const Slice& slice, std::size_t i, double length) {
  const Point2 &a = slice.polyline()[i - 1], &b = slice.polyline()[i], &c = slice.polyline()[i + 1];
  const double to_a = std::hypot(a[0] - b[0], a[1] - b[1]), to_c = std::hypot(c[0] - b[0], c[1] - b[1]);
  const double x = (a[0] - b[0]) / to_a + (c[0] - b[0]) / to_c, y = (a[1] - b[1]) / to_a + (c[1] - b[1]) / to_c,
               scale = length / std::hypot(x, y);
  return {"bisector", {{b[0], b[1], 0}, {b[0] + scale * x, b[1] + scale * y, 0}}, {}, {{0, 1}}, {}, true};
}

/// Returns a curve with two strands that come near each other.
Slice hairpin() {
  return Slice({{-3, 0.9f},
                {-1.5f, 0.55f},
                {0, 0.5f},
                {1.5f, 0.6f},
                {2.5f, 0},
                {1.5f, -0.6f},
                {0, -0.35f},
                {-1.5f, -0.6f},
                {-3, -0.8f}});
}

/// Returns the boundary of a segment's block in the plane as two layers. The first has the two lines at distance r,
/// which belong to the block. The second has the two lines through the ends, which do not belong to the block.
std::vector<DrawingLayer> segment_block(const Slice& slice, int segment, double r) {
  const Complex mesh = slice.mesh();
  Index t = 0;
  while (slice.face_of(triangle_face(t)) != SliceFace{true, segment}) ++t;
  const auto &a = slice.polyline()[static_cast<std::size_t>(segment)],
             &b = slice.polyline()[static_cast<std::size_t>(segment) + 1];
  const std::string name = "block of facet " + std::to_string(segment);
  DrawingLayer closed{name, {}, {}, {{0, 1}, {2, 3}}, {}, true}, open{name, {}, {}, {{0, 2}, {1, 3}}, {}, false};
  for (const Unit& n : gauss_map(mesh, triangle_face(t)).corners) {
    for (const Point2& p : {a, b}) closed.points.push_back({p[0] + r * n[0], p[1] + r * n[1], 0});
  }
  open.points = closed.points;
  return {closed, open};
}

/// Returns IPC's model of a segment: all points within r of it. Its outline has a half circle around each end.
DrawingLayer capsule(const Slice& slice, int segment, double r) {
  const auto &a = slice.polyline()[static_cast<std::size_t>(segment)],
             &b = slice.polyline()[static_cast<std::size_t>(segment) + 1];
  const double along = std::atan2(static_cast<double>(b[1]) - a[1], static_cast<double>(b[0]) - a[0]);
  constexpr int half = 48;
  DrawingLayer layer{"capsule of facet " + std::to_string(segment), {}, {}, {{}}, {}, false};
  for (int k = 0; k <= 2 * half + 1; ++k) {
    const Point2& centre = k <= half ? b : a;
    const double angle = along + std::numbers::pi * (static_cast<double>(k <= half ? k : k - 1) / half - 0.5);
    layer.lines[0].push_back(k);
    layer.points.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0});
  }
  layer.lines[0].push_back(0);
  return layer;
}

/// Returns a panel with the given vertices. Arrows show the force of each vertex on each face in its contact set, by
/// OGC if `ogc`, otherwise by IPC.
DrawingPanel model_panel(const std::string& name, const std::string& caption, const Slice& slice,
                         const std::vector<Index>& vertices, float r, bool ogc) {
  const Complex mesh = slice.mesh();
  DrawingPanel panel{name, caption, {polyline_layer(slice)}};
  DrawingLayer points{"points", {}, {}, {}, {}, true};
  for (const Index v : vertices) {
    const Point2 x{mesh.at(v).x, mesh.at(v).y};
    points.points.push_back({x[0], x[1], 0});
    const auto faces = ogc ? ogc_faces(slice, v, r)
                           : segments_of(slice, ipc_face_set(mesh, v, r), v < slice.extra(0) ? v : -1);
    panel.layers.push_back(arrows("arrows", slice, faces, x, r));
  }
  panel.layers.push_back(std::move(points));
  return panel;
}

}  // namespace

std::vector<DrawingPanel> contact_models() {
  const std::vector<Point2> around{{-1.02f, 0.2f}, {0.15f, 0.38f}, {0.98f, -0.25f}};
  const Slice facet({{-0.75f, 0}, {0.75f, 0}}, around),
      sheet({{-1.6f, 0.04f}, {-0.8f, 0}, {0, 0.06f}, {0.8f, 0}, {1.6f, 0.04f}}, around);
  constexpr float r = 0.55f, large = 1.1f;
  const std::vector<Index> strangers{facet.extra(0), facet.extra(1), facet.extra(2)};
  std::vector<DrawingPanel> panels{
      model_panel("c", "IPC: a facet offset in all directions; beyond its ends it pushes along itself, too", facet,
                  strangers, r, false),
      model_panel("d", "IPC, radius of more than an edge: a sheet's own neighbours push each other", sheet,
                  {sheet.vertex(1), sheet.vertex(3)}, large, false),
      model_panel("e", "OGC: the blocks of the facets; neighbours in the sheet's plane are in none", sheet,
                  {sheet.vertex(1), sheet.vertex(3), sheet.extra(1)}, large, true)};
  panels[0].layers.push_back(capsule(facet, 0, r));
  for (const int segment : {0, 1, 2, 3}) {
    panels[1].layers.push_back(capsule(sheet, segment, large));
    for (DrawingLayer& boundary : segment_block(sheet, segment, large)) panels[2].layers.push_back(std::move(boundary));
  }
  return panels;
}

std::vector<DrawingPanel> contact_face_sets() {
  const std::vector<Point2> above{{0.1f, 0.45f}};
  const Slice ridge({{-1.6f, -0.9f}, {0, 0}, {1.6f, -0.9f}}, above);
  const Slice row({{-2, 0.1f}, {-1, -0.05f}, {0, 0}, {1, -0.05f}, {2, 0.1f}, {3, 0}});
  const std::vector<Point2> between{{0.02f, 0.55f}};
  const Slice valley({{-1.6f, 1.1f}, {0, 0}, {1.6f, 1.1f}}, between);
  std::vector<DrawingPanel> panels{
      face_set_panel("a", "IPC over a ridge: two facets, neither push normal to its facet", ridge, ridge.extra(0), 1),
      face_set_panel("b", "IPC and a vertex's own neighbourhood: the second ring is pushed away", row, row.vertex(2),
                     1.4f),
      face_set_panel("c", "SDF in a valley: one facet at a time, on either side of the bisector", valley,
                     valley.extra(0), 1)};
  panels[2].layers.push_back(bisector(valley, 1, 1.8));
  return panels;
}

std::vector<DrawingPanel> offset_geometries() {
  constexpr float r = 0.6f;
  constexpr std::array<double, 4> rectangle{-3.8, 3.4, -1.7, 1.8};
  constexpr int nx = 360, ny = 175;
  const Slice slice = hairpin();
  const auto layers = field("layers", rectangle, nx, ny,
                            [&](const Vec3f& x) { return static_cast<double>(slice.layers(x, r).size()); });
  const auto inside = field("inside", rectangle, nx, ny,
                            [&](const Vec3f& x) { return sdf_face_set(slice.mesh(), x, r).empty() ? 0.0 : 1.0; });
  return {{"a", "the original geometry M", {polyline_layer(slice)}},
          {"b", "the offset geometry of Eq. 5", {polyline_layer(slice), inside}},
          {"c", "the intersection-aware manifold with its layers", {polyline_layer(slice), layers}}};
}

std::vector<DrawingPanel> force_along_a_path() {
  constexpr float r = 0.8f;
  const Slice slice({{-2, 0.9f}, {0, 0}, {2, 0.9f}});
  DrawingLayer path{"path", {}, {}, {{}}, {}, true}, left{"force of the left facet", {}, {}, {{}}, {}, true};
  DrawingLayer right{"force of the right facet", {}, {}, {{}}, {}, true};
  constexpr int steps = 400;
  for (int k = 0; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    const Point2 x{static_cast<float>(-0.95 + 1.9 * s), static_cast<float>(0.62)};
    path.lines[0].push_back(k);
    path.points.push_back({x[0], x[1], 0});
    std::array<double, 2> forces{};
    for (const SliceFace face : slice.layers({x[0], x[1], 0}, r)) {
      const Push push = push_on(slice, face, x, r);
      if (face.segment) forces[static_cast<std::size_t>(face.index)] = std::hypot(push.force[0], push.force[1]);
    }
    left.points.push_back({s, forces[0], 0});
    right.points.push_back({s, forces[1], 0});
    left.lines[0].push_back(k);
    right.lines[0].push_back(k);
  }
  const auto layers = field("layers", {-3, 3, -1, 2}, 300, 150,
                            [&](const Vec3f& x) { return static_cast<double>(slice.layers(x, r).size()); });
  DrawingPanel way{"path",
                   "a path through a valley, the blocks of its facets (dashed: open), and the number of layers",
                   {polyline_layer(slice), layers, path}};
  for (const int segment : {0, 1}) {
    for (DrawingLayer& boundary : segment_block(slice, segment, r)) way.layers.push_back(std::move(boundary));
  }
  return {std::move(way),
          {"force",
           "force of each facet along the path (quadratic stage): it jumps where the open boundary is entered",
           {left, right}}};
}

}  // namespace ogc::reference
