#include "reference/solvers/feasible_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogc::reference {
namespace {

constexpr int slide_passes = 8;

}  // namespace

/// Reduces the bounds by the error of rounding to single precision. A coordinate is at most c = ‖X_prev‖_∞ + b_v.
/// Rounding moves the coordinate by at most 2⁻²⁴ c and so the point by at most √3 · 2⁻²⁴ c. A tiny coordinate moves by
/// at most the smallest positive single-precision number. A projection in double adds errors of 2⁻⁵⁰ of coordinates and
/// step.
FeasibleRegions::FeasibleRegions(const Detected& detected, compare::Bounds bounds)
    : centre_(widened(detected.previous)), planes_(centre_.size()), is_scaled_(!traits_of(bounds).slides) {
  const compare::BoundsTraits policy = traits_of(bounds);
  for (std::size_t v = 0; v < centre_.size(); ++v) {
    const Triple<double>& p = centre_[v];
    const double bound = double{detected.bound[v]},
                 size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) + bound;
    const double rounding = std::sqrt(3.0) * ((0x1p-24 + 0x1p-50) * size + 0x1p-149);
    radius_.push_back(std::max(0.0, (bound - rounding) * (1 - 0x1p-50)));
    if (policy.has_planes) add_planes(v, detected, rounding);
    if (!policy.certifies) radius_.back() = std::numeric_limits<double>::infinity();
  }
}

/// Adds the vertex's half-spaces and lowers their offsets by the rounding error. n is a unit vector up to 2⁻²³, and n·x
/// has an error of at most 2⁻⁵⁰ of its size. A vertex whose distance from a plane is smaller than these errors stays at
/// X_prev.
void FeasibleRegions::add_planes(std::size_t vertex, const Detected& detected, double rounding) {
  for (const compare::VertexPlane& plane : detected.planes.of(static_cast<compare::Index>(vertex))) {
    const Triple<double> normal{plane.normal.x, plane.normal.y, plane.normal.z};
    const double offset = plane.offset - (1 + 0x1p-20) * rounding - 0x1p-50 * std::abs(plane.offset);
    if (dot(normal, centre_[vertex]) > offset) radius_[vertex] = 0;
    planes_[vertex].push_back({normal, offset});
  }
}

bool FeasibleRegions::holds(std::size_t vertex, const Triple<double>& x) const {
  return length(x - centre_[vertex]) <= radius_[vertex] &&
         std::ranges::all_of(planes_[vertex],
                             [&](const HalfSpace& plane) { return dot(plane.normal, x) <= plane.offset; });
}

Triple<double> FeasibleRegions::into_ball(std::size_t vertex, const Triple<double>& x) const {
  const Triple<double> away = x - centre_[vertex];
  const double distance = length(away);
  return distance > radius_[vertex] ? centre_[vertex] + (radius_[vertex] / distance) * away : x;
}

FeasibleRegions::Inside FeasibleRegions::inside(std::size_t vertex, const Triple<double>& from, const Triple<double>& x,
                                                const Metric& metric) const {
  if (radius_[vertex] == 0 || planes_[vertex].empty()) {
    const bool cut = length(x - centre_[vertex]) > radius_[vertex];
    return {into_ball(vertex, x), cut};
  }
  if (holds(vertex, x)) return {x, false};
  if (is_scaled_) return scaled(vertex, centre_[vertex], x);
  Triple<double> y = x;
  for (int pass = 0; pass < slide_passes && !holds(vertex, y); ++pass) {
    for (const HalfSpace& plane : planes_[vertex]) {
      const double beyond = dot(plane.normal, y) - plane.offset;
      if (!(beyond > 0)) continue;
      const Triple<double> way = metric ? metric(plane.normal) : plane.normal;
      y = y - (beyond / dot(plane.normal, way) * (1 + 0x1p-40)) * way;
    }
    y = into_ball(vertex, y);
  }
  return holds(vertex, y) ? Inside{y, true} : scaled(vertex, from, y);
}

FeasibleRegions::Inside FeasibleRegions::inside_on_path(std::size_t vertex, const Triple<double>& from,
                                                        const Triple<double>& x) const {
  if (radius_[vertex] == 0 || planes_[vertex].empty()) return inside(vertex, from, x);
  return holds(vertex, x) ? Inside{x, false} : scaled(vertex, is_scaled_ ? centre_[vertex] : from, x);
}

FeasibleRegions::Inside FeasibleRegions::scaled(std::size_t vertex, const Triple<double>& from,
                                                const Triple<double>& x) const {
  const Triple<double> y = from + share_inside(vertex, from, x - from) * (x - from);
  return {holds(vertex, y) ? y : from, true};
}

double FeasibleRegions::share_inside(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const {
  double share = 1;
  for (const HalfSpace& plane : planes_[vertex]) {
    const double rise = dot(plane.normal, step), room = plane.offset - dot(plane.normal, x);
    if (rise > room) share = std::min(share, std::max(0.0, room / rise * (1 - 0x1p-40)));
  }
  if (!(length(x + step - centre_[vertex]) > radius_[vertex])) return share;
  // The equation ‖a + s b‖ = R with ‖a‖ ≤ R has one root s ≥ 0.
  const Triple<double> away = x - centre_[vertex];
  const double bb = dot(step, step), ab = dot(away, step), room = radius_[vertex] * radius_[vertex] - dot(away, away);
  if (room <= 0) return 0;
  return std::min(share, std::clamp((std::sqrt(ab * ab + bb * room) - ab) / bb * (1 - 0x1p-40), 0.0, 1.0));
}

}  // namespace ogc::reference
