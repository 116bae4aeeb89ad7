// Measures in double how far the vertices can move. The errors of distances (within 2⁻⁴⁰ of their scale) are far below
// the units in which freedom is judged. Requires a plane for a pair only if every single-precision kernel within its
// tolerances must give it one.
#include "reference/geometry/plane.hpp"

#include <CGAL/Gmpq.h>
#include <tbb/combinable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "compare/problem/error.hpp"
#include "reference/geometry/near_pairs.hpp"

namespace ogc::reference {
namespace {

using compare::at;

using compare::PlaneFreedom;
using compare::PlaneGuarantee;
using compare::PlaneIn;
using compare::PlaneOut;
using compare::PrimitivePair;
using compare::VertexPlane;
using Rational = CGAL::Gmpq;

constexpr double u = compare::unit_roundoff, infinity = std::numeric_limits<double>::infinity();

Rational exact(const Height& height) {
  const Vec3f &n = height.normal, &x = height.point;
  return Rational(double{n.x}) * Rational(double{x.x}) + Rational(double{n.y}) * Rational(double{x.y}) +
         Rational(double{n.z}) * Rational(double{x.z}) + Rational(height.offset);
}

/// Finds the planes of pairs in an answer.
class AnsweredPlanes {
 public:
  AnsweredPlanes(const compare::PlaneIn& in, const compare::PlaneOut& out) : in_(in), out_(out) {}

  bool moves(Index v) const { return in_.is_fixed[static_cast<std::size_t>(v)] == 0; }

  /// Returns the offset of v's half-space for this pair. The half-space must exist.
  double offset(Index v, const compare::PrimitivePair& pair) const { return plane_of(v, pair)->offset; }

  /// Returns the normal of the plane that separates the pair, from the first side to the second. Empty if no plane
  /// separates it: a movable vertex has no half-space for this pair, the vertices' normals differ, or the sides
  /// overlap.
  template <class Pair>
  std::optional<Vec3f> separating_normal(const Pair& pair) const {
    const std::optional<Vec3f> normal = common_normal(pair);
    if (!normal) return std::nullopt;
    for (const Index v : pair.first)
      for (const Index w : pair.second)
        if (compared(limit(v, pair.name, *normal, false), limit(w, pair.name, *normal, true)) >= 0) return std::nullopt;
    return normal;
  }

 private:
  const compare::VertexPlane* plane_of(Index v, const compare::PrimitivePair& pair) const {
    for (const compare::VertexPlane& plane : out_.planes.of(v))
      if (plane.pair == pair) return &plane;
    return nullptr;
  }

  template <class Pair>
  std::optional<Vec3f> common_normal(const Pair& pair) const {
    std::optional<Vec3f> normal;
    const auto agrees = [&](Index v, bool is_second) {
      if (!moves(v)) return true;
      const compare::VertexPlane* plane = plane_of(v, pair.name);
      if (plane == nullptr) return false;
      const Vec3f& n = plane->normal;
      const Vec3f own = is_second ? Vec3f{-n.x, -n.y, -n.z} : n;
      if (!normal) normal = own;
      return own == *normal;
    };
    for (const Index v : pair.first)
      if (!agrees(v, false)) return std::nullopt;
    for (const Index v : pair.second)
      if (!agrees(v, true)) return std::nullopt;
    return normal;
  }

  /// Returns the height up to which a vertex may move along n: the offset of its half-space, or its own height if it is
  /// fixed.
  Height limit(Index v, const compare::PrimitivePair& pair, const Vec3f& normal, bool is_second) const {
    if (!moves(v)) return {normal, in_.positions[static_cast<std::size_t>(v)], 0};
    return {{}, {}, is_second ? -offset(v, pair) : offset(v, pair)};
  }

  const compare::PlaneIn& in_;
  const compare::PlaneOut& out_;
};

/// Counts the pairs that a plane separates, and the pairs that neither a plane nor balls keep apart (`uncovered`).
/// `worst` is the first uncovered pair.
struct Findings {
  std::size_t separated = 0, uncovered = 0;
  PrimitivePair worst;

