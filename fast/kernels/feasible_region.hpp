// Where a vertex may be until the next detection (Eq. 21, 27; method.md §5.6): the one type that every kernel takes
// which truncates or certifies a position. The kernels that read it are in truncate.hpp, plane.hpp and
// certificate.hpp; stages/planes.hpp says which kind of bounds fills it.
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

/// n·x ≤ o: a plane as one of its vertices sees it.
struct alignas(8) HalfSpace {
  Vec normal;         ///< n in single precision: a unit vector but for rounding
  double offset = 0;  ///< [m], n being nearly a unit vector
};

/// n·x − o, and the sum of the moduli of its terms.
struct Excess {
  double value = 0, size = 0;  ///< [m]
};

/// Rounded to double where it is added up.
OGC_HD inline Excess excess(const Vec& n, double offset, const Vec& x) {
  const double a = mul(static_cast<double>(n.x), static_cast<double>(x.x)),
               b = mul(static_cast<double>(n.y), static_cast<double>(x.y)),
               c = mul(static_cast<double>(n.z), static_cast<double>(x.z));
  return {sub(add(add(a, b), c), offset), add(add(add(modulus(a), modulus(b)), modulus(c)), modulus(offset))};
}

/// n·x ≤ o for certain. The three products of floats are exact in double; two sums and the difference err by at most
/// 2⁻⁵³ of the size S = Σ|n_k x_k| + |o| each, and S is short by 3 roundings of itself: under 2⁻⁵¹ S together. The sign
/// of a rounded sum is that of the exact one. False where x is not finite.
OGC_HD inline bool is_behind(const HalfSpace& plane, const Vec& x) {
  const Excess e = excess(plane.normal, plane.offset, x);
  return add(e.value, mul(0x1p-51, e.size)) <= 0;
}

/// The part of a ball that lies in some half-spaces. Convex; it holds the centre.
struct FeasibleRegion {
  Ball ball;
  const HalfSpace* planes = nullptr;  ///< on the backend
  int count = 0;                      ///< half-spaces, at most most_planes
  bool slides = true;                 ///< false: what lies outside is scaled towards X_prev (bounds=dat)
};

/// N, planes of a vertex at most: a spot of collapsed triangles would have hundreds.
inline constexpr int most_planes = 16;

/// The regions of all vertices, as the last detection left them.
struct FeasibleRegions {
  const Vec* centre = nullptr;        ///< X_prev by vertex [m]
  const float* radius = nullptr;      ///< b_v by vertex [m]
  const HalfSpace* planes = nullptr;  ///< of vertex v from v · most_planes
  const int* counts = nullptr;        ///< planes by vertex; null: there are balls alone
  bool is_off = false;                ///< nothing holds a vertex
  bool slides = true;                 ///< as in FeasibleRegion

  /// Whether bounds are planes, so that regions are more than balls.
  OGC_HD bool has_planes() const { return counts != nullptr; }
  /// What a kernel reads early, with all else that it waits for.
  OGC_HD Ball ball(int v) const { return {centre[v], radius[v]}; }
  /// The region of a vertex whose ball has been read.
  OGC_HD FeasibleRegion region(int v, const Ball& ball) const {
    if (is_off) return {{ball.centre, unbounded}};
    if (counts == nullptr) return {ball};
    return {ball, planes + static_cast<std::ptrdiff_t>(v) * most_planes, counts[v], slides};
  }
  OGC_HD FeasibleRegion operator[](int v) const { return region(v, ball(v)); }

 private:
  /// [m], of which single precision has the square.
  static constexpr float unbounded = 0x1p50F;
};

}  // namespace ogc::fast
