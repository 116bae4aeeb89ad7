// Finds the sign of a sum of doubles without rounding, by Shewchuk's growing expansion (1997). The judge uses it to
// decide by itself whether a stored position obeys its bound, so that this decision does not depend on a contestant's
// arithmetic.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/truncate.hpp"

namespace ogc::compare {

/// A sum without rounding. Terms and products must neither overflow nor fall below 2⁻¹⁰⁷⁴, which holds for squares of
/// single-precision inputs.
class ExactSum {
 public:
  /// Adds a term.
  void add(double term) {
    std::size_t kept = 0;
    for (const double part : parts_) {
      const double sum = term + part, back = sum - term;
      const double error = (term - (sum - back)) + (part - back);
      if (error != 0) parts_[kept++] = error;
      term = sum;
    }
    parts_.resize(kept);
    if (term != 0) parts_.push_back(term);
  }
  /// Adds a · b.
  void add_product(double a, double b) {
    const double product = a * b;
    add(product);
    add(std::fma(a, b, -product));
  }
  /// Returns −1, 0 or 1. The last part has the sign of the sum, because parts do not overlap and their magnitudes
  /// increase.
  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

 private:
  std::vector<double> parts_;
};

/// Checks exactly whether ‖x − p‖ ≤ b. Sums x² − 2xp + p² by coordinate, because products of two floats are exact in
/// double. All numbers must be finite.
inline bool obeys_bound(const Vec3f& x, const Vec3f& p, float b) {
  ExactSum margin;
  for (const auto [a, c] : {std::array{x.x, p.x}, std::array{x.y, p.y}, std::array{x.z, p.z}}) {
    margin.add(double{a} * a);
    margin.add(-2 * (double{a} * c));
    margin.add(double{c} * c);
  }
  margin.add(-(double{b} * b));
  return margin.sign() <= 0;
}

/// Checks exactly whether n·x ≤ o. All numbers must be finite.
inline bool obeys_half_space(const Vec3f& x, const HalfSpace& half_space) {
  const Vec3f& n = half_space.normal;
  ExactSum margin;
  margin.add(double{n.x} * x.x);
  margin.add(double{n.y} * x.y);
  margin.add(double{n.z} * x.z);
  margin.add(-half_space.offset);
  return margin.sign() <= 0;
}

}  // namespace ogc::compare
