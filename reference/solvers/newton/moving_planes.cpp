#include "reference/solvers/newton/moving_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogc::reference {
namespace {

/// Most sweeps of `truncated`. A sweep moves apart the sides of pairs that would come too near.
constexpr int most_sweeps = 64;
/// Most rounds that scale the steps of single vertices. If they are not enough, one scale is used for all vertices.
constexpr int most_scalings = 16;
/// Sides that come too near are moved apart to the least separation plus this share of (gap − least separation).
/// Without the addition the sweeps might not end.
constexpr double given_back = 0x1p-6;
/// Error of a computed separation, divided by the largest modulus of a coordinate. A height n·x in double has three
/// rounding errors of 2⁻⁵³ (a product, two sums) of Σ|n_k x_k|, which is at most √3 times this modulus. The difference
/// of two heights has one more of itself: 2√3 (3 + 1) 2⁻⁵³ < 14 · 2⁻⁵³ in all, rounded up to a power of two.
constexpr double height_noise = 0x1p-49;

double largest(const Triple<double>& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }
/// Returns how far rounding to single precision moves a point with coordinates up to `size` [m] (as in
/// FeasibleRegions).
double rounding_of(double size) { return std::sqrt(3.0) * ((0x1p-24 + 0x1p-50) * size + 0x1p-149); }

}  // namespace

template <class At>
double MovingPlanes::separation(const Pair& pair, At at) {
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (std::size_t k = 0; k < pair.vertices.size(); ++k) {
    const double height = dot(pair.normal, at(pair.vertices[k]));
    if (k < pair.second_from)
      top = std::max(top, height);
    else
      bottom = std::min(bottom, height);
  }
  return bottom - top;
}

MovingPlanes::MovingPlanes(const std::vector<NearPair>& pairs, const std::vector<compare::Vec3f>& previous,
                           const std::vector<Mobility>& mobility, double query_radius, double relaxation)
    : centre_(widened(previous)), ball_(relaxation * query_radius), radius_(previous.size(), 0), mobility_(mobility) {
  for (std::size_t v = 0; v < centre_.size(); ++v)
    if (mobility_[v] != Mobility::fixed)
      radius_[v] = std::max(0.0, (ball_ - rounding_of(largest(centre_[v]) + ball_)) * (1 - 0x1p-50));
  pairs_.reserve(pairs.size());
  for (const NearPair& near : pairs) {
    Pair pair{{}, near.second_from, widened(near.normal), 0, 0};
    double size = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      pair.vertices[k] = static_cast<std::size_t>(near.vertices[k]);
      size = std::max(size, largest(centre_[pair.vertices[k]]) + radius_[pair.vertices[k]]);
    }
    // By how much the separation of x must exceed that of its stored value:
    //   - the difference between x and its stored value, on both sides of the pair; n is a unit vector up to 2⁻²²
    //   - the errors of both computed separations, and as much again, which kept_by requires
    const double noise = 2 * (1 + 0x1p-20) * rounding_of(size) + 3 * height_noise * size;
    pair.gap = separation(pair, [&](std::size_t v) { return centre_[v]; });
    pair.least = (1 - 2 * relaxation) * pair.gap + noise;
    if (pair.gap - pair.least > noise)
      pairs_.push_back(pair);
    else
      for (const std::size_t v : pair.vertices) radius_[v] = 0;
  }
  first_of_.assign(centre_.size() + 1, 0);
  for (const Pair& pair : pairs_)
    for (const std::size_t v : pair.vertices) ++first_of_[v + 1];
  for (std::size_t v = 0; v < centre_.size(); ++v) first_of_[v + 1] += first_of_[v];
  of_vertex_.resize(first_of_.back());
  std::vector<std::uint32_t> next(first_of_.begin(), first_of_.end() - 1);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    for (const std::size_t v : pairs_[i].vertices) of_vertex_[next[v]++] = static_cast<std::uint32_t>(i);
}

void MovingPlanes::enter(State& x) const {
  for (std::size_t v = 0; v < x.size(); ++v)
    if (stays(v)) x[v] = centre_[v];
}

