// ‖x − x_prev‖² − b² is the exact sum of 19 doubles. The difference of two floats is the sum of two doubles. Its square
// has three products of doubles, and each product is again the sum of two doubles (fma). That gives 18 for three
// coordinates; b² is one double. Every term is a multiple of 2⁻²⁹⁸ below 2²⁶⁰, so nothing under- or overflows. The sign
// of the sum is that of the last component left by Shewchuk's "grow expansion" (Adaptive Precision Floating-Point
// Arithmetic, 1997, Theorem 10).
#include "compare/oracle/certificate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

/// An exact sum a + b of doubles, as the sum high + low.
struct TwoParts {
  double high, low;
};

TwoParts two_sum(double a, double b) {
  const double sum = a + b, b_part = sum - a, a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// Keeps a sum of doubles without rounding, as components that ascend in size and do not overlap.
class ExactSum {
 public:
  void add(double value) {
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoParts parts = two_sum(value, components_[i]);
      components_[i] = parts.low;
      value = parts.high;
    }
    components_[size_++] = value;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(product);
    add(std::fma(a, b, -product));
  }
  bool positive() const {
    for (std::size_t i = size_; i-- > 0;)
      if (components_[i] != 0) return components_[i] > 0;
    return false;
  }

 private:
  std::array<double, 20> components_{};
  std::size_t size_ = 0;
};

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool exceeds(const Vec3f& x, const Vec3f& previous, float bound) {
  ExactSum margin;
  for (const auto& [now, before] :
       {std::array{x.x, previous.x}, std::array{x.y, previous.y}, std::array{x.z, previous.z}}) {
    const TwoParts difference = two_sum(double{now}, -double{before});
    margin.add_product(difference.high, difference.high);
    margin.add_product(2 * difference.high, difference.low);
    margin.add_product(difference.low, difference.low);
  }
  margin.add(-double{bound} * double{bound});
  return margin.positive();
}

}  // namespace

MotionCertificate motion_certificate(std::span<const Vec3f> positions, std::span<const Vec3f> previous,
                                     std::span<const float> bounds) {
  if (previous.size() != positions.size() || bounds.size() != positions.size())
    throw InputError("motion certificate: " + std::to_string(positions.size()) + " positions, " +
                     std::to_string(previous.size()) + " previous positions and " + std::to_string(bounds.size()) +
                     " bounds: pass the arrays of one snapshot");
  MotionCertificate certificate;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3f &x = positions[v], &p = previous[v];
    const bool meaningful = finite(x) && finite(p) && bounds[v] >= 0 && std::isfinite(bounds[v]);
    if (!meaningful || exceeds(x, p, bounds[v])) ++certificate.violations;
    const double length = std::hypot(double{x.x} - double{p.x}, double{x.y} - double{p.y}, double{x.z} - double{p.z});
    const double ratio = !meaningful   ? std::numeric_limits<double>::infinity()
                         : length == 0 ? 0
                                       : length / double{bounds[v]};
    if (ratio > certificate.worst_ratio) {
      certificate.worst_ratio = ratio;
      certificate.worst_vertex = static_cast<Index>(v);
    }
  }
  return certificate;
}

}  // namespace ogc::compare
