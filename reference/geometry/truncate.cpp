// A vertex is cut by its ball if d² − b² > 0 for the distance d of the proposal from X_prev; the sign is exact. The
// scaled position is computed in long double; as nothing cancels, its rounded value is right.
//
// Decides exactly which half-spaces a proposal violates. Positions are in long double: the three products of
// single-precision numbers in n·x are exact there, and the two sums lose 2⁻⁶⁴ of their moduli.
//
// A free vertex slides along w = H⁻¹n to a half-space that it violates. A right answer is off the exact position by at
// most the sum of three errors (u = 2⁻²⁴, ε = u truncate_solve_tolerance); twice the sum is accepted:
//
//   s   storing, and steps that bring the stored position back inside: truncate_region_tolerance u (‖X_prev‖_∞ + b)
//   a   the standoff from a half-space: truncate_standoff u Σ|n_k x_k| along n, so ‖w‖/(n·w) times that along w
//   k   the solve for w, with a backward error ε ‖H‖: ‖δw‖ ≤ ε κ/(1 − ε κ) ‖w‖, κ = ‖H‖ ‖H⁻¹‖. It moves the point
//       where w meets the half-space by at most (1 + ‖n‖ ‖w‖/(n·w)) ‖δw‖/‖w‖ times the length of the slide
//
// If the point is then scaled into the ball, a and k are multiplied by the quotient of b and the point's smallest
// possible distance from X_prev.
#include "reference/geometry/truncate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "reference/geometry/margin.hpp"
#include "reference/geometry/plane.hpp"

