// Decides intersections by brute force, to check the oracle with another method and another type of numbers. Points of
// a segment and of a triangle are convex combinations. So the two meet exactly if the linear system Σλ = 1, Σμ = 1, Σλᵢ
// sᵢ = Σμⱼ tⱼ has a solution λ, μ ≥ 0. Then one of its basic solutions is non-negative. All 31 sets of columns are
// tried in rational arithmetic. The method distinguishes no cases, so degenerate configurations need no care.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::tests {

using Rational = boost::multiprecision::cpp_rational;
using Row = std::vector<Rational>;

/// Returns whether the system of five equations has exactly one solution, and the solution is non-negative. The system
/// has one unknown for each column; the last number of a row is the right-hand side of its equation.
inline bool solved_by_non_negative(std::vector<Row> rows, std::size_t unknowns) {
  for (std::size_t pivot = 0; pivot < unknowns; ++pivot) {
    std::size_t row = pivot;
    while (row < rows.size() && rows[row][pivot] == 0) ++row;
    if (row == rows.size()) return false;
    std::swap(rows[row], rows[pivot]);
    for (std::size_t other = 0; other < rows.size(); ++other) {
      if (other == pivot || rows[other][pivot] == 0) continue;
      const Rational factor = rows[other][pivot] / rows[pivot][pivot];
      for (std::size_t k = pivot; k <= unknowns; ++k) rows[other][k] -= factor * rows[pivot][k];
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Rational& right = rows[i][unknowns];
    if (i < unknowns ? right / rows[i][i] < 0 : right != 0) return false;
  }
  return true;
}

/// Returns whether the hulls of `segment` and `triangle` share a point.
inline bool hulls_meet(const std::array<compare::Vec3, 2>& segment, const std::array<compare::Vec3, 3>& triangle) {
  std::array<Row, 5> columns;
  for (std::size_t i = 0; i < 5; ++i) {
    const compare::Vec3& point = i < 2 ? segment[i] : triangle[i - 2];
    const int sign = i < 2 ? 1 : -1;
    columns[i] = {i < 2 ? 1 : 0, i < 2 ? 0 : 1, sign * Rational(point.x), sign * Rational(point.y),
                  sign * Rational(point.z)};
  }
  for (unsigned set = 1; set < 32; ++set) {
    std::vector<Row> rows(5);
    std::size_t unknowns = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      if ((set >> i & 1) == 0) continue;
      for (std::size_t k = 0; k < 5; ++k) rows[k].push_back(columns[i][k]);
      ++unknowns;
    }
    for (std::size_t k = 0; k < 5; ++k) rows[k].push_back(k < 2 ? 1 : 0);
    if (solved_by_non_negative(std::move(rows), unknowns)) return true;
  }
  return false;
}

}  // namespace ogc::tests
