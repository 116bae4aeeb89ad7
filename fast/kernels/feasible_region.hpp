// Defines the region in which a vertex may move until the next detection (Eq. 21, 27; method.md §5.6). All kernels that
// truncate or certify a position take this type (truncate.hpp, plane.hpp, certificate.hpp). stages/planes.hpp fills the
// regions for each choice of `bounds`.
#pragma once

#include <cstddef>

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A closed ball.
struct Ball {
  Vec centre;        ///< X_prev [m]
  float radius = 0;  ///< b_v [m]
};

/// The half-space n·x ≤ o in which a vertex may move on its side of a plane.
struct alignas(8) HalfSpace {
  Vec normal;         ///< n in single precision: a unit vector up to rounding
  double offset = 0;  ///< o [m]
};

/// Holds the value of n·x − o, and the sum of the moduli of its terms (`size`).
struct Excess {
  double value = 0, size = 0;  ///< [m]
};

/// Returns n·x − o; sums are rounded in double.
OGC_HD inline Excess excess(const Vec& n, double offset, const Vec& x) {
  const double a = mul(static_cast<double>(n.x), static_cast<double>(x.x)),
               b = mul(static_cast<double>(n.y), static_cast<double>(x.y)),
               c = mul(static_cast<double>(n.z), static_cast<double>(x.z));
  return {sub(add(add(a, b), c), offset), add(add(add(modulus(a), modulus(b)), modulus(c)), modulus(offset))};
}

/// Returns whether n·x ≤ o is certain. The three products of floats are exact in double. Let S = Σ|n_k x_k| + |o|. The
/// two sums and the difference err by at most 2⁻⁵³ S each, and the computed S is too small by at most 3 roundings:
/// under 2⁻⁵¹ S together. The sum of the value and this limit is rounded, too, which cannot change its sign. Returns
/// false if x is not finite.
OGC_HD inline bool is_behind(const HalfSpace& plane, const Vec& x) {
  const Excess e = excess(plane.normal, plane.offset, x);
  return add(e.value, mul(0x1p-51, e.size)) <= 0;
}

/// The intersection of a ball and half-spaces. It is convex and holds the ball's centre.
struct FeasibleRegion {
  Ball ball;
  const HalfSpace* planes = nullptr;  ///< on the backend
  int count = 0;                      ///< half-spaces, at most most_planes
  /// false: a position outside is moved back along the line to X_prev (bounds=dat); true: it slides along the
  /// half-spaces
  bool slides = true;
  /// inner_radius of the half-spaces [m]; 0: not known
  float inner = 0;
};

/// Returns a radius ρ [m]: is_behind holds in all half-spaces for every position that is nearer to `centre`. Returns 0
/// if the centre is not far enough inside. Let g = n·x − o, g₀ its value at the centre and S₀ the size of g₀'s terms.
/// Within the radius, g ≤ g₀ + (1 + 2⁻²²) ρ, as n is a unit vector up to rounding, and S ≤ S₀ + 1.8 |g₀|. is_behind
/// holds if g ≤ −2⁻⁴⁹ S, which covers the error of g and the slack. With ρ = 0.9999 |g₀| − 2⁻⁴⁵ S₀, g is at most −(10⁻⁴
/// − 2⁻²²) |g₀| − (2⁻⁴⁵ − 2⁻⁵¹) S₀, which is less.
OGC_HD inline float inner_radius(const HalfSpace* planes, int count, const Vec& centre) {
  double least = 0x1p100;
  for (int k = 0; k < count; ++k) {
    const Excess e = excess(planes[k].normal, planes[k].offset, centre);
    const double radius = sub(mul(-0.9999, e.value), mul(0x1p-45, e.size));
    least = radius < least ? radius : least;
  }
  return least > 0 ? round_down(least) : 0.0F;
}

/// N, the largest number of planes of a vertex. At collapsed triangles a vertex would otherwise have hundreds.
inline constexpr int most_planes = 16;

/// Holds the regions of all vertices, as the last detection left them.
struct FeasibleRegions {
  const Vec* centre = nullptr;        ///< X_prev by vertex [m]
  const float* radius = nullptr;      ///< b_v by vertex [m]
  const HalfSpace* planes = nullptr;  ///< half-spaces; the half-spaces of vertex v begin at v · most_planes
  const int* counts = nullptr;        ///< half-spaces by vertex; null: there are only balls
  bool is_off = false;                ///< true: regions are unbounded
  bool slides = true;                 ///< as in FeasibleRegion
  const float* inner = nullptr;       ///< FeasibleRegion::inner by vertex [m]; null: there are only balls

  OGC_HD bool has_planes() const { return counts != nullptr; }
  /// Returns the ball of a vertex, so that a kernel can load it early, together with other data.
  OGC_HD Ball ball(int v) const { return {centre[v], radius[v]}; }
  /// Returns the region of a vertex; `ball` must be ball(v).
  OGC_HD FeasibleRegion region(int v, const Ball& ball) const {
    if (is_off) return {{ball.centre, unbounded}};
    if (counts == nullptr) return {ball};
    return {ball, planes + static_cast<std::ptrdiff_t>(v) * most_planes, counts[v], slides, inner[v]};
  }
  OGC_HD FeasibleRegion operator[](int v) const { return region(v, ball(v)); }

 private:
  /// radius of an unbounded ball [m]; its square fits into single precision
  static constexpr float unbounded = 0x1p50F;
};

}  // namespace ogc::fast
