// Computes the paper's plane drawings as slices of surfaces: sweeps a polyline along z and cuts the surface in the
// plane of its middle row of vertices.
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

/// A polyline in the plane z = 0 and the surface that it sweeps. `extra` points are separate vertices, numbered last.
class Slice {
 public:
  /// A point of the plane [m].
  using Point2 = std::array<float, 2>;
  Slice(std::vector<Point2> polyline, std::span<const Point2> extra = {});

  /// Returns the swept surface.
  Complex mesh() const { return {topology_, positions_}; }
  /// Returns the polyline.
  const std::vector<Point2>& polyline() const { return polyline_; }
  /// Returns the vertex at the polyline's i-th point, in the plane z = 0.
  Index vertex(int i) const { return middle_ + i; }
  /// Returns the vertex of the i-th extra point.
  Index extra(int i) const { return static_cast<Index>(positions_.size()) - extra_count_ + i; }
  /// Returns the vertex or segment of the polyline that sweeps this face.
  SliceFace face_of(Face face) const;

  /// Returns the faces of the polyline whose blocks hold the point, ascending. Their number is the number of layers
  /// (§3.3).
  std::vector<SliceFace> layers(const Vec3f& x, float contact_radius) const;

 private:
  std::vector<Point2> polyline_;
  std::vector<Vec3f> positions_;
  compare::Topology topology_;
  Index middle_ = 0, extra_count_ = 0;
};

}  // namespace ogc::reference
