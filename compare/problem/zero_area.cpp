// Evaluates three 2×2 determinants as exact sums of six products each. Rounded determinants suffice for nearly all
// triangles and are tried first.
#include "compare/problem/zero_area.hpp"

#include <array>
#include <cmath>

#include "compare/problem/expansion.hpp"

namespace ogc::compare {
namespace {

std::array<double, 3> coordinates(const Vec3& v) { return {v.x, v.y, v.z}; }

// Returns whether the projections of a, b and c on the plane of coordinates i and j lie on a line, decided exactly. A
// filter decides most cases: each factor and each product is rounded once, so the error of p − q is at most 3ε(|p| +
// |q|) + O(ε²), ε = 2⁻⁵³; 4ε covers second order.
bool on_a_line(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c,
               std::size_t i, std::size_t j) {
  const double p = (b[i] - a[i]) * (c[j] - a[j]), q = (b[j] - a[j]) * (c[i] - a[i]);
  if (std::abs(p - q) > 0x4p-53 * (std::abs(p) + std::abs(q))) return false;
  Expansion<12> sum;  // six products of two parts each
  sum.add_product(a[i], b[j]);
  sum.add_product(-a[j], b[i]);
  sum.add_product(b[i], c[j]);
  sum.add_product(-b[j], c[i]);
  sum.add_product(c[i], a[j]);
  sum.add_product(-c[j], a[i]);
  return sum.sign() == 0;
}

}  // namespace

bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto p = coordinates(a), q = coordinates(b), s = coordinates(c);
  return on_a_line(p, q, s, 0, 1) && on_a_line(p, q, s, 1, 2) && on_a_line(p, q, s, 2, 0);
}

}  // namespace ogc::compare
