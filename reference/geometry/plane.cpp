// Distances are asked only of pairs that no plane separates and that are not surely beyond what their vertices' balls
// need.
#include "reference/geometry/plane.hpp"

#include <CGAL/Gmpq.h>
#include <tbb/combinable.h>

#include <cmath>
#include <string>
#include <tuple>

#include "compare/problem/error.hpp"
#include "reference/geometry/near_pairs.hpp"
#include "reference/geometry/separating_plane.hpp"

namespace ogc::reference {
namespace {

using compare::PlaneGuarantee;
using compare::PlaneIn;
using compare::PlaneOut;
using compare::PrimitivePair;
using compare::VertexPlane;
using Rational = CGAL::Gmpq;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Rational exact(const Height& height) {
  const Vec3f &n = height.normal, &x = height.point;
  return Rational(double{n.x}) * Rational(double{x.x}) + Rational(double{n.y}) * Rational(double{x.y}) +
         Rational(double{n.z}) * Rational(double{x.z}) + Rational(height.offset);
}

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
  /// Of single-precision numbers the product is exact in double. What is not finite is too large.
  bool is_too_large(Index v) const {
    return answered_.moves(v) && in_.topology->on_surface(v) &&
           !(double{out_.bound[at(v)]} <= double{in_.bound_relaxation} * double{in_.query_radius});
  }

  /// The largest ball of the vertices, which must fit into γ_p d.
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
    const double needed = double{b} / double{in_.bound_relaxation} * (1 + 0x1p-50);
    if (b == 0 || pair.surely_beyond(needed)) return;
    if (!std::isfinite(b) || scaled_distance_less(pair.gap(), in_.bound_relaxation, b)) found.add({0, 1, pair.name});
  }

  const PlaneIn& in_;
  const PlaneOut& out_;
  AnsweredPlanes answered_;
  tbb::combinable<Findings> findings_;
};

void require(bool holds, const char* what, std::size_t count, std::size_t vertices) {
  if (!holds)
    throw compare::InputError("plane: " + std::to_string(count) + " " + what + " for " + std::to_string(vertices) +
                              " vertices; give one for each");
}

}  // namespace

/// Seven terms, the products exact, are summed up with at most 2⁻⁵³ of their moduli lost by each addition: under 2⁻⁴⁹
/// of the sum of the moduli.
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

compare::PlaneTruth plane(const PlaneIn& in, const PlaneOut& out) {
  return {plane_guarantee(in, out), plane_freedom(in, out)};
}

}  // namespace ogc::reference
