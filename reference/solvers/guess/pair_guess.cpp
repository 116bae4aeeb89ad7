// Heights n·x are sums of three exact products in long double: 2⁻⁶² of their moduli at most is lost, so that what holds
// beyond 2⁻⁵⁸ of these holds exactly.
#include "reference/solvers/guess/pair_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using compare::PairGuessIn;
using compare::PairGuessOut;
using compare::PairGuessTruth;
using compare::PrimitivePair;
using compare::Vec3;
using compare::Vec3f;
using Long = long double;
using Positions = std::vector<Vec3f>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 difference(const Vec3f& a, const Vec3f& b) { return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}; }
double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// A gap of both sides along n, and the sum of the moduli of its terms.
struct Gap {
  Long value = 0, size = 0;
};

Gap gap_of(const NearPair& pair, const Positions& x) {
  Long top = -std::numeric_limits<Long>::infinity(), bottom = -top;
  Gap gap;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3f &n = pair.normal, &p = x[at(pair.vertices[k])];
    const Long a = Long{n.x} * p.x, b = Long{n.y} * p.y, c = Long{n.z} * p.z, height = a + b + c;
    if (k < pair.second_from)
      top = std::max(top, height);
    else
      bottom = std::min(bottom, height);
    gap.size += std::abs(a) + std::abs(b) + std::abs(c);
  }
  gap.value = bottom - top;
  return gap;
}

/// The largest difference between moves of the two sides [m].
double largest_difference(const NearPair& pair, const Positions& from, const Positions& to) {
  double largest = 0;
  for (std::size_t i = 0; i < pair.second_from; ++i)
    for (std::size_t j = pair.second_from; j < 4; ++j) {
      const std::size_t v = at(pair.vertices[i]), w = at(pair.vertices[j]);
      const Vec3 a = difference(to[v], from[v]), b = difference(to[w], from[w]);
      largest = std::max(largest, length({a.x - b.x, a.y - b.y, a.z - b.z}));
    }
  return largest;
}

bool is_fixed(const PairGuessIn& in, std::size_t v) { return in.exclusions.groups[v] == 0; }

/// The diagonal of the box of all moves and 0, rounded up: no two moves, or shares of moves, differ by more.
double span_of(const PairGuessIn& in, const Positions& to) {
  std::array<double, 6> box{};
  for (std::size_t v = 0; v < to.size(); ++v) {
    if (!in.topology->on_surface(static_cast<Index>(v))) continue;
    const Vec3 w = difference(to[v], in.previous[v]);
    box = {std::min(box[0], w.x), std::max(box[1], w.x), std::min(box[2], w.y),
           std::max(box[3], w.y), std::min(box[4], w.z), std::max(box[5], w.z)};
  }
  return length({box[1] - box[0], box[3] - box[2], box[5] - box[4]}) * (1 + 0x1p-40);
}

/// All pairs nearer than `reach` at X.
std::vector<NearPair> pairs_within(const PairGuessIn& in, double reach) {
  if (!(reach > 0)) return {};
  std::vector<std::uint8_t> fixed;
  for (std::size_t v = 0; v < in.previous.size(); ++v) fixed.push_back(is_fixed(in, v) ? 1 : 0);
  const float radius = std::nextafter(static_cast<float>(reach), std::numeric_limits<float>::infinity());
  std::vector<NearPair> pairs = near_pairs_with_planes(
      {in.topology, in.exclusions, in.previous, fixed, radius, in.bound_relaxation});
  std::erase_if(pairs, [&](const NearPair& pair) {
    return pair.pair.kind == PrimitivePair::Kind::vertex_triangle && !in.topology->on_surface(pair.vertices[0]);
  });
  return pairs;
}

/// x + s (y − x), rounded.
Vec3f part_of_way(const Vec3f& x, const Vec3f& y, double s) {
  const Vec3 w = difference(y, x);
  return {static_cast<float>(x.x + s * w.x), static_cast<float>(x.y + s * w.y), static_cast<float>(x.z + s * w.z)};
}

class PairGuess {
 public:
  explicit PairGuess(const PairGuessIn& in) : in_(in), way_(in.target), x_(in.target), share_(x_.size(), 1) {}

