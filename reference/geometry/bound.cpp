// The product of two single-precision numbers fits a double, so rounding it down once is exact.
#include "reference/geometry/bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogc::reference {

float product_below(float a, float b) {
  const double exact = static_cast<double>(a) * b;
  const float f = static_cast<float>(exact);
  return static_cast<double>(f) > exact ? std::nextafter(f, 0.0f) : f;
}

compare::BoundTruth bound(const compare::BoundIn& in) {
  compare::BoundTruth truth;
  truth.exact.bound.reserve(in.d_min_vertex.size());
  for (std::size_t v = 0; v < in.d_min_vertex.size(); ++v) {
    if (!in.topology->on_surface(static_cast<compare::Index>(v))) {
      truth.exact.bound.push_back(std::numeric_limits<float>::max());
      continue;
    }
    float smallest = in.d_min_vertex[v];
    for (const compare::Index e : in.topology->vertex_edges[v]) smallest = std::min(smallest, in.d_min_edge[e]);
    for (const compare::Index t : in.topology->vertex_triangles[v]) smallest = std::min(smallest, in.d_min_triangle[t]);
    truth.exact.bound.push_back(product_below(in.bounds_relaxation, smallest));
  }
  return truth;
}

}  // namespace ogc::reference
