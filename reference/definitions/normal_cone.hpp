// Represents the normals of a face as a convex cone with generators: the corners of the polyhedral Gauss map. The cone
// shares no formula with the half-spaces of blocks.hpp, so a comparison tests both. Only .cpp files of this folder
// include this header, because it exposes CGAL's number type.
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

/// The point numerator / weight [m] with weight > 0. Closest points of edges are such fractions.
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

/// The polar cone {n : n·d ≤ 0 for all d}, where d are the directions in which a surface leaves a point. Its elements
/// are the sums of non-negative multiples of `generators()`. Without generators it is {0}: the point has no normal (the
/// saddle of Eq. 8).
class NormalCone {
 public:
  NormalCone() = default;
  explicit NormalCone(std::span<const ExactVector> directions);

  /// Returns whether n is in the cone. By Carathéodory's theorem n ≠ 0 is then a non-negative combination of at most
  /// three independent generators.
  bool contains(const ExactVector& n) const;

  /// Returns vectors whose non-negative combinations make up the cone.
  const std::vector<ExactVector>& generators() const { return generators_; }
  /// Returns the dimension of the largest linear subspace in the cone: 0 for a pointed cone, 3 for all space.
  int lineality() const { return lineality_; }

 private:
  void add(const ExactVector& n, std::span<const ExactVector> directions);
  std::vector<ExactVector> generators_;
  int lineality_ = 0;
};

/// Returns the directions from a face's interior into its star, and the directions along the face in both senses.
/// Applies to the surface (§3.1) or, with `edge_only`, to the edge-only manifold (§3.5; vertices and edges only).
std::vector<ExactVector> star_directions(const Complex& mesh, Face face, bool edge_only = false);

}  // namespace ogc::reference
