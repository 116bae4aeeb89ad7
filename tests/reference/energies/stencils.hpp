// Makes random stencils for the tests of reference/energies, and writes the energies in plain doubles a second time, so
// that expected derivatives do not come from the differentiation under test.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "compare/problem/vector.hpp"

namespace ogc::tests {

using Point = std::array<double, 3>;

inline Point point(const compare::Vec3f& p) { return {p.x, p.y, p.z}; }
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point outer(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) { return std::sqrt(inner(a, a)); }

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  float single(double low, double high) { return static_cast<float>(between(low, high)); }
  compare::Vec3f in_box(double size) { return {single(-size, size), single(-size, size), single(-size, size)}; }

 private:
  std::mt19937 engine_;
};

/// Returns the gradient of an energy with respect to one point, by central differences. With step s the truncation
/// error is s²/6 times a third derivative, the rounding error is 2⁻⁵³ E/s.
template <class Energy>
Point slope(Energy energy, const Point& at, double step) {
  Point result{};
  for (std::size_t k = 0; k < 3; ++k) {
    Point ahead = at, behind = at;
    ahead[k] += step;
    behind[k] -= step;
    result[k] = (energy(ahead) - energy(behind)) / (2 * step);
  }
  return result;
}

/// Returns the smallest of xᵀ B x over 200 random unit vectors x; B is given as xx, xy, xz, yy, yz, zz.
inline double smallest_quadratic(const std::array<double, 6>& b, Draw& draw) {
  double smallest = INFINITY;
  for (int i = 0; i < 200; ++i) {
    Point x{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
    const double length = norm(x);
    const double q = b[0] * x[0] * x[0] + b[3] * x[1] * x[1] + b[5] * x[2] * x[2] +
                     2 * (b[1] * x[0] * x[1] + b[2] * x[0] * x[2] + b[4] * x[1] * x[2]);
    smallest = std::min(smallest, q / (length * length));
  }
  return smallest;
}

}  // namespace ogc::tests
