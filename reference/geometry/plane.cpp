// n·x − o in double first; where its rounding could hide the sign, in fractions. Distances are asked only of pairs that
// no plane separates and that are not surely beyond what their vertices' balls need.
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

#include "compare/problem/error.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/near_pairs.hpp"
#include "reference/geometry/separation.hpp"

namespace ogc::reference {
namespace {

using compare::PlaneIn;
using compare::PlaneOut;
using compare::PlaneTruth;
using compare::PrimitivePair;
using compare::VertexPlane;
using Rational = CGAL::Gmpq;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// n·x, or an offset (x = 0): a number that is known without error.
struct Height {
  Vec3f normal, point;
  double offset = 0;

  Rational exact() const {
    return Rational(double{normal.x}) * Rational(double{point.x}) +
           Rational(double{normal.y}) * Rational(double{point.y}) +
           Rational(double{normal.z}) * Rational(double{point.z}) + Rational(offset);
  }
};

/// The sign of a − b. Seven terms, the products exact, are summed up with at most 2⁻⁵³ of their moduli lost by each
/// addition: under 2⁻⁴⁹ of the sum of the moduli.
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
  const Rational exact = a.exact() - b.exact();
  return exact > 0 ? 1 : (exact < 0 ? -1 : 0);
}

Vec3f opposite(const Vec3f& n) { return {-n.x, -n.y, -n.z}; }

/// Pairs that are neither separated nor covered, and the first of them.
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
  PlaneCheck(const PlaneIn& in, const PlaneOut& out)
      : in_(in), out_(out), mesh_{*in.topology, in.positions}, pairs_(mesh_, in.exclusions, double{in.query_radius}) {}

  PlaneTruth run() {
    facets();
    edges();
    Findings all;
    findings_.combine_each([&](const Findings& part) { all.add(part); });
    PlaneTruth truth{all.separated, all.uncovered, all.worst};
    truth.broken = broken_planes(out_.planes, in_.positions);
    for (Index v = 0; v < in_.topology->vertex_count; ++v) truth.too_large += is_too_large(v) ? 1 : 0;
    return truth;
  }

 private:
  bool moves(Index v) const { return in_.is_fixed[at(v)] == 0; }

  /// Of single-precision numbers the product is exact in double. What is not finite is too large.
  bool is_too_large(Index v) const {
    return moves(v) && !(double{out_.bound[at(v)]} <= double{in_.bound_relaxation} * double{in_.query_radius});
  }

  const VertexPlane* plane_of(Index v, const PrimitivePair& pair) const {
    for (const VertexPlane& plane : out_.planes.of(v))
      if (plane.pair == pair) return &plane;
    return nullptr;
  }

  /// The normal that the first side's vertices have of the pair's plane; empty where a vertex that can move has none or
  /// another.
  template <std::size_t M, std::size_t N>
  std::optional<Vec3f> common_normal(const PrimitivePair& pair, const std::array<Index, M>& first,
                                     const std::array<Index, N>& second) const {
    std::optional<Vec3f> normal;
    const auto agrees = [&](Index v, bool is_second) {
      if (!moves(v)) return true;
      const VertexPlane* plane = plane_of(v, pair);
      if (plane == nullptr) return false;
      const Vec3f own = is_second ? opposite(plane->normal) : plane->normal;
      if (!normal) normal = own;
      return own.x == normal->x && own.y == normal->y && own.z == normal->z;
    };
    for (const Index v : first)
      if (!agrees(v, false)) return std::nullopt;
    for (const Index v : second)
      if (!agrees(v, true)) return std::nullopt;
    return normal;
  }

  /// How far along n a vertex may come: its offset, or where it is for good.
  Height limit(Index v, const PrimitivePair& pair, const Vec3f& normal, bool is_second) const {
    if (!moves(v)) return {normal, mesh_.at(v), 0};
    const double offset = plane_of(v, pair)->offset;
    return {{}, {}, is_second ? -offset : offset};
  }

