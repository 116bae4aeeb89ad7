// A block is the set of points that a face a reaches when it moves along each of its normals (the set N_a) by up to r.
// For a vertex it consists of cones over the region N_v, for an edge of prisms over the arc N_e, for a triangle of one
// prism on each side of it. So each picture is made from the outline of N_a.
#include "reference/illustrations/block_picture.hpp"

#include <algorithm>
#include <cmath>

namespace ogc::reference {
namespace {

using Point3 = std::array<double, 3>;
using Kind = BlockMargin::Kind;

Point3 moved(const Point3& x, double s, const Unit& n) { return {x[0] + s * n[0], x[1] + s * n[1], x[2] + s * n[2]}; }

Point3 widened_point(const Vec3f& x) { return {x.x, x.y, x.z}; }

double inner(const Unit& a, const Unit& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns the point of the great circle from a to b at the parameter t in [0, 1]; a and b must not be opposite.
Unit between(const Unit& a, const Unit& b, double t) {
  const double angle = std::acos(std::clamp(inner(a, b), -1.0, 1.0));
  if (angle < 1e-9) return a;
  const double p = std::sin((1 - t) * angle) / std::sin(angle), q = std::sin(t * angle) / std::sin(angle);
  return {p * a[0] + q * b[0], p * a[1] + q * b[1], p * a[2] + q * b[2]};
}

/// Appends the arc from a to b without b.
void append_arc(std::vector<Unit>& points, const Unit& a, const Unit& b, double step) {
  const double angle = std::acos(std::clamp(inner(a, b), -1.0, 1.0));
  const int pieces = std::max(1, static_cast<int>(std::ceil(angle / step)));
  for (int k = 0; k < pieces; ++k) points.push_back(between(a, b, static_cast<double>(k) / pieces));
}

class Painter {
 public:
  int point(const Point3& x) {
    picture_.points.push_back(x);
    return static_cast<int>(picture_.points.size()) - 1;
  }
  BlockPatch& patch(Kind kind, bool closed) { return picture_.patches.emplace_back(BlockPatch{kind, closed, {}, {}}); }

  /// Adds a planar, convex patch. If no `outlines` are given, its outline is its boundary.
  void polygon(Kind kind, bool closed, const std::vector<int>& corners, std::vector<std::vector<int>> outlines = {}) {
    BlockPatch& wall = patch(kind, closed);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      wall.triangles.push_back({corners[0], corners[k], corners[k + 1]});
    wall.outlines = std::move(outlines);
    if (!wall.outlines.empty()) return;
    wall.outlines.push_back(corners);
    wall.outlines.back().push_back(corners.front());
  }

  /// Adds the surface between two rows of points. Its outlines join the first points and the last points of the rows,
  /// unless the rows are closed (`around`).
  void strip(Kind kind, bool closed, const std::vector<int>& low, const std::vector<int>& high, bool around) {
    BlockPatch& wall = patch(kind, closed);
    for (std::size_t k = 0; k + 1 < low.size(); ++k) {
      wall.triangles.push_back({low[k], low[k + 1], high[k]});
      wall.triangles.push_back({low[k + 1], high[k + 1], high[k]});
    }
    if (!around) wall.outlines = {{low.front(), high.front()}, {low.back(), high.back()}};
  }

  std::vector<int> row(const Point3& centre, double r, const std::vector<Unit>& directions) {
    std::vector<int> points;
    for (const Unit& n : directions) points.push_back(point(moved(centre, r, n)));
    return points;
  }

  BlockPicture take() { return std::move(picture_); }

 private:
  BlockPicture picture_;
};

/// Triangulates the part of the sphere inside an outline, in rings towards the centre.
void paint_cap(Painter& painter, const Point3& x, double r, const std::vector<Unit>& rim, const Unit& centre,
               double step) {
  const int rings = std::max(2, static_cast<int>(std::ceil(1.6 / step / 2)));
  std::vector<std::vector<int>> rows;
  for (int k = 0; k < rings; ++k) {
    std::vector<Unit> ring;
    for (const Unit& n : rim) ring.push_back(between(n, centre, static_cast<double>(k) / rings));
    rows.push_back(painter.row(x, r, ring));
  }
  const int top = painter.point(moved(x, r, centre));
  BlockPatch& cap = painter.patch(Kind::sphere, true);
  for (int k = 0; k + 1 < rings; ++k) {
    const auto &low = rows[static_cast<std::size_t>(k)], &high = rows[static_cast<std::size_t>(k) + 1];
    for (std::size_t i = 0; i + 1 < low.size(); ++i) {
      cap.triangles.push_back({low[i], low[i + 1], high[i]});
      cap.triangles.push_back({low[i + 1], high[i + 1], high[i]});
    }
  }
  for (std::size_t i = 0; i + 1 < rows.back().size(); ++i)
    cap.triangles.push_back({rows.back()[i], rows.back()[i + 1], top});
  cap.outlines.push_back(rows.front());
}

Unit middle_of(const GaussMap& map) {
  Unit sum{};
  for (const Unit& u : map.corners) sum = {sum[0] + u[0], sum[1] + u[1], sum[2] + u[2]};
  const double length = std::sqrt(inner(sum, sum));
  if (length > 1e-9) return {sum[0] / length, sum[1] / length, sum[2] / length};
  const Unit &a = map.corners[0], &b = map.corners[1];  // half a sphere: the corners surround its centre
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void paint_vertex(Painter& painter, const GaussMap& map, const Point3& x, double r, double step) {
  if (map.dimension == 0) {
    for (const Unit& n : map.corners)
      painter.patch(Kind::end, true).outlines.push_back({painter.point(x), painter.point(moved(x, r, n))});
    return;
  }
  const std::vector<Unit> rim = outline(map, step);
  if (map.dimension == 1) {
    std::vector<int> sector = painter.row(x, r, rim);
    sector.push_back(painter.point(x));
    painter.polygon(Kind::end, true, sector);
    return;
  }
  paint_cap(painter, x, r, rim, middle_of(map), step);
  const std::size_t corners = map.corners.size();
  for (std::size_t k = 0; k < corners; ++k) {
    std::vector<Unit> arc;
    append_arc(arc, map.corners[k], map.corners[(k + 1) % corners], step);
    arc.push_back(map.corners[(k + 1) % corners]);
    std::vector<int> sector = painter.row(x, r, arc);
    sector.push_back(painter.point(x));
    painter.polygon(Kind::end, true, sector);
  }
}

void paint_edge(Painter& painter, const GaussMap& map, const Point3& a, const Point3& b, double r, double step) {
  const auto wall = [&](const Unit& n) {
    const std::vector<int> c{painter.point(a), painter.point(b), painter.point(moved(b, r, n)),
                             painter.point(moved(a, r, n))};
    painter.polygon(Kind::wall, true, c, {{c[0], c[1]}, {c[2], c[3]}});
  };
  if (map.dimension == 0) {
    for (const Unit& n : map.corners) wall(n);
    return;
  }
  const std::vector<Unit> arc = outline(map, step);
  painter.strip(Kind::sphere, true, painter.row(a, r, arc), painter.row(b, r, arc), map.closed);
  for (const Point3& end : {a, b}) {
    std::vector<int> sector = painter.row(end, r, arc);
    if (!map.closed) sector.push_back(painter.point(end));
    painter.polygon(Kind::end, false, sector);
  }
  if (map.closed) return;
  wall(arc.front());
  wall(arc.back());
}

void paint_triangle(Painter& painter, const GaussMap& map, const std::array<Point3, 3>& corners, double r) {
  std::array<std::vector<int>, 2> faces;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const Point3& x : corners) faces[side].push_back(painter.point(moved(x, r, map.corners[side])));
    painter.polygon(Kind::sphere, true, faces[side]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    painter.polygon(Kind::wall, false, {faces[0][k], faces[0][next], faces[1][next], faces[1][k]});
  }
}

}  // namespace

std::vector<Unit> outline(const GaussMap& map, double step) {
  std::vector<Unit> points;
  if (map.dimension < 1 || (map.dimension == 2 && map.closed)) return map.corners;
  const bool around = map.dimension == 2 || map.closed;
  const std::size_t arcs = around ? map.corners.size() : map.corners.size() - 1;
  for (std::size_t k = 0; k < arcs; ++k)
    append_arc(points, map.corners[k], map.corners[(k + 1) % map.corners.size()], step);
  points.push_back(around ? map.corners.front() : map.corners.back());
  return points;
}

BlockPicture block_picture(const Complex& mesh, Face face, float contact_radius, bool edge_only, double step) {
  Painter painter;
  const GaussMap map = gauss_map(mesh, face, edge_only);
  const auto v = mesh.vertices(face).items;
  const auto at = [&](std::size_t k) { return widened_point(mesh.at(v[k])); };
  const double r = contact_radius;
  if (map.dimension < 0 || (map.dimension == 2 && map.closed)) return painter.take();
  if (face.kind == FaceKind::vertex) paint_vertex(painter, map, at(0), r, step);
  if (face.kind == FaceKind::edge) paint_edge(painter, map, at(0), at(1), r, step);
  if (face.kind == FaceKind::triangle && map.corners.size() == 2)
    paint_triangle(painter, map, {at(0), at(1), at(2)}, r);
  return painter.take();
}

}  // namespace ogc::reference
