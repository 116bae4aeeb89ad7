// Holds double-precision vectors, differences and random placements for the tests of the energies. The tests write the
// energies a second time, from their definitions.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "fast/kernels/arithmetic/accumulator.hpp"
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

inline std::array<double, 9> dense(const Symmetric3& h) {
  return {h.xx, h.xy, h.xz, h.xy, h.yy, h.yz, h.xz, h.yz, h.zz};
}

inline double largest_difference(const std::array<double, 9>& a, const std::array<double, 9>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < 9; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// Returns the smallest value of uᵀHu/‖u‖² over many directions. It is below zero only if the block is not positive
/// semidefinite.
inline double least_curvature(const Symmetric3& h, std::mt19937& random) {
  std::normal_distribution<double> normal;
  double least = INFINITY;
  for (int i = 0; i < 50; ++i) {
    const D3 u{normal(random), normal(random), normal(random)};
    const double q = h.xx * u.x * u.x + h.yy * u.y * u.y + h.zz * u.z * u.z +
                     2 * (h.xy * u.x * u.y + h.xz * u.x * u.z + h.yz * u.y * u.z);
    least = std::min(least, q / dot(u, u));
  }
  return least;
}

/// A rotation about a random axis by a random angle, then a shift.
struct RigidMotion {
  D3 axis_of_turn, shift;
  double angle = 0;

  explicit RigidMotion(std::mt19937& random, double far) {
    std::normal_distribution<double> normal;
    axis_of_turn = {normal(random), normal(random), normal(random)};
    axis_of_turn = (1 / length(axis_of_turn)) * axis_of_turn;
    angle = 3 * normal(random);
    shift = {far * normal(random), far * normal(random), far * normal(random)};
  }
  D3 turn(const D3& x) const {
    const D3 once = cross(axis_of_turn, x);
    return x + std::sin(angle) * once + (1 - std::cos(angle)) * cross(axis_of_turn, once);
  }
  D3 operator()(const D3& x) const { return turn(x) + shift; }
};

}  // namespace ogc::fast::test