  PairGuessOut run() {
    const double allowed = 2 * double{in_.bound_relaxation};
    double reach = span_of(in_, way_) / allowed;
    if (reach > double{in_.largest_reach}) {
      shorten();
      reach = double{in_.largest_reach};
    }
    pairs_ = pairs_within(in_, reach * (1 + 0x1p-20));
    for (int pass = 0; pass < scaling_passes; ++pass)
      if (!scale()) return {x_};
    while (cut()) {}
    return {x_};
  }

 private:
  bool is_inside(std::size_t v) const { return !leaves_ball(in_, x_[v], v); }

  /// Every move to γ_p R at most: no two differ by more than 2γ_p R then.
  void shorten() {
    const auto longest = static_cast<float>(double{in_.bound_relaxation} * double{in_.largest_reach} * (1 - 0x1p-20));
    for (std::size_t v = 0; v < x_.size(); ++v) {
      if (!in_.topology->on_surface(static_cast<Index>(v))) continue;
      const double whole = length(difference(way_[v], in_.previous[v]));
      if (whole > double{longest})
        way_[v] = stored_within({in_.previous[v].x + (double{way_[v].x} - in_.previous[v].x) * (longest / whole),
                                 in_.previous[v].y + (double{way_[v].y} - in_.previous[v].y) * (longest / whole),
                                 in_.previous[v].z + (double{way_[v].z} - in_.previous[v].z) * (longest / whole)},
                                in_.previous[v], longest);
      x_[v] = way_[v];
    }
  }

  /// By how much a gap may shrink: a little less than 2γ_p of it; while moves are scaled down to r/2 at most, or by a
  /// sixteenth, so that rounding does not stop what moves together.
  Long room(Long gap, bool scales) const {
    const Long safe = 2 * Long{in_.bound_relaxation} * (1 - 0x1p-20L) * gap;
    return scales ? std::min(safe, std::max(gap - Long{in_.contact_radius} / 2, gap / 16)) : safe;
  }

  /// 1 where a pair is safe; otherwise the share of its moves that would be. Safe: all of its vertices are in their
  /// balls, or no two moves of its sides differ by more than there is room for, or its gap along n shrinks by no more.
  double safe_share(const NearPair& pair, bool scales) const {
    if (std::ranges::all_of(pair.vertices, [&](Index v) { return is_inside(at(v)); })) return 1;
    const Long apart = largest_difference(pair, in_.previous, x_) * (1 + 0x1p-40), far = room(Long{pair.below}, scales);
    if (apart < far) return 1;
    double share = static_cast<double>(far / apart);
    if (!pair.has_plane) return share;
    const Gap before = gap_of(pair, in_.previous), after = gap_of(pair, x_);
    const Long error = 0x1p-58L * (before.size + after.size), shrunk = before.value - after.value + error,
               least = before.value - error;
    if (!(least > 0)) return share;
    if (shrunk <= room(least, scales)) return 1;
    return std::max(share, static_cast<double>(room(least, scales) / shrunk));
  }

  /// Whether a pair was unsafe. All shares are of one state, the smallest of a vertex counts: no order matters.
  bool scale() {
    std::vector<double> next(share_);
    bool any = false;
    for (const NearPair& pair : pairs_) {
      const double share = safe_share(pair, true);
      if (share >= 1) continue;
      any = true;
      for (const Index v : pair.vertices) next[at(v)] = std::min(next[at(v)], share_[at(v)] * share * (1 - 0x1p-6));
    }
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (next[v] != share_[v] && !is_fixed(in_, v)) x_[v] = part_of_way(in_.previous[v], way_[v], next[v]);
    share_ = std::move(next);
    return any;
  }

  /// Vertices of unsafe pairs, to their balls; whether there was one. It may make others unsafe.
  bool cut() {
    std::vector<bool> unsafe(x_.size(), false);
    for (const NearPair& pair : pairs_)
      if (safe_share(pair, false) < 1)
        for (const Index v : pair.vertices) unsafe[at(v)] = true;
    bool any = false;
    for (std::size_t v = 0; v < x_.size(); ++v) {
      if (!unsafe[v] || is_inside(v)) continue;
      any = true;
      const compare::TruncateTruth ball = truncate({{in_.previous[v]}, {x_[v]}, {in_.bound[v]}});
      x_[v] = stored_within(ball.position[0], in_.previous[v], in_.bound[v]);
    }
    return any;
  }