namespace ogc::reference {
namespace {

compare::Vec3 scaled_back(const Vec3f& from, const Vec3f& to, float length) {
  const long double dx = static_cast<long double>(to.x) - from.x, dy = static_cast<long double>(to.y) - from.y,
                    dz = static_cast<long double>(to.z) - from.z;
  const long double scale = length / std::sqrt(dx * dx + dy * dy + dz * dz);
  return {static_cast<double>(from.x + scale * dx), static_cast<double>(from.y + scale * dy),
          static_cast<double>(from.z + scale * dz)};
}

struct RegionTruth {
  bool cut = false, grey = false, near = false;
  compare::Vec3 position;
  double accepted = 0;  ///< [m]
};

using compare::HalfSpace;
using Long = long double;
using Point = std::array<Long, 3>;

constexpr double u = compare::unit_roundoff, infinity = std::numeric_limits<double>::infinity();

Point wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
Point plus(const Point& a, Long s, const Point& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
Long inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return static_cast<double>(std::sqrt(inner(a, a))); }

/// Returns Σ|n_k x_k|.
double size_at(const HalfSpace& h, const Point& x) {
  const Point n = wide(h.normal);
  return static_cast<double>(std::abs(n[0] * x[0]) + std::abs(n[1] * x[1]) + std::abs(n[2] * x[2]));
}
Long excess_at(const HalfSpace& h, const Point& x) { return inner(wide(h.normal), x) - Long{h.offset}; }
double standoff(const HalfSpace& h, const Point& x) { return compare::truncate_standoff * u * size_at(h, x); }

/// The direction H⁻¹n, and the limit of its relative error ‖δw‖/‖w‖.
struct Way {
  Point w{};
  double relative_error = infinity;
};

/// Solves H w = n for w by cofactors. Uses Frobenius norms for the condition number, which is at most three times the
/// condition number in ‖·‖₂.
Way way_out(const std::array<float, 6>& block, const Vec3f& normal) {
  const auto [xx, xy, xz, yy, yz, zz] = std::array<Long, 6>{block[0], block[1], block[2], block[3], block[4], block[5]};
  const std::array<Long, 6> cofactor{yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
                                     xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  const auto frobenius = [](const std::array<Long, 6>& a) {
    return std::sqrt(a[0] * a[0] + a[3] * a[3] + a[5] * a[5] + 2 * (a[1] * a[1] + a[2] * a[2] + a[4] * a[4]));
  };
  const Long determinant = xx * cofactor[0] + xy * cofactor[1] + xz * cofactor[2];
  if (!(determinant > 0)) return {};
  const Long condition = frobenius({xx, xy, xz, yy, yz, zz}) * frobenius(cofactor) / determinant;
  const double backward = u * compare::truncate_solve_tolerance * static_cast<double>(condition);
  if (!(backward < 0.5)) return {};
  const Point n = wide(normal);
  Way way{{}, backward / (1 - backward)};
  const std::array<Point, 3> rows{Point{cofactor[0], cofactor[1], cofactor[2]},
                                  Point{cofactor[1], cofactor[3], cofactor[4]},
                                  Point{cofactor[2], cofactor[4], cofactor[5]}};
  for (std::size_t k = 0; k < 3; ++k) way.w[k] = inner(rows[k], n) / determinant;
  return way;
}

class RegionCheck {
 public:
  RegionCheck(const compare::TruncateIn& in, std::size_t i, const MarginAnswer& ball)
      : half_spaces_(in.half_spaces.of(i)),
        centre_(wide(in.previous[i])),
        current_(wide(in.half_spaces.current[i])),
        proposal_(wide(in.position[i])),
        bound_(double{in.bound[i]}),
        stored_(
            compare::truncate_region_tolerance * u *
            (std::max({std::abs(in.previous[i].x), std::abs(in.previous[i].y), std::abs(in.previous[i].z)}) + bound_)) {
    decide(in.position[i], ball);
    truth_.position = narrow(proposal_);
    if (truth_.grey)
      truth_.accepted = infinity;
    else if (truth_.cut && in.half_spaces.is_prescribed[i] != 0)
      along_path();
    else if (truth_.cut)
      slide(in.half_spaces.block[i]);
  }

  const RegionTruth& truth() const { return truth_; }

 private:
  static compare::Vec3 narrow(const Point& x) {
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
  }

  void decide(const Vec3f& x, const MarginAnswer& ball) {
    bool certain = ball.sign > 0 && !ball.grey;
    truth_.cut = ball.sign > 0;
    truth_.grey = ball.grey;
    truth_.near = ball.near;
    for (const HalfSpace& h : half_spaces_) {
      const int sign = compared({h.normal, x, 0}, {{}, {}, h.offset});
      const double size = size_at(h, proposal_), margin = std::abs(static_cast<double>(excess_at(h, proposal_)));
      const bool is_grey = margin <= compare::half_space_slack * (size + std::abs(h.offset));
      truth_.cut = truth_.cut || sign > 0;
      truth_.grey = truth_.grey || is_grey;
      truth_.near = truth_.near || margin <= compare::near_factor * size;
      certain = certain || (sign > 0 && !is_grey);
    }
    truth_.grey = truth_.grey && !certain;
  }

  /// Accepts any position of the region; the current position is one of them.
  void leave_free() {
    truth_.position = narrow(current_);
    truth_.accepted = infinity;
  }

  /// Finds the largest share of the step that every half-space and the ball allow. `least` is the smallest share that
  /// is accepted: an answer may keep the largest permitted distance from the half-spaces and from the ball's surface.
  void along_path() {
    const Point step = plus(proposal_, -1, current_);
    const double whole = length(step);
    double share = 1, least = 1;
    const auto allow = [&](double until, double kept_away) {
      share = std::min(share, until);
      least = std::min(least, until - kept_away / whole);
    };
    for (const HalfSpace& h : half_spaces_) {
      const double rise = static_cast<double>(inner(wide(h.normal), step));
      if (!(rise > 0)) continue;
      const double norm = length(wide(h.normal)), cosine = rise / (norm * whole);
      allow(std::max(0.0, static_cast<double>(-excess_at(h, current_)) / rise),
            (stored_ + std::max(standoff(h, current_), standoff(h, proposal_)) / norm) / cosine);
    }
    const Point away = plus(current_, -1, centre_);
    const Long bb = inner(step, step), ab = inner(away, step), left = Long{bound_} * bound_ - inner(away, away);
    if (ab + ab + bb > left) {
      const Long root = std::sqrt(std::max(Long{0}, ab * ab + bb * left));
      const double until = static_cast<double>(std::max(Long{0}, (root - ab) / bb));
      allow(until, root > 0 ? stored_ * static_cast<double>(std::sqrt(bb) * bound_ / root) : infinity);
    }
    const Point end = plus(current_, Long{share}, step);
    if (beside(end, step) > 1) least = 0;
    truth_.position = narrow(end);
    truth_.accepted = (share - std::max(0.0, least)) * whole + stored_;
  }

  /// Counts the half-spaces that the step does not approach, but that the rounded end of the step may violate. If there
  /// is only one, a small step away from it brings the end inside. If there are several, there may be no position near
  /// the end that is inside all of them.
  std::ptrdiff_t beside(const Point& end, const Point& step) const {
    return std::ranges::count_if(half_spaces_, [&](const HalfSpace& h) {
      const Point n = wide(h.normal);
      return !(inner(n, step) > 0) && excess_at(h, end) > -Long{stored_ * length(n) + standoff(h, end)};
    });
  }

  /// Returns the half-space that the proposal certainly violates, if the proposal certainly keeps all other
  /// half-spaces, however a kernel rounds. Otherwise returns null. Sets `is_ball` to whether the proposal certainly
  /// keeps all half-spaces, so that only the ball can cut it.
  const HalfSpace* only_violated(bool& is_ball) const {
    const HalfSpace* only = nullptr;
    int count = 0;
    for (const HalfSpace& h : half_spaces_) {
      if (excess_at(h, proposal_) <= -Long{standoff(h, proposal_)}) continue;
      ++count;
      if (excess_at(h, proposal_) > Long{standoff(h, proposal_)}) only = &h;
    }
    is_ball = count == 0;
    return count == 1 ? only : nullptr;
  }

  void slide(const std::array<float, 6>& block) {
    bool is_ball = false;
    const HalfSpace* plane = only_violated(is_ball);
    if (is_ball) return into_ball(proposal_, 0, nullptr);
    if (plane == nullptr) return leave_free();
    const Way way = way_out(block, plane->normal);
    const Point n = wide(plane->normal);
    const double across = static_cast<double>(inner(n, way.w));
    if (!(way.relative_error < 0.5) || !(across > 0)) return leave_free();
    const Point landed = plus(proposal_, -excess_at(*plane, proposal_) / inner(n, way.w), way.w);
    const double stretch = length(way.w) / across;
    const double solved = length(plus(landed, -1, proposal_)) * way.relative_error * (1 + length(n) * stretch);
    into_ball(landed, solved + standoff(*plane, landed) * stretch, plane);
  }

  /// Moves the end of the slide into the ball and sets the accepted error. Accepts any position of the region if
  /// another half-space may be violated, or if the error is large relative to the bound.
  void into_ball(const Point& landed, double error, const HalfSpace* along) {
    const Point away = plus(landed, -1, centre_);
    const double distance = length(away);
    const bool is_outside = distance > bound_;
    if (error > 0.25 * std::max(distance, bound_)) return leave_free();
    const Point end = is_outside ? plus(centre_, Long{bound_} / Long{distance}, away) : landed;
    const double whole = error * (is_outside ? bound_ / (distance - error) : 1) + stored_;
    const auto interferes = [this](const HalfSpace& h, const Point& at, double off) {
      return excess_at(h, at) > -Long{off * length(wide(h.normal)) + standoff(h, at)};
    };
    for (const HalfSpace& h : half_spaces_)
      if (&h != along && (interferes(h, landed, error + stored_) || interferes(h, end, whole))) return leave_free();
    truth_.position = narrow(end);
    truth_.accepted = 2 * whole;
  }

  std::span<const HalfSpace> half_spaces_;
  Point centre_, current_, proposal_;
  double bound_, stored_;
  RegionTruth truth_;
};

/// Returns the truth of case i, which has half-spaces. `ball` is the margin d² − b², where d is the distance of the
/// proposal from X_prev.
RegionTruth truncate_region(const compare::TruncateIn& in, std::size_t i, const MarginAnswer& ball) {
  return RegionCheck(in, i, ball).truth();
}

}  // namespace

compare::TruncateTruth truncate(const compare::TruncateIn& in) {
  compare::TruncateTruth truth;
  for (std::size_t i = 0; i < in.position.size(); ++i) {
    const Vec3f &from = in.previous[i], &to = in.position[i];
    const Margin gap = gap_points(from, to, in.bound[i]);
    const MarginAnswer margin = examine(gap);
    if (!in.half_spaces.offsets.empty()) truth.accepted.push_back(0);
    if (!in.half_spaces.of(i).empty()) {
      const RegionTruth region = truncate_region(in, i, margin);
      truth.cut.push_back(region.cut);
      truth.grey.push_back(region.grey);
      truth.near.push_back(region.near);
      truth.position.push_back(region.position);
      truth.accepted.back() = region.accepted;
      continue;
    }
    const bool cut = margin.sign > 0;
    truth.cut.push_back(cut);
    truth.grey.push_back(margin.grey);
    truth.near.push_back(margin.near);
    truth.position.push_back(cut ? scaled_back(from, to, in.bound[i]) : compare::Vec3{to.x, to.y, to.z});
  }
  return truth;
}

compare::Vec3f stored_within(const compare::Vec3& position, const compare::Vec3f& previous, float bound) {
  compare::Vec3f x{static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z)};
  while (sign(gap_points(previous, x, bound)) > 0)
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

compare::Vec3f stored_in_region(const compare::Vec3& position, const compare::TruncateIn& in, std::size_t i) {
  constexpr int attempts = 4;  // each attempt moves away from the half-spaces by as much as storing may move the point
  const auto half_spaces = in.half_spaces.of(i);
  const auto is_kept = [](const compare::HalfSpace& h, const Vec3f& x) { return keeps({{}, h.normal, h.offset}, x); };
  compare::Vec3 y = position;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Vec3f x = stored_within(y, in.previous[i], in.bound[i]);
    if (std::ranges::all_of(half_spaces, [&](const compare::HalfSpace& h) { return is_kept(h, x); })) return x;
    for (const compare::HalfSpace& h : half_spaces) {
      if (is_kept(h, x)) continue;
      const double nx = h.normal.x, ny = h.normal.y, nz = h.normal.z;
      const double back = compare::unit_roundoff * (std::abs(nx * x.x) + std::abs(ny * x.y) + std::abs(nz * x.z)) /
                          (nx * nx + ny * ny + nz * nz);
      y = {y.x - back * nx, y.y - back * ny, y.z - back * nz};
    }
  }
  return in.half_spaces.current[i];
}

}  // namespace ogc::reference