  void add(const Findings& other) {
    const auto order = [](const PrimitivePair& p) { return std::tuple(p.kind, p.first, p.second); };
    if (other.uncovered > 0 && (uncovered == 0 || order(other.worst) < order(worst))) worst = other.worst;
    separated += other.separated;
    uncovered += other.uncovered;
  }
};

class PlaneCheck {
 public:
  PlaneCheck(const PlaneIn& in, const PlaneOut& out) : in_(in), out_(out), answered_(in, out) {}

  PlaneGuarantee run() {
    const Complex mesh{*in_.topology, in_.positions};
    NearPairs(mesh, in_.exclusions, double{in_.query_radius}).each([this](const auto& pair) { look(pair); });
    Findings all;
    findings_.combine_each([&](const Findings& part) { all.add(part); });
    PlaneGuarantee found{all.separated, all.uncovered, all.worst};
    found.broken = broken_planes(out_.planes, in_.positions);
    for (Index v = 0; v < in_.topology->vertex_count; ++v) found.too_large += is_too_large(v) ? 1 : 0;
    return found;
  }

 private:
  /// Returns whether b_v is above γ_p r_q or not finite. The product of single-precision numbers is exact in double.
  bool is_too_large(Index v) const {
    return answered_.moves(v) && in_.topology->on_surface(v) &&
           !(double{out_.bound[at(v)]} <= double{in_.bounds_relaxation} * double{in_.query_radius});
  }

  template <class Pair>
  float largest_bound(const Pair& pair) const {
    float largest = 0;
    const auto consider = [&](Index v) {
      const float b = out_.bound[at(v)];
      if (answered_.moves(v) && !(b <= largest)) largest = b;
    };
    for (const Index v : pair.first) consider(v);
    for (const Index v : pair.second) consider(v);
    return largest;
  }

  template <class Pair>
  void look(const Pair& pair) {
    Findings& found = findings_.local();
    if (answered_.separating_normal(pair)) {
      found.add({1, 0, {}});
      return;
    }
    const float b = largest_bound(pair);
    const double needed = double{b} / double{in_.bounds_relaxation} * (1 + 0x1p-50);
    if (b == 0 || pair.surely_beyond(needed)) return;
    if (!std::isfinite(b) || scaled_distance_less(pair.gap(), in_.bounds_relaxation, b)) found.add({0, 1, pair.name});
  }

  const PlaneIn& in_;
  const PlaneOut& out_;
  AnsweredPlanes answered_;
  tbb::combinable<Findings> findings_;
};

std::tuple<PrimitivePair::Kind, Index, Index> order(const PrimitivePair& pair) {
  return {pair.kind, pair.first, pair.second};
}

/// A pair that a kernel may find within r_q, exactly or because of rounding.
struct MeasuredPair {
  PrimitivePair name;
  std::array<Index, 4> vertices{};
  double distance = 0;        ///< d [m]
  double scale = 0;           ///< max(d, Σ|δ|) [m]
  bool has_room = false;      ///< whether single precision can hold a plane for this pair
  bool is_separated = false;  ///< whether the answer's planes separate it
  double together = 0;        ///< how far both sides together may approach along the separating plane's normal [m]
  double division = 0;        ///< PlaneFreedom::division of this pair

  /// Returns a lower limit of the distance that a kernel may compute.
  double surely_above() const { return std::max(0.0, distance - compare::detect_below_tolerance * u * scale); }
};

/// Returns whether single precision can hold a plane for the pair (PlaneFreedom).
bool has_room_for_plane(double distance, double scale, double largest_coordinate, double share) {
  return distance > 0 && distance >= 0x1p-18 * scale &&
         std::min(share, 1 - 2 * share) * distance >= 0x1p-45 * largest_coordinate;
}

class FreedomCheck {
 public:
  FreedomCheck(const PlaneIn& in, const PlaneOut& out) : in_(in), out_(out), answered_(in, out) {}

  PlaneFreedom run() {
    const Complex mesh{*in_.topology, in_.positions};
    NearPairs(mesh, in_.exclusions, double{in_.query_radius}).each([this](const auto& pair) { measure_pair(pair); });
    measured_.combine_each([this](const auto& part) { pairs_.insert(pairs_.end(), part.begin(), part.end()); });
    std::ranges::sort(pairs_, {}, [](const MeasuredPair& pair) { return order(pair.name); });
    for (const MeasuredPair& pair : pairs_) freedom_.pairs += is_within(pair.distance) ? 1 : 0;
    for (const compare::VertexPlane& plane : out_.planes.items) freedom_.needless += may_have_plane(plane.pair) ? 0 : 1;
    judge_planes(thresholds());
    judge_balls();
    return freedom_;
  }

