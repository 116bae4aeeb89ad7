#include "reference/geometry/separation.hpp"

#include <algorithm>
#include <cmath>

#include "reference/energies/closest_form.hpp"

namespace ogc::reference {
namespace {

using Points = std::array<Triple<double>, 4>;

/// The first `split` points are the first primitive.
class Slab {
 public:
  /// Differences of single-precision numbers carry one rounding, a projection a few more: 2⁻⁴⁸ of the largest coordinate covers each by far.
  Slab(const std::array<compare::Vec3f, 4>& x, std::size_t split, double distance) : split_(split) {
    double largest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      points_[k] = {double{x[k].x} - x[0].x, double{x[k].y} - x[0].y, double{x[k].z} - x[0].z};
      for (const double c : points_[k]) largest = std::max(largest, std::abs(c));
    }
    needed_ = distance * (1 + 0x1p-40) + 0x1p-45 * largest;
  }

  const Points& points() const { return points_; }

  /// Across this direction, from the second primitive to the first.
  bool is_wide(const Triple<double>& across) const {
    double low = dot(across, points_[0]), high = dot(across, points_[split_]);
    for (std::size_t k = 1; k < split_; ++k) low = std::min(low, dot(across, points_[k]));
    for (std::size_t k = split_ + 1; k < 4; ++k) high = std::max(high, dot(across, points_[k]));
    return low - high > needed_ * std::sqrt(dot(across, across));
  }

  bool is_wide_at(const ClosestForm& form) const { return is_wide(separation(form.weight, points_)); }

 private:
  std::size_t split_;
  Points points_;
  double needed_ = 0;
};

}  // namespace

bool surely_beyond_triangle(const std::array<compare::Vec3f, 4>& x, double distance) {
  const Slab slab(x, 1, distance);
  const Points& p = slab.points();
  return slab.is_wide(p[0] - (1.0 / 3) * (p[1] + p[2] + p[3])) || slab.is_wide_at(closest_form(compare::ContactSides::point_triangle, p));
}

bool surely_beyond_edge(const std::array<compare::Vec3f, 4>& x, double distance) {
  const Slab slab(x, 2, distance);
  const Points& p = slab.points();
  return slab.is_wide(p[0] + p[1] - p[2] - p[3]) || slab.is_wide_at(closest_edges(p));
}

}  // namespace ogc::reference