/// Returns the largest share of `step` that stays in the vertex's ball (Eq. 27): the root s ≥ 0 of ‖a + s b‖ = R, which
/// is unique for ‖a‖ ≤ R.
double MovingPlanes::share_in_ball(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const {
  const Triple<double> away = x - centre_[vertex];
  if (!(length(away + step) > radius_[vertex])) return 1;
  const double bb = dot(step, step), ab = dot(away, step), room = radius_[vertex] * radius_[vertex] - dot(away, away);
  if (!(room > 0)) return 0;
  return std::clamp((std::sqrt(ab * ab + bb * room) - ab) / bb * (1 - 0x1p-40), 0.0, 1.0);
}

/// Returns the pairs whose sides would come too near if both sides moved straight towards each other, each by twice its
/// largest step.
std::vector<std::uint32_t> MovingPlanes::endangered(const State& x, const State& step) const {
  std::vector<double> reach(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) reach[v] = length(step[v]);
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    double first = 0, second = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      double& side = k < pair.second_from ? first : second;
      side = std::max(side, reach[pair.vertices[k]]);
    }
    if (separation(pair, [&](std::size_t v) { return x[v]; }) - 2 * (first + second) < pair.least)
      found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

bool MovingPlanes::move_apart(const Pair& pair, const State& x, State& step) const {
  bool moved = false;
  for (std::size_t k = 0; k < pair.second_from; ++k)
    for (std::size_t l = pair.second_from; l < 4; ++l) {
      const std::size_t a = pair.vertices[k], b = pair.vertices[l];
      const double apart = dot(pair.normal, x[b] + step[b]) - dot(pair.normal, x[a] + step[a]);
      if (apart >= pair.least) continue;
      const double missing = pair.least + given_back * (pair.gap - pair.least) - apart,
                   parts = (yields(a) ? 1 : 0) + (yields(b) ? 1 : 0);
      if (parts == 0) continue;
      if (yields(a)) step[a] = step[a] - (missing / parts) * pair.normal;
      if (yields(b)) step[b] = step[b] + (missing / parts) * pair.normal;
      moved = true;
    }
  return moved;
}

bool MovingPlanes::shares(const State& x, const State& step, std::vector<double>& share) const {
  bool all = true;
  for (std::size_t v = 0; v < x.size(); ++v) {
    share[v] = share_in_ball(v, x[v], step[v]);
    all = all && share[v] == 1;
  }
  for (const Pair& pair : pairs_) {
    const double after = separation(pair, [&](std::size_t v) { return x[v] + step[v]; });
    if (after >= pair.least) continue;
    // The separation is a concave function of the share. So it is at least the linear interpolation between the shares
    // 0 and 1.
    const double before = separation(pair, [&](std::size_t v) { return x[v]; }),
                 left = std::max(0.0, (before - pair.least) / (before - after)) * (1 - 0x1p-40);
    for (const std::size_t v : pair.vertices) share[v] = std::min(share[v], left);
    all = false;
  }
  return all;
}

double MovingPlanes::share_inside(const State& x, const State& step) const {
  std::vector<double> share(x.size());
  if (shares(x, step, share)) return 1;
  return *std::ranges::min_element(share);
}

double MovingPlanes::share_inside(const State& x, std::size_t vertex, const Triple<double>& step) const {
  double share = share_in_ball(vertex, x[vertex], step);
  for (std::uint32_t i = first_of_[vertex]; i < first_of_[vertex + 1]; ++i) {
    const Pair& pair = pairs_[of_vertex_[i]];
    const double before = separation(pair, [&](std::size_t v) { return x[v]; }),
                 after = separation(pair, [&](std::size_t v) { return v == vertex ? x[v] + step : x[v]; });
    if (after < pair.least)
      share = std::min(share, std::max(0.0, (before - pair.least) / (before - after)) * (1 - 0x1p-40));
  }
  return share;
}

State MovingPlanes::truncated(const State& x, State step) const {
  for (std::size_t v = 0; v < x.size(); ++v) step[v] = share_in_ball(v, x[v], step[v]) * step[v];
  const std::vector<std::uint32_t> near = endangered(x, step);
  bool moved = true;
  for (int sweep = 0; sweep < most_sweeps && moved; ++sweep) {
    moved = false;
    for (const std::uint32_t i : near) moved |= move_apart(pairs_[i], x, step);
  }
  std::vector<double> share(x.size());
  for (int round = 0; round < most_scalings; ++round) {
    if (shares(x, step, share)) return step;
    for (std::size_t v = 0; v < x.size(); ++v) step[v] = share[v] * step[v];
  }
  const double left = share_inside(x, step);
  for (Triple<double>& s : step) s = left * s;
  return step;
}

bool MovingPlanes::kept_by(const std::vector<compare::Vec3f>& stored) const {
  for (std::size_t v = 0; v < stored.size(); ++v) {
    const double moved = length(widened(stored[v]) - centre_[v]);
    if (stays(v) ? moved != 0 : !(moved * (1 + 0x1p-50) <= ball_)) return false;
  }
  return std::ranges::all_of(pairs_, [&](const Pair& pair) {
    double size = 0;
    for (const std::size_t v : pair.vertices) size = std::max(size, largest(widened(stored[v])));
    return separation(pair, [&](std::size_t v) { return widened(stored[v]); }) > height_noise * size;
  });
}

}  // namespace ogc::reference