 private:
  /// Returns whether a kernel may find the pair within r_q. `pairs_` may lack a pair whose distance has few correct
  /// bits, so a pair that is not in `pairs_` is measured here.
  bool may_have_plane(const PrimitivePair& name) const {
    const auto found = std::ranges::lower_bound(pairs_, order(name), {},
                                                [](const MeasuredPair& pair) { return order(pair.name); });
    if (found != pairs_.end() && found->name == name) return true;
    const Complex mesh{*in_.topology, in_.positions};
    const auto is_near = [&](const auto& pair) {
      return !is_excluded(in_.exclusions, pair.first, pair.second) && is_within(measurement(pair).surely_above());
    };
    return name.kind == PrimitivePair::Kind::edge_edge ? is_near(EdgesPair(mesh, name.first, name.second))
                                                       : is_near(FacetPair(mesh, name.first, name.second));
  }
  bool is_within(double distance) const { return distance < double{in_.query_radius}; }

  template <class Pair>
  void measure_pair(const Pair& pair) {
    if (pair.surely_beyond(double{in_.query_radius} * search_margin)) return;
    const MeasuredPair found = measurement(pair);
    if (is_within(found.surely_above())) measured_.local().push_back(found);
  }

  template <class Pair>
  MeasuredPair measurement(const Pair& pair) const {
    MeasuredPair measured{pair.name};
    measured.distance = measure(pair.gap()).distance;
    std::ranges::copy(pair.second, std::ranges::copy(pair.first, measured.vertices.begin()).out);
    double largest = 0;
    const Vec3f& origin = in_.positions[at(pair.first[0])];
    for (const Index v : measured.vertices) {
      const Vec3f& x = in_.positions[at(v)];
      measured.scale += std::abs(double{x.x} - origin.x) + std::abs(double{x.y} - origin.y) +
                        std::abs(double{x.z} - origin.z);
      largest = std::max({largest, std::abs(double{x.x}), std::abs(double{x.y}), std::abs(double{x.z})});
    }
    measured.scale = std::max(measured.scale, measured.distance);
    measured.has_room = has_room_for_plane(measured.distance, measured.scale, largest, double{in_.bounds_relaxation});
    if (const auto normal = answered_.separating_normal(pair)) {
      measured.is_separated = true;
      measured.together = (room(pair.name, pair.first, *normal, 1) + room(pair.name, pair.second, *normal, -1)) /
                          std::hypot(double{normal->x}, double{normal->y}, double{normal->z});
      if (!in_.displacement.empty()) measured.division = division(pair, *normal, measured);
    }
    return measured;
  }

  using Long = long double;
  static Long inner(const Vec3f& n, const Vec3f& x) { return Long{n.x} * x.x + Long{n.y} * x.y + Long{n.z} * x.z; }

  template <class Vertices>
  bool can_move(const Vertices& side) const {
    return std::ranges::any_of(side, [this](Index v) { return answered_.moves(v); });
  }

  /// Returns the distance from a side's farthest vertex in the direction `sign` · n to the side's offset, times the
  /// length of n.
  template <class Vertices>
  Long way_to_offset(const PrimitivePair& name, const Vertices& side, const Vec3f& n, Long sign) const {
    Long farthest = -Long{infinity}, offset = 0;
    for (const Index v : side) {
      farthest = std::max(farthest, sign * inner(n, in_.positions[at(v)]));
      if (answered_.moves(v)) offset = Long{answered_.offset(v, name)};
    }
    return offset - farthest;
  }

  /// Returns the largest displacement of a side's vertices in the direction `sign` · n [m]; it may be negative.
  template <class Vertices>
  Long speed_of(const Vertices& side, const Vec3f& n, Long sign) const {
    Long largest = -Long{infinity};
    for (const Index v : side) largest = std::max(largest, sign * inner(n, in_.displacement[at(v)]));
    return largest / std::sqrt(inner(n, n));
  }