  template <std::size_t M, std::size_t N>
  bool is_separated(const PrimitivePair& pair, const std::array<Index, M>& first,
                    const std::array<Index, N>& second) const {
    const std::optional<Vec3f> normal = common_normal(pair, first, second);
    if (!normal) return false;
    for (const Index v : first)
      for (const Index w : second)
        if (compared(limit(v, pair, *normal, false), limit(w, pair, *normal, true)) >= 0) return false;
    return true;
  }

  /// The largest ball of the vertices, which must fit into γ_p d.
  template <std::size_t M, std::size_t N>
  float largest_bound(const std::array<Index, M>& first, const std::array<Index, N>& second) const {
    float largest = 0;
    const auto consider = [&](Index v) {
      const float b = out_.bound[at(v)];
      if (moves(v) && !(b <= largest)) largest = b;
    };
    for (const Index v : first) consider(v);
    for (const Index v : second) consider(v);
    return largest;
  }

  /// gap(): the distance of the pair, a Margin; beyond(d): it is surely farther apart than d.
  template <std::size_t M, std::size_t N, class Gap, class Beyond>
  void look(const PrimitivePair& pair, const std::array<Index, M>& first, const std::array<Index, N>& second, Gap gap,
            Beyond beyond) {
    Findings& found = findings_.local();
    if (is_separated(pair, first, second)) {
      found.add({1, 0, {}});
      return;
    }
    const float b = largest_bound(first, second);
    const double needed = double{b} / double{in_.bound_relaxation} * (1 + 0x1p-50);
    if (b == 0 || beyond(needed)) return;
    if (!std::isfinite(b) || scaled_distance_less(gap(), in_.bound_relaxation, b)) found.add({0, 1, pair});
  }

  void facets() {
    pairs_.facets([&](Index v, Index t) {
      const compare::Triangle& c = mesh_.triangle(t);
      const Corners corners{mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2])};
      look(
          {PrimitivePair::Kind::vertex_triangle, v, t}, std::array{v}, c,
          [&] { return feature_gap(corners, closest_feature(corners, mesh_.at(v)), mesh_.at(v)); },
          [&](double d) {
            return surely_beyond_triangle({mesh_.at(v), corners[0], corners[1], corners[2]}, d);
          });
    });
  }

  void edges() {
    pairs_.edges([&](Index e, Index f) {
      const compare::Edge &a = mesh_.edge(e), &b = mesh_.edge(f);
      const EdgePair pair{{mesh_.at(a[0]), mesh_.at(a[1])}, {mesh_.at(b[0]), mesh_.at(b[1])}};
      look(
          {PrimitivePair::Kind::edge_edge, e, f}, a, b, [&] { return feature_gap(pair, closest_features(pair)); },
          [&](double d) {
            return surely_beyond_edge({pair.first[0], pair.first[1], pair.second[0], pair.second[1]}, d);
          });
    });
  }

  const PlaneIn& in_;
  const PlaneOut& out_;
  Complex mesh_;
  NearPairs pairs_;
  tbb::combinable<Findings> findings_;
};

void require(bool holds, const char* what, std::size_t count, std::size_t vertices) {
  if (!holds)
    throw compare::InputError("plane: " + std::to_string(count) + " " + what + " for " + std::to_string(vertices) +
                              " vertices; give one for each");
}

}  // namespace

bool keeps(const VertexPlane& plane, const Vec3f& x) {
  return compared({plane.normal, x, 0}, {{}, {}, plane.offset}) <= 0;
}

std::size_t broken_planes(const compare::VertexPlanes& planes, std::span<const Vec3f> positions) {
  std::size_t broken = 0;
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const VertexPlane& plane : planes.of(static_cast<Index>(v))) broken += keeps(plane, positions[v]) ? 0 : 1;
  return broken;
}

PlaneTruth plane(const PlaneIn& in, const PlaneOut& out) {
  const std::size_t vertices = in.positions.size();
  require(out.bound.size() == vertices, "bounds", out.bound.size(), vertices);
  require(in.is_fixed.size() == vertices, "fixed flags", in.is_fixed.size(), vertices);
  const std::size_t rows = out.planes.offsets.empty() ? vertices : out.planes.offsets.size() - 1;
  require(rows == vertices, "rows of planes", rows, vertices);
  return PlaneCheck(in, out).run();
}

}  // namespace ogc::reference
