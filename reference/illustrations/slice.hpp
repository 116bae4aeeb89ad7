// The plane drawings of the paper as slices of surfaces: a polyline swept along z, cut where its middle row of vertices
// lies.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// A face of the polyline: vertex i, or the segment from i to i + 1.
struct SliceFace {
  bool segment = false;  ///< whether it is a segment
  int index = 0;         ///< i
  friend auto operator<=>(const SliceFace&, const SliceFace&) = default;
};

/// A polyline in the plane z = 0 with the surface that it sweeps; `extra` points follow as vertices of their own.
class Slice {
 public:
  /// A point of the plane [m].
  using Point2 = std::array<float, 2>;
  Slice(std::vector<Point2> polyline, std::span<const Point2> extra = {});

  /// The swept surface.
  Complex mesh() const { return {topology_, positions_}; }
  /// What was swept.
  const std::vector<Point2>& polyline() const { return polyline_; }
  /// of the polyline, in the plane
  Index vertex(int i) const { return middle_ + i; }
  /// The vertex that the i-th further point has become.
  Index extra(int i) const { return static_cast<Index>(positions_.size()) - extra_count_ + i; }
  /// what a face of the surface is in the plane
  SliceFace face_of(Face face) const;

  /// The faces of the polyline whose blocks hold the point, ascending: one for each layer.
  std::vector<SliceFace> layers(const Vec3f& x, float contact_radius) const;

 private:
  std::vector<Point2> polyline_;
  std::vector<Vec3f> positions_;
  compare::Topology topology_;
  Index middle_ = 0, extra_count_ = 0;
};

}  // namespace ogc::reference