  /// Returns the error of the offsets: how far their division of 2γ_p d is from the right one, in the units of
  /// PlaneFreedom::division. Returns 0 if any division is accepted, because a side cannot move or rounding can hide
  /// whether the sides approach.
  template <class Pair>
  double division(const Pair& pair, const Vec3f& n, const MeasuredPair& measured) const {
    if (!can_move(pair.first) || !can_move(pair.second)) return 0;
    Long largest = 0;
    for (const Index v : measured.vertices)
      largest = std::max(largest, std::sqrt(inner(in_.displacement[at(v)], in_.displacement[at(v)])));
    const Long first = speed_of(pair.first, n, 1), second = speed_of(pair.second, n, -1), doubt = 4 * u * largest;
    const Long a = std::max(Long{0}, first), b = std::max(Long{0}, second);
    if (a + b <= doubt && largest > 0 && std::max(first, second) > -doubt) return 0;
    Long share = 0.5;
    if (a + b > 0) share = std::clamp(a / (a + b), Long{compare::least_division}, 1 - Long{compare::least_division});
    const Long length = std::sqrt(inner(n, n)), whole = 2 * Long{in_.bounds_relaxation} * measured.distance;
    const Long error = std::max(std::abs(way_to_offset(pair.name, pair.first, n, 1) / length - share * whole),
                                std::abs(way_to_offset(pair.name, pair.second, n, -1) / length - (1 - share) * whole));
    const Long doubtful = a + b > 0 ? measured.distance * largest / (a + b) : Long{0};
    return static_cast<double>(error / (u * (measured.scale + doubtful)));
  }

  /// Returns how far a side may move in the direction `sign` · n, times the length of n. This is the smallest distance
  /// from a movable vertex to the plane of its half-space; 0 if no vertex can move.
  template <class Vertices>
  double room(const PrimitivePair& name, const Vertices& side, const Vec3f& n, double sign) const {
    double least = infinity;
    for (const Index v : side) {
      if (!answered_.moves(v)) continue;
      const Vec3f& x = in_.positions[at(v)];
      const long double height = static_cast<long double>(n.x) * x.x + static_cast<long double>(n.y) * x.y +
                                 static_cast<long double>(n.z) * x.z;
      least = std::min(least, static_cast<double>(answered_.offset(v, name) - sign * height));
    }
    return least < infinity ? least : 0;
  }

  /// Returns a threshold for each vertex. If a pair is nearer than the thresholds of all its vertices, every kernel
  /// must give it a plane, however it rounds.
  std::vector<double> thresholds() const {
    constexpr std::size_t most = compare::planes_of_vertex;
    std::vector<std::vector<double>> distances(in_.positions.size());
    for (const MeasuredPair& pair : pairs_)
      for (const Index v : pair.vertices) distances[at(v)].push_back(pair.surely_above());
    std::vector<double> threshold(in_.positions.size(), infinity);
    for (std::size_t v = 0; v < distances.size(); ++v) {
      if (distances[v].size() <= most || in_.is_fixed[v] != 0) continue;
      std::ranges::nth_element(distances[v], distances[v].begin() + most);
      threshold[v] = distances[v][most];
    }
    return threshold;
  }

  void judge_planes(const std::vector<double>& threshold) {
    for (const MeasuredPair& pair : pairs_) {
      const auto is_among_nearest = [&](Index v) { return pair.distance < threshold[at(v)]; };
      // Skips pairs of fixed vertices. Cases have no such pairs, but a wrong form that ignores exclusions may find
      // some.
      const auto moves = [&](Index v) { return answered_.moves(v); };
      const bool is_due = pair.has_room && is_within(pair.distance) && std::ranges::any_of(pair.vertices, moves) &&
                          std::ranges::all_of(pair.vertices, is_among_nearest);
      freedom_.due += is_due ? 1 : 0;
      if (is_due && !pair.is_separated && freedom_.missing++ == 0) freedom_.first_missing = pair.name;
      if (!pair.is_separated) continue;
      if (pair.division > freedom_.division) {
        freedom_.division = pair.division;
        freedom_.worst_divided = pair.name;
      }
      const double narrowing = (2 * double{in_.bounds_relaxation} * pair.distance - pair.together) / (u * pair.scale);
      if (!(narrowing > freedom_.narrowing)) continue;
      freedom_.narrowing = narrowing;
      freedom_.narrowest = pair.name;
    }
  }

