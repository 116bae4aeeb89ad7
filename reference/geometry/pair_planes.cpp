// Computes directions and offsets in long double and rounds them. Then decides exactly whether each vertex lies in its
// half-space of the rounded plane, by the same comparison that judges planes (`keeps` in plane.hpp).
#include "reference/geometry/pair_planes.hpp"

#include <tbb/combinable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "reference/geometry/bound.hpp"
#include "reference/geometry/edge_parameters.hpp"
#include "reference/geometry/near_pairs.hpp"
#include "reference/geometry/plane.hpp"

namespace ogc::reference {
namespace {

using compare::at;

using compare::PlaneIn;
using compare::PlaneOut;
using compare::PrimitivePair;
using compare::VertexPlane;
using Long = long double;
using Direction = std::array<Long, 3>;

constexpr float no_threshold = std::numeric_limits<float>::infinity();

Direction minus(const Vec3f& a, const Vec3f& b) { return {Long{a.x} - b.x, Long{a.y} - b.y, Long{a.z} - b.z}; }
Direction minus(const Direction& a, const Direction& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Direction times(Long s, const Direction& a) { return {s * a[0], s * a[1], s * a[2]}; }
Long inner(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Direction cross(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Returns `line` or −`line`, whichever has a non-negative product with `way`.
Direction along(const Direction& line, const Direction& way) { return inner(line, way) < 0 ? times(-1, line) : line; }

/// Returns the vector from the point to the closest feature of the triangle.
Direction to_closest(const FacetPair& pair) {
  const TriangleFeature feature = pair.closest();
  const Corners& c = pair.corners;
  const Vec3f& x = pair.point;
  const auto k = static_cast<std::size_t>(feature);
  if (k < 3) return minus(c[k], x);
  if (feature == TriangleFeature::interior) return along(cross(minus(c[1], c[0]), minus(c[2], c[0])), minus(c[0], x));
  const Vec3f &a = c[k - 3], &b = c[(k - 2) % 3];
  const Direction e = minus(b, a), w = minus(a, x);
  return minus(w, times(inner(w, e) / inner(e, e), e));
}

/// Returns the vector from the closest feature of the first edge to that of the second edge.
Direction to_closest(const EdgesPair& edges) {
  const EdgeFeatures on = edges.closest();
  const EdgePair& pair = edges.ends;
  const Direction e = minus(pair.first[1], pair.first[0]), f = minus(pair.second[1], pair.second[0]);
  if (on.first == EdgeFeature::interior && on.second == EdgeFeature::interior)
    return along(cross(e, f), minus(pair.second[0], pair.first[0]));
  const std::array<double, 2> s = closest_parameters(pair, on).values;
  return minus(minus(minus(pair.second[0], pair.first[0]), times(s[0], e)), times(-s[1], f));
}

class PlaneMaker {
 public:
  explicit PlaneMaker(const PlaneIn& in, std::span<const std::uint8_t> sought = {})
      : in_(in),
        sought_(sought),
        mesh_{*in.topology, in.positions},
        near_(mesh_, in.exclusions, double{in.query_radius}) {}

  std::vector<NearPair> pairs() {
    find_pairs();
    return std::move(pairs_);
  }

  PlaneOut run() {
    find_pairs();
    choose_planes();
    PlaneOut out{{{0}, {}}, balls()};
    std::vector<std::vector<VertexPlane>> rows(in_.positions.size());
    for (const NearPair& pair : pairs_)
      for (std::size_t k = 0; k < 4 && pair.has_plane; ++k)
        if (moves(pair.vertices[k])) rows[at(pair.vertices[k])].push_back(pair.as_borne(k));
    for (const auto& row : rows) {
      out.planes.items.insert(out.planes.items.end(), row.begin(), row.end());
      out.planes.offsets.push_back(static_cast<Index>(out.planes.items.size()));
    }
    return out;
  }

 private:
  bool moves(Index v) const { return in_.is_fixed[at(v)] == 0; }
  template <class... Vertices>
  bool is_sought(const Vertices&... sides) const {
    const auto any = [&](const auto& side) {
      return std::ranges::any_of(side, [&](Index v) { return sought_[at(v)]; });
    };
    return sought_.empty() || (any(sides) || ...);
  }

  void find_pairs() {
    tbb::combinable<std::vector<NearPair>> found;
    near_.each([&](const auto& of) {
      if (!is_sought(of.first, of.second)) return;
      if (of.surely_beyond(double{in_.query_radius})) return;
      NearPair pair{of.name};
      std::ranges::copy(of.second, std::ranges::copy(of.first, pair.vertices.begin()).out);
      pair.second_from = of.first.size();
      pair.below = distance_below(of.gap());
      if (pair.below >= in_.query_radius) return;
      place(pair, to_closest(of));
      found.local().push_back(pair);
    });
    found.combine_each([&](const auto& part) { pairs_.insert(pairs_.end(), part.begin(), part.end()); });
    const auto order = [](const NearPair& p) { return std::tuple(p.pair.kind, p.pair.first, p.pair.second); };
    std::ranges::sort(pairs_, {}, order);
  }

  /// Returns n·x in long double: three exact products and two sums.
  static Long height(const Vec3f& n, const Vec3f& x) { return Long{n.x} * x.x + Long{n.y} * x.y + Long{n.z} * x.z; }

  bool is_fixed(const NearPair& pair, bool second) const {
    for (std::size_t k = second ? pair.second_from : 0; k < (second ? 4 : pair.second_from); ++k)
      if (moves(pair.vertices[k])) return false;
    return true;
  }

  /// Returns the share of 2γ_p d that the first side gets. Both sides must be able to move.
  Long first_part(const NearPair& pair) const {
    if (in_.displacement.empty()) return 0.5;
    std::array<Long, 2> approach{0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const Long along_n = height(pair.normal, in_.displacement[at(pair.vertices[k])]);
      Long& largest = approach[k < pair.second_from ? 0 : 1];
      largest = std::max(largest, k < pair.second_from ? along_n : -along_n);
    }
    const Long both = approach[0] + approach[1];
    if (!(both > 0)) return 0.5;
    return std::clamp(approach[0] / both, Long{compare::least_division}, 1 - Long{compare::least_division});
  }

  void place(NearPair& pair, const Direction& direction) const {
    const Long length = std::sqrt(inner(direction, direction)), share = Long{in_.bounds_relaxation};
    if (!(length > 0)) return;
    pair.normal = {static_cast<float>(direction[0] / length), static_cast<float>(direction[1] / length),
                   static_cast<float>(direction[2] / length)};
    Long top = -std::numeric_limits<Long>::infinity(), bottom = -top;
    for (std::size_t k = 0; k < 4; ++k) {
      const Long h = height(pair.normal, mesh_.at(pair.vertices[k]));
      if (k < pair.second_from)
        top = std::max(top, h);
      else
        bottom = std::min(bottom, h);
    }
    const Long gap = bottom - top;
    const bool first_fixed = is_fixed(pair, false), second_fixed = is_fixed(pair, true);
    const Long part = first_part(pair);
    // No vertex uses the offset of a fixed side. It is put half way from this side to the offset of the other side.
    const auto room = [share](bool fixed, bool other_fixed, Long own_part) {
      return fixed ? Long{0.5} - share : (other_fixed ? 2 * share : 2 * share * own_part);
    };
    pair.first_offset = static_cast<double>(top + room(first_fixed, second_fixed, part) * gap);
    pair.second_offset = static_cast<double>(bottom - room(second_fixed, first_fixed, 1 - part) * gap);
    pair.has_plane = pair.first_offset < pair.second_offset;
    for (std::size_t k = 0; k < 4; ++k)
      pair.has_plane = pair.has_plane && keeps(pair.as_borne(k), mesh_.at(pair.vertices[k]));
  }

  void choose_planes() {
    std::vector<std::vector<float>> distances(in_.positions.size());
    for (const NearPair& pair : pairs_)
      for (const Index v : pair.vertices) distances[at(v)].push_back(pair.below);
    std::vector<float> threshold(in_.positions.size(), no_threshold);
    for (std::size_t v = 0; v < distances.size(); ++v) {
      if (distances[v].size() <= compare::planes_of_vertex || in_.is_fixed[v] != 0) continue;
      const auto place = distances[v].begin() + compare::planes_of_vertex;
      std::nth_element(distances[v].begin(), place, distances[v].end());
      threshold[v] = *place;
    }
    for (NearPair& pair : pairs_)
      for (const Index v : pair.vertices) pair.has_plane = pair.has_plane && pair.below < threshold[at(v)];
  }

  std::vector<float> balls() const {
    std::vector<float> nearest(in_.positions.size(), in_.query_radius), bounds;
    for (const NearPair& pair : pairs_)
      for (const Index v : pair.vertices)
        if (!pair.has_plane) nearest[at(v)] = std::min(nearest[at(v)], pair.below);
    for (Index v = 0; v < in_.topology->vertex_count; ++v)
      bounds.push_back(in_.topology->on_surface(v) ? product_below(in_.bounds_relaxation, nearest[at(v)])
                                                   : std::numeric_limits<float>::max());
    return bounds;
  }

  const PlaneIn& in_;
  std::span<const std::uint8_t> sought_;
  Complex mesh_;
  NearPairs near_;
  std::vector<NearPair> pairs_;
};

}  // namespace

VertexPlane NearPair::as_borne(std::size_t k) const {
  if (k < second_from) return {pair, normal, first_offset};
  return {pair, {-normal.x, -normal.y, -normal.z}, -second_offset};
}

std::vector<NearPair> near_pairs_with_planes(const PlaneIn& in, std::span<const std::uint8_t> sought) {
  return PlaneMaker(in, sought).pairs();
}

PlaneOut pair_planes(const PlaneIn& in) { return PlaneMaker(in).run(); }

}  // namespace ogc::reference
