// The surface extends along z by much more than any radius, so both ends of the surface are far from the plane z = 0.
#include "reference/illustrations/slice.hpp"

#include <algorithm>

namespace ogc::reference {

Slice::Slice(std::vector<Point2> polyline, std::span<const Point2> extra) : polyline_(std::move(polyline)) {
  constexpr float reach = 64;
  const auto n = static_cast<Index>(polyline_.size());
  middle_ = n;
  extra_count_ = static_cast<Index>(extra.size());
  for (const float z : {-reach, 0.0f, reach}) {
    for (const Point2& p : polyline_) positions_.push_back({p[0], p[1], z});
  }
  for (const Point2& p : extra) positions_.push_back({p[0], p[1], 0});
  std::vector<compare::Triangle> triangles;
  for (Index row = 0; row < 2; ++row) {
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = row * n + i;
      triangles.push_back({a, a + 1, a + n});
      triangles.push_back({a + 1, a + n + 1, a + n});
    }
  }
  topology_ = compare::build_topology(static_cast<Index>(positions_.size()), triangles);
}

SliceFace Slice::face_of(Face face) const {
  const auto vertices = mesh().vertices(face);
  const auto n = static_cast<Index>(polyline_.size());
  int low = n, high = 0;
  for (const Index v : vertices.span()) {
    low = std::min(low, static_cast<int>(v % n));
    high = std::max(high, static_cast<int>(v % n));
  }
  return {high > low, low};
}

std::vector<SliceFace> Slice::layers(const Vec3f& x, float contact_radius) const {
  std::vector<SliceFace> found;
  const auto ask = [&](FaceKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Face face{kind, static_cast<Index>(i)};
      if (in_block(mesh(), face, x, contact_radius)) found.push_back(face_of(face));
    }
  };
  ask(FaceKind::vertex, polyline_.size() * 3);
  ask(FaceKind::edge, topology_.edges.size());
  ask(FaceKind::triangle, topology_.triangles.size());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace ogc::reference
