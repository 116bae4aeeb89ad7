// The set of normals of a face as a convex cone, given by its generators: the corners of the polyhedral Gauss map. It
// answers the same questions as the half-spaces of blocks.hpp from the other side, and shares no formula with them, so
// each can be tested by the other. Only .cpp files of this room include this header: it shows CGAL's number type.
#pragma once

#include <CGAL/Mpzf.h>

#include <span>
#include <vector>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// Sums and products of floating-point numbers without rounding, of any size.
using Exact = CGAL::Mpzf;
/// A point or a vector in exact numbers.
using ExactVector = Point<Exact>;

/// The point numerator / weight [m], weight > 0: closest points of edges are quotients.
struct ExactPoint {
  ExactVector numerator;    ///< [m] · weight
  Exact weight = Exact(1);  ///< > 0
};

/// The point without rounding.
inline ExactVector exact(const Vec3f& x) {
  return {Exact(static_cast<double>(x.x)), Exact(static_cast<double>(x.y)), Exact(static_cast<double>(x.z))};
}
/// s a.
inline ExactVector times(const Exact& s, const ExactVector& a) { return {s * a.x, s * a.y, s * a.z}; }
/// a + b.
inline ExactVector plus(const ExactVector& a, const ExactVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
/// Exact.
inline bool is_zero(const ExactVector& a) { return a.x.is_zero() && a.y.is_zero() && a.z.is_zero(); }
/// −1, 0 or 1; exact.
inline int sign_of(const Exact& a) { return static_cast<int>(a.sign()); }

/// {n : n·d ≤ 0 for all d}, the polar cone of the directions in which a surface leaves a point, as the set of sums of
/// non-negative multiples of `generators()`. No generators: {0}, the point has no normal (Eq. 8's saddle).
class NormalCone {
 public:
  NormalCone() = default;
  explicit NormalCone(std::span<const ExactVector> directions);

  /// By Carathéodory's theorem: n ≠ 0 is a non-negative combination of at most three independent generators.
  bool contains(const ExactVector& n) const;

  /// Vectors whose non-negative combinations are the cone.
  const std::vector<ExactVector>& generators() const { return generators_; }
  /// Generators come in opposite pairs that span this many dimensions: 0 for a pointed cone, 3 for all space.
  int lineality() const { return lineality_; }

 private:
  void add(const ExactVector& n, std::span<const ExactVector> directions);
  std::vector<ExactVector> generators_;
  int lineality_ = 0;
};

/// The directions in which the star of a face leaves its interior, along the face itself in both senses. Faces of the
/// surface (§3.1) or, with `edge_only`, of M^e (§3.5; vertices and edges only).
std::vector<ExactVector> star_directions(const Complex& mesh, Face face, bool edge_only = false);

}  // namespace ogc::reference
