#include "reference/ipc/additive_ccd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogc::reference {
namespace {

using Corners = std::array<Triple<double>, 4>;

double norm(const Triple<double>& a) { return std::sqrt(dot(a, a)); }

double largest_coordinate(const Corners& x) {
  double largest = 0;
  for (const Triple<double>& p : x)
    for (const double c : p) largest = std::max(largest, std::abs(c));
  return largest;
}

class Motion {
 public:
  /// Takes positions relative to the first vertex and displacements relative to their mean; this changes no distance.
  /// Let S be the largest relative coordinate plus the largest displacement. Errors:
  ///
  ///  - A coordinate at a time t ≤ 1: at most 4 · 2⁻⁵³ S, from a difference, a product, a rounded time and a sum.
  ///  - A projection on a unit vector, which has an error of 4 · 2⁻⁵³: about thirty roundings in all.
  ///  - The width of a slab, from two projections: below 2⁻⁴⁶ S.
  ///  - The product of a rate and a time of at most 1: below 2⁻⁴⁶ S.
  Motion(compare::ContactSides sides, const Corners& x, const Corners& delta)
      : sides_(sides), split_(sides == compare::ContactSides::edge_edge ? 2 : 1) {
    const Triple<double> mean = 0.25 * (delta[0] + delta[1] + delta[2] + delta[3]);
    for (std::size_t k = 0; k < 4; ++k) {
      start_[k] = x[k] - x[0];
      delta_[k] = delta[k] - mean;
    }
    error_ = 0x1p-45 * (largest_coordinate(start_) + largest_coordinate(delta_));
    double first = 0, second = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      double& side = k < split_ ? first : second;
      side = std::max(side, norm(delta_[k]));
    }
    approach_ = first + second;
  }

  double approach() const { return approach_; }  ///< ℓ [m]

  /// The widest known empty slab at time t.
  struct Slab {
    double width = 0;  ///< at most the distance; negative if no slab is known [m]
    Triple<double> normal{};
    Corners x{};
  };
  Slab slab(double t) const {
    Slab slab;
    for (std::size_t k = 0; k < 4; ++k) slab.x[k] = start_[k] + t * delta_[k];
    const ClosestForm form = sides_ == compare::ContactSides::edge_edge ? closest_edges(slab.x)
                                                                        : closest_form(sides_, slab.x);
    const Triple<double> apart = separation(form.weight, slab.x);
    slab.width = -1;
    widen(slab, apart);
    // Rounding tilts the connection `apart` by up to 2⁻⁵³ S divided by the gap (S: see the constructor). Normals of
    // lines and planes are more precise.
    if (slab.width < 0.9 * norm(apart)) widen(slab, normal_of(form, slab.x, apart));
    return slab;
  }

  /// Returns how long the slab stays wider than `thickness`; 0 if it is not wider now.
  double empty_for(const Slab& slab, double thickness) const {
    if (!(slab.width > thickness)) return 0;
    double time = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < split_; ++i)
      for (std::size_t j = split_; j < 4; ++j) {
        const double closing = dot(slab.normal, delta_[j]) - dot(slab.normal, delta_[i]);
        const double room = dot(slab.normal, slab.x[i]) - dot(slab.normal, slab.x[j]) - thickness - error_;
        if (closing > 0) time = std::min(time, std::max(room, 0.0) / closing);
      }
    return time;
  }

 private:
  /// Replaces the slab by the slab perpendicular to `normal` if the latter is wider.
  void widen(Slab& slab, const Triple<double>& normal) const {
    const double size = norm(normal);
    if (!(size > 0)) return;
    const Triple<double> unit = (1 / size) * normal;
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < split_; ++i)
      for (std::size_t j = split_; j < 4; ++j) width = std::min(width, dot(unit, slab.x[i]) - dot(unit, slab.x[j]));
    width -= error_;
    if (width > slab.width) slab.width = width, slab.normal = unit;
  }

  /// Returns a slab's normal (not a unit vector), in the direction of `apart`:
  ///
  ///  - two points: `apart`,
  ///  - a point and a line: the component of `apart` perpendicular to the line,
  ///  - a point and a plane, or two lines: the normal of the plane or of both lines.
  static Triple<double> normal_of(const ClosestForm& form, const Corners& x, const Triple<double>& apart) {
    const auto at = [&](std::size_t place) { return x[form.at[place]]; };
    if (form.kind == FormKind::points) return apart;
    if (form.kind == FormKind::point_line) {
      const Triple<double> edge = at(2) - at(1);
      return apart - (dot(apart, edge) / dot(edge, edge)) * edge;
    }
    const Triple<double> normal = form.kind == FormKind::point_plane ? cross(at(2) - at(1), at(3) - at(1))
                                                                     : cross(at(1) - at(0), at(3) - at(2));
    return dot(normal, apart) < 0 ? -1.0 * normal : normal;
  }

  compare::ContactSides sides_;
  std::size_t split_;  ///< number of vertices of the first side
  Corners start_, delta_;
  double error_ = 0, approach_ = 0;
};

}  // namespace

double additive_ccd(compare::ContactSides sides, const Corners& x, const Corners& delta, double thickness, double until,
                    int most_steps) {
  const Motion motion(sides, x, delta);
  Motion::Slab slab = motion.slab(0);
  const double first_gap = slab.width - thickness;
  if (!(first_gap > 0)) return 0;
  if (motion.approach() == 0) return until;
  double time = 0;
  for (int step = 0; step < most_steps; ++step) {
    const double safe = std::max((slab.width - thickness) / motion.approach(), motion.empty_for(slab, thickness));
    const double next = time + ccd_rescaling * safe;
    if (next >= until) return until;
    if (!(next > time)) return time;
    slab = motion.slab(next);
    if (time > 0 && slab.width - thickness < ccd_gap_left * first_gap) return time;
    time = next;
  }
  return time;
}

}  // namespace ogc::reference
