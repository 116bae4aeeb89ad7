// Holds where a vertex may be until the next detection (Eq. 21, 27; method.md §5.6): the one type that all kernels take
// that truncate or certify a position. These kernels are in truncate.hpp, plane.hpp and certificate.hpp;
// stages/planes.hpp fills the regions by the kind of bounds.
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

/// The half-space n·x ≤ o: a plane as one of its vertices sees it.
struct alignas(8) HalfSpace {
  Vec normal;         ///< n in single precision: a unit vector but for rounding
  double offset = 0;  ///< o [m], as n is nearly a unit vector
};

/// Holds n·x − o, and the sum of the moduli of its terms.
struct Excess {
  double value = 0, size = 0;  ///< [m]
};

/// Returns n·x − o; sums are rounded to double.
OGC_HD inline Excess excess(const Vec& n, double offset, const Vec& x) {
  const double a = mul(static_cast<double>(n.x), static_cast<double>(x.x)),
               b = mul(static_cast<double>(n.y), static_cast<double>(x.y)),
               c = mul(static_cast<double>(n.z), static_cast<double>(x.z));
  return {sub(add(add(a, b), c), offset), add(add(add(modulus(a), modulus(b)), modulus(c)), modulus(offset))};
}

/// Returns whether n·x ≤ o for certain. The three products of floats are exact in double; two sums and the difference
/// err by at most 2⁻⁵³ of the size S = Σ|n_k x_k| + |o| each, and S is short by 3 roundings of itself: under 2⁻⁵¹ S
/// together. The sign of a rounded sum is that of the exact one. False if x is not finite.
OGC_HD inline bool is_behind(const HalfSpace& plane, const Vec& x) {
  const Excess e = excess(plane.normal, plane.offset, x);
  return add(e.value, mul(0x1p-51, e.size)) <= 0;
}

/// The part of a ball that lies in some half-spaces. It is convex and holds the centre.
struct FeasibleRegion {
  Ball ball;
  const HalfSpace* planes = nullptr;  ///< on the backend
  int count = 0;                      ///< half-spaces, at most most_planes
  bool slides = true;                 ///< false: a position outside is scaled towards X_prev (bounds=dat)
};

/// N, the largest number of planes of a vertex; at a spot of collapsed triangles it would have hundreds.
inline constexpr int most_planes = 16;

/// Holds the regions of all vertices, as the last detection left them.
struct FeasibleRegions {
  const Vec* centre = nullptr;        ///< X_prev by vertex [m]
  const float* radius = nullptr;      ///< b_v by vertex [m]
  const HalfSpace* planes = nullptr;  ///< those of vertex v begin at v · most_planes
  const int* counts = nullptr;        ///< planes by vertex; null: there are only balls
  bool is_off = false;                ///< true: nothing holds a vertex
  bool slides = true;                 ///< as in FeasibleRegion

  /// Returns whether bounds are planes, so that regions are more than balls.
  OGC_HD bool has_planes() const { return counts != nullptr; }
  /// Returns the ball, which a kernel reads early together with all else that it waits for.
  OGC_HD Ball ball(int v) const { return {centre[v], radius[v]}; }
  /// Returns the region of a vertex whose ball has been read.
  OGC_HD FeasibleRegion region(int v, const Ball& ball) const {
    if (is_off) return {{ball.centre, unbounded}};
    if (counts == nullptr) return {ball};
    return {ball, planes + static_cast<std::ptrdiff_t>(v) * most_planes, counts[v], slides};
  }
  OGC_HD FeasibleRegion operator[](int v) const { return region(v, ball(v)); }

 private:
  /// [m]; its square fits into single precision
  static constexpr float unbounded = 0x1p50F;
};

}  // namespace ogc::fast