  const PairGuessIn& in_;
  Positions way_, x_;  ///< where moves lead at most; where they lead
  std::vector<double> share_;
  std::vector<NearPair> pairs_;
};

/// Which vertices one pair or several connect.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::size_t v, std::size_t w) { parent_[of(v)] = of(w); }

 private:
  std::vector<std::size_t> parent_;
};

/// Vertices of groups that shall stand at y and do not.
std::vector<Index> held_back(const PairGuessIn& in, const PairGuessOut& out) {
  const double span = span_of(in, in.target), relaxation = double{in.bound_relaxation};
  if (span * (1 + 0x1p-20) > 2 * relaxation * double{in.largest_reach}) return {};
  Groups groups(in.previous.size());
  const std::vector<NearPair> pairs = pairs_within(in, span / (2 * relaxation) * (1 + 0x1p-10));
  for (const NearPair& pair : pairs) {
    const auto first = std::ranges::find_if(pair.vertices, [&](Index v) { return !is_fixed(in, at(v)); });
    for (const Index v : pair.vertices)
      if (!is_fixed(in, at(v))) groups.join(at(v), at(*first));
  }
  std::vector<bool> is_held(in.previous.size(), false);
  for (const NearPair& pair : pairs) {
    const Gap before = gap_of(pair, in.previous), after = gap_of(pair, in.target);
    const double apart = largest_difference(pair, in.previous, in.target);
    const Long shrunk = before.value - after.value;
    const bool is_easy = apart <= relaxation * double{pair.below} &&
                         double{pair.below} - apart >= double{in.contact_radius},
               is_easy_along = pair.has_plane &&
                               (shrunk <= before.value / 32 ||
                                (shrunk <= Long{relaxation} * before.value && after.value >= Long{in.contact_radius}));
    if (is_easy || is_easy_along) continue;
    for (const Index v : pair.vertices)
      if (!is_fixed(in, at(v))) is_held[groups.of(at(v))] = true;
  }
  std::vector<Index> held;
  for (std::size_t v = 0; v < in.previous.size(); ++v)
    if (!is_fixed(in, v) && !is_held[groups.of(v)] && !(out.position[v] == in.target[v]))
      held.push_back(static_cast<Index>(v));
  return held;
}

}  // namespace

float largest_reach(const compare::Settings& settings) {
  return static_cast<float>(settings.query_radius_cap * settings.contact_radius);
}

bool leaves_ball(const PairGuessIn& in, const Vec3f& position, std::size_t vertex) {
  if (!in.topology->on_surface(static_cast<Index>(vertex))) return false;
  return truncate({{in.previous[vertex]}, {position}, {in.bound[vertex]}}).cut[0] != 0;
}

PairGuessOut pair_guess(const PairGuessIn& in) { return PairGuess(in).run(); }

PairGuessTruth pair_guess_truth(const PairGuessIn& in, const PairGuessOut& out) {
  PairGuessTruth truth;
  const Long least = 1 - 2 * Long{in.bound_relaxation};
  const double reach = span_of(in, out.position) / (2 * double{in.bound_relaxation}) * (1 + 0x1p-20);
  for (const NearPair& pair : pairs_within(in, reach)) {
    ++truth.pairs;
    const Gap before = gap_of(pair, in.previous), after = gap_of(pair, out.position);
    const Long apart = largest_difference(pair, in.previous, out.position),
               slack = Long{compare::pair_guess_tolerance} * (before.value + apart),
               error = 0x1p-58L * (before.size + after.size);
    const bool is_still = apart <= 2 * Long{in.bound_relaxation} * pair.below * (1 + 0x1p-22L),
               is_apart = after.value > error && after.value >= least * before.value - slack;
    if (!is_still && !is_apart) truth.unsafe.push_back(pair.pair);
  }
  truth.held_back = held_back(in, out);
  return truth;
}

}  // namespace ogc::reference