  void judge_balls() {
    std::vector<double>& shortfall = freedom_.ball_shortfall;
    const double share = double{in_.bounds_relaxation}, reach = double{in_.query_radius};
    const auto units = [share](double d, double scale, float bound) {
      const double missing = share * d - double{bound};
      return missing > 0 ? missing / (u * (share * scale + 0x1p-126)) : 0;
    };
    for (const float bound : out_.bound) shortfall.push_back(units(reach, reach, bound));
    for (const MeasuredPair& pair : pairs_)
      for (const Index v : pair.vertices)
        if (!pair.is_separated)
          shortfall[at(v)] = std::min(shortfall[at(v)], units(pair.distance, pair.scale, out_.bound[at(v)]));
    for (Index v = 0; v < in_.topology->vertex_count; ++v) {
      if (answered_.moves(v) && in_.topology->on_surface(v)) continue;
      shortfall[at(v)] = 0;
      freedom_.bounded_inside += !in_.topology->on_surface(v) && answered_.moves(v) &&
                                 out_.bound[at(v)] != std::numeric_limits<float>::max();
    }
  }

  const PlaneIn& in_;
  const PlaneOut& out_;
  AnsweredPlanes answered_;
  tbb::combinable<std::vector<MeasuredPair>> measured_;
  std::vector<MeasuredPair> pairs_;
  PlaneFreedom freedom_;
};

void require(bool holds, const char* what, std::size_t count, std::size_t vertices) {
  if (!holds)
    throw compare::InputError("plane: " + std::to_string(count) + " " + what + " for " + std::to_string(vertices) +
                              " vertices; give one for each");
}

}  // namespace

/// Returns the sign of a − b. Sums eight numbers with exact products; all additions together lose less than 2⁻⁴⁹ of the
/// sum of the moduli.
int compared(const Height& a, const Height& b) {
  double sum = a.offset - b.offset, size = std::abs(a.offset) + std::abs(b.offset);
  const auto add = [&](float n, float x, double sign) {
    const double product = double{n} * double{x};
    sum += sign * product;
    size += std::abs(product);
  };
  for (const auto& [height, sign] : {std::pair{&a, 1.0}, std::pair{&b, -1.0}}) {
    add(height->normal.x, height->point.x, sign);
    add(height->normal.y, height->point.y, sign);
    add(height->normal.z, height->point.z, sign);
  }
  if (std::abs(sum) > 0x1p-49 * size) return sum > 0 ? 1 : -1;
  const Rational difference = exact(a) - exact(b);
  return difference > 0 ? 1 : (difference < 0 ? -1 : 0);
}

bool keeps(const VertexPlane& plane, const Vec3f& x) {
  return compared({plane.normal, x, 0}, {{}, {}, plane.offset}) <= 0;
}

std::size_t broken_planes(const compare::VertexPlanes& planes, std::span<const Vec3f> positions) {
  std::size_t broken = 0;
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const VertexPlane& plane : planes.of(static_cast<Index>(v))) broken += keeps(plane, positions[v]) ? 0 : 1;
  return broken;
}

PlaneGuarantee plane_guarantee(const PlaneIn& in, const PlaneOut& out) {
  const std::size_t vertices = in.positions.size();
  require(out.bound.size() == vertices, "bounds", out.bound.size(), vertices);
  require(in.is_fixed.size() == vertices, "fixed flags", in.is_fixed.size(), vertices);
  const std::size_t rows = out.planes.offsets.empty() ? vertices : out.planes.offsets.size() - 1;
  require(rows == vertices, "rows of planes", rows, vertices);
  return PlaneCheck(in, out).run();
}

PlaneFreedom plane_freedom(const PlaneIn& in, const PlaneOut& out) { return FreedomCheck(in, out).run(); }

compare::PlaneTruth plane(const PlaneIn& in, const PlaneOut& out) {
  return {plane_guarantee(in, out), plane_freedom(in, out)};
}

}  // namespace ogc::reference
