// What an answer's planes and balls leave to the vertices. Distances (within 2⁻⁴⁰ of their scale) and rooms are in
// double, whose errors are far below the units in which they are judged; which pair is due is asked with the tolerances
// of a single-precision kernel, so that no rounding of its distances decides.
#include <tbb/combinable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "reference/geometry/near_pairs.hpp"
#include "reference/geometry/plane.hpp"
#include "reference/geometry/separating_plane.hpp"

namespace ogc::reference {
namespace {

using compare::PlaneFreedom;
using compare::PlaneIn;
using compare::PlaneOut;
using compare::PrimitivePair;

constexpr double u = compare::unit_roundoff, infinity = std::numeric_limits<double>::infinity();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::tuple<PrimitivePair::Kind, Index, Index> order(const PrimitivePair& pair) {
  return {pair.kind, pair.first, pair.second};
}

/// A pair within r_q, or one that a kernel may take for such a pair.
struct MeasuredPair {
  PrimitivePair name;
  std::array<Index, 4> vertices{};
  double distance = 0;        ///< d [m]
  double scale = 0;           ///< max(d, Σ|δ|) [m]
  bool has_room = false;      ///< for a plane in single precision
  bool is_separated = false;  ///< by the answer
  double together = 0;        ///< how far both sides may come together along the plane that separates them [m]

  /// Not above what a kernel may take for its distance, d less its tolerance.
  double surely_above() const { return std::max(0.0, distance - compare::detect_below_tolerance * u * scale); }
};

/// Whether single precision can hold a plane of the pair (PlaneFreedom).
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
  /// Whether a kernel may take them for a pair within r_q. Of pairs so slender that their distance has no bits to spare
  /// the search for all pairs does not find each.
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
    measured.has_room = has_room_for_plane(measured.distance, measured.scale, largest, double{in_.bound_relaxation});
    if (const auto normal = answered_.separating_normal(pair)) {
      measured.is_separated = true;
      measured.together = (room(pair.name, pair.first, *normal, 1) + room(pair.name, pair.second, *normal, -1)) /
                          std::hypot(double{normal->x}, double{normal->y}, double{normal->z});
    }
    return measured;
  }

  /// How far a side may come along `sign` n, times the length of n: as far as the vertex that is next to its offset; 0
  /// where none can move.
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

  /// By vertex: nearer pairs than this are among its nearest, whatever rounding says.
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
      const bool is_due = pair.has_room && is_within(pair.distance) &&
                          std::ranges::all_of(pair.vertices, is_among_nearest);
      freedom_.due += is_due ? 1 : 0;
      if (is_due && !pair.is_separated && freedom_.missing++ == 0) freedom_.first_missing = pair.name;
      if (!pair.is_separated) continue;
      const double narrowing = (2 * double{in_.bound_relaxation} * pair.distance - pair.together) / (u * pair.scale);
      if (!(narrowing > freedom_.narrowing)) continue;
      freedom_.narrowing = narrowing;
      freedom_.narrowest = pair.name;
    }
  }

  void judge_balls() {
    std::vector<double>& shortfall = freedom_.ball_shortfall;
    const double share = double{in_.bound_relaxation}, reach = double{in_.query_radius};
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

}  // namespace

PlaneFreedom plane_freedom(const PlaneIn& in, const PlaneOut& out) { return FreedomCheck(in, out).run(); }

}  // namespace ogc::reference
