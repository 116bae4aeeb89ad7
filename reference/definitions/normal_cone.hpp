// The set of normals of a face as a convex cone, given by its generators: the corners of the polyhedral Gauss map. It
// answers the same questions as the half-spaces of blocks.hpp, but shares no formula with them, so each can be tested
// against the other. Only .cpp files of this folder include this header: it exposes CGAL's number type.
#pragma once

#include <CGAL/Mpzf.h>

#include <span>
#include <vector>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/formulas.hpp"

namespace ogc::reference {

/// A floating-point number of any size, whose sums and products are not rounded.
using Exact = CGAL::Mpzf;
/// A point or a vector in exact numbers.
using ExactVector = Point<Exact>;

/// The point numerator / weight [m], weight > 0: closest points of edges are quotients.
struct ExactPoint {
  ExactVector numerator;    ///< [m] · weight
  Exact weight = Exact(1);  ///< > 0
};

/// Converts a point without rounding.
inline ExactVector exact(const Vec3f& x) {
  return {Exact(static_cast<double>(x.x)), Exact(static_cast<double>(x.y)), Exact(static_cast<double>(x.z))};
}
/// Returns s a.
inline ExactVector times(const Exact& s, const ExactVector& a) { return {s * a.x, s * a.y, s * a.z}; }
/// Returns a + b.
inline ExactVector plus(const ExactVector& a, const ExactVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
/// Returns whether a vector is 0, exactly.
inline bool is_zero(const ExactVector& a) { return a.x.is_zero() && a.y.is_zero() && a.z.is_zero(); }
/// Returns −1, 0 or 1, exactly.
inline int sign_of(const Exact& a) { return static_cast<int>(a.sign()); }

/// {n : n·d ≤ 0 for all d}, the polar cone of the directions in which a surface leaves a point, as the set of sums of
/// non-negative multiples of `generators()`. Without generators it is {0}: the point has no normal (Eq. 8's saddle).
class NormalCone {
 public:
  NormalCone() = default;
  explicit NormalCone(std::span<const ExactVector> directions);

  /// Returns whether n is in the cone. By Carathéodory's theorem n ≠ 0 is then a non-negative combination of at most
  /// three independent generators.
  bool contains(const ExactVector& n) const;

  /// Returns vectors whose non-negative combinations are the cone.
  const std::vector<ExactVector>& generators() const { return generators_; }
  /// Returns the number of dimensions that opposite pairs of generators span: 0 for a pointed cone, 3 for all space.
  int lineality() const { return lineality_; }

 private:
  void add(const ExactVector& n, std::span<const ExactVector> directions);
  std::vector<ExactVector> generators_;
  int lineality_ = 0;
};

/// Returns the directions in which the star of a face leaves its interior; along the face itself in both senses. For
/// faces of the surface (§3.1) or, with `edge_only`, of M^e (§3.5; vertices and edges only).
std::vector<ExactVector> star_directions(const Complex& mesh, Face face, bool edge_only = false);

}  // namespace ogc::reference
