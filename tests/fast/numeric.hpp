// Defines double-precision vectors and differences of energies for the tests of kernels.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast::test {

using D3 = Vector<double>;

inline D3 wide(const Vec& a) { return {a.x, a.y, a.z}; }
inline Vec narrow(const D3& a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }
inline double length(const D3& a) { return std::sqrt(dot(a, a)); }
inline double length(const Vec& a) { return length(wide(a)); }
inline double& axis(D3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
inline double axis(const D3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

/// Returns −∂E/∂x_v by central differences with the given step [m].
inline D3 force_by_differences(const std::function<double(const std::vector<D3>&)>& energy, std::vector<D3> x,
                               std::size_t v, double step) {
  D3 force;
  for (int k = 0; k < 3; ++k) {
    const double at = axis(x[v], k);
    axis(x[v], k) = at + step;
    const double above = energy(x);
    axis(x[v], k) = at - step;
    const double below = energy(x);
    axis(x[v], k) = at;
    axis(force, k) = -(above - below) / (2 * step);
  }
  return force;
}

}  // namespace ogc::fast::test
