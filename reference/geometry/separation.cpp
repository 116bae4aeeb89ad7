// Implements Gilbert's iteration. The vector w is the difference of a point of the first primitive and a point of the
// second. Two planes perpendicular to w, through one vertex of each primitive, bound the widest slab between the
// primitives. Each step moves w towards the difference of these two vertices, as long as ‖w‖ falls. So w converges to
// the shortest difference; most pairs are separated in the first step.
#include "reference/geometry/separation.hpp"

#include <algorithm>
#include <cmath>

#include "reference/geometry/formulas.hpp"

namespace ogc::reference {
namespace {

constexpr int most_steps = 8;

/// Tests two primitives; the first `split` points belong to the first one.
template <std::size_t split>
bool surely_beyond(const std::array<compare::Vec3f, 4>& x, double distance) {
  std::array<Point<double>, 4> p;
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = {double{x[k].x} - x[0].x, double{x[k].y} - x[0].y, double{x[k].z} - x[0].z};
    largest = std::max({largest, std::abs(p[k].x), std::abs(p[k].y), std::abs(p[k].z)});
  }
  // Each difference of single-precision numbers has one rounding, each projection has a few more; 2⁻⁴⁵ of the largest
  // coordinate is far above all of them.
  const double needed = distance * (1 + 0x1p-40) + 0x1p-45 * largest;
  Point<double> w = p[0] - p[split];
  for (int step = 0; step < most_steps; ++step) {
    const double size = dot(w, w);
    if (!(size > needed * needed)) return false;
    std::size_t low = 0, high = split;
    std::array<double, 4> height;
    for (std::size_t k = 0; k < 4; ++k) height[k] = dot(w, p[k]);
    for (std::size_t k = 1; k < split; ++k) low = height[k] < height[low] ? k : low;
    for (std::size_t k = split + 1; k < 4; ++k) high = height[k] > height[high] ? k : high;
    if (height[low] - height[high] > needed * std::sqrt(size)) return true;
    const Point<double> way = p[low] - p[high] - w;
    const double length = dot(way, way);
    if (!(length > 0)) return false;
    const double share = std::clamp(-dot(w, way) / length, 0.0, 1.0);
    w = {w.x + share * way.x, w.y + share * way.y, w.z + share * way.z};
  }
  return false;
}

}  // namespace

bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance) {
  return surely_beyond<1>(x, distance);
}
bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance) {
  return surely_beyond<2>(x, distance);
}

}  // namespace ogc::reference
