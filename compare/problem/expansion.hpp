// Adds products without rounding. Validation needs the exact sign of a few sums.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace ogc::compare {

/// Holds a sum as a non-overlapping expansion of at most `capacity` components (Shewchuk 1997, Grow-Expansion). The
/// last component that is not zero has the sum's sign. Products must not overflow, and their rounding errors must not
/// underflow.
template <std::size_t capacity>
class Expansion {
 public:
  /// Adds the product a b as two components.
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  /// Adds the product a b c as four components.
  void add_product(double a, double b, double c) {
    const double product = a * b;
    add_product(std::fma(a, b, -product), c);
    add_product(product, c);
  }
  /// Returns the sign of the sum: −1, 0 or 1.
  int sign() const {
    for (std::size_t i = count_; i-- > 0;)
      if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
    return 0;
  }

 private:
  void add(double value) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = value + parts_[i], part = sum - value;
      parts_[i] = (value - (sum - part)) + (parts_[i] - part);
      value = sum;
    }
    parts_[count_++] = value;
  }
  std::array<double, capacity> parts_{};
  std::size_t count_ = 0;
};

}  // namespace ogc::compare
