// Holds exact polynomials of time, and the moments at which they vanish; the oracle decides motions with them. Only
// .cpp files of this room include this header, since it exposes CGAL's number types.
#pragma once

#include <CGAL/Mpzf.h>

#include <vector>

namespace ogc::compare {

/// The exact polynomial c₀ + c₁ t + …; the last coefficient is not 0, and the polynomial 0 has none.
struct Polynomial {
  std::vector<CGAL::Mpzf> c;  ///< coefficients, ascending

  Polynomial() = default;
  explicit Polynomial(std::vector<CGAL::Mpzf> coefficients);
  /// Returns the line from `begin` at t = 0 to `end` at t = 1; both are finite.
  static Polynomial line(double begin, double end);

  bool is_zero() const { return c.empty(); }
  std::size_t degree() const { return c.size() - 1; }  ///< only if it is not 0
  CGAL::Mpzf at(const CGAL::Mpzf& t) const;            ///< value at t
};

/// Return sum, difference and product.
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
  /// Makes a moment of a given time.
  explicit Moment(CGAL::Mpzf time);
  /// Makes a moment of the only root in the open interval of a polynomial without multiple roots.
  Moment(Polynomial square_free, CGAL::Mpzf low, CGAL::Mpzf high);

  /// Returns the sign of a polynomial at this time: −1, 0, 1.
  int sign(const Polynomial& p);
  /// Returns doubles around this time.
  MomentBracket bracket();

 private:
  void halve();
  bool is_dyadic_ = false;
  Polynomial square_free_;
  CGAL::Mpzf low_, high_;
  int sign_after_ = 0;  ///< sign of the polynomial between the root and high_
};

/// Returns the times in [0, 1] at which a polynomial that is not 0 vanishes, ascending, each once.
std::vector<Moment> moments(const Polynomial& p);

}  // namespace ogc::compare
