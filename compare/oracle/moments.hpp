// Polynomials of time without rounding, and the moments at which they vanish: what the oracle decides motions with.
// Only .cpp files of this room include this header: it shows CGAL's number types.
#pragma once

#include <CGAL/Mpzf.h>

#include <vector>

namespace ogc::compare {

/// c₀ + c₁ t + …, exactly; the last coefficient is not 0, and 0 has none.
struct Polynomial {
  std::vector<CGAL::Mpzf> c;  ///< coefficients, ascending

  Polynomial() = default;
  explicit Polynomial(std::vector<CGAL::Mpzf> coefficients);
  /// From `begin` at t = 0 straight to `end` at t = 1; both finite.
  static Polynomial line(double begin, double end);

  bool is_zero() const { return c.empty(); }
  std::size_t degree() const { return c.size() - 1; }  ///< of a polynomial that is not 0
  CGAL::Mpzf at(const CGAL::Mpzf& t) const;            ///< the value
};

/// Sum, difference and product.
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

/// Two doubles around a moment: low ≤ t ≤ high, equal or next to each other.
struct MomentBracket {
  double low = 0, high = 0;  ///< shares of the motion
};

/// A time in [0, 1] at which a polynomial vanishes, exactly: a dyadic number, or the only root of `square_free` in the
/// open interval (low, high).
class Moment {
 public:
  /// The time itself.
  explicit Moment(CGAL::Mpzf time);
  /// The only root in the open interval of a polynomial without multiple roots.
  Moment(Polynomial square_free, CGAL::Mpzf low, CGAL::Mpzf high);

  /// Sign of a polynomial at this time: −1, 0, 1.
  int sign(const Polynomial& p);
  /// Doubles around this time.
  MomentBracket bracket();

 private:
  void halve();
  bool is_dyadic_ = false;
  Polynomial square_free_;
  CGAL::Mpzf low_, high_;
  int sign_after_ = 0;  ///< of the polynomial between the root and high_
};

/// Where a polynomial that is not 0 vanishes in [0, 1], ascending, each once.
std::vector<Moment> moments(const Polynomial& p);

}  // namespace ogc::compare
