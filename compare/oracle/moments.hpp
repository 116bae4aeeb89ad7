// Defines exact polynomials of time and the moments at which they vanish. The oracle decides with them whether moving
// faces meet. Only .cpp files of compare/oracle include this header, since it exposes CGAL's number types.
#pragma once

#include <CGAL/Mpzf.h>

#include <vector>

namespace ogc::compare {

/// The exact polynomial c₀ + c₁ t + …. The last coefficient is not 0; the zero polynomial has no coefficients.
struct Polynomial {
  std::vector<CGAL::Mpzf> c;  ///< coefficients, ascending

  Polynomial() = default;
  explicit Polynomial(std::vector<CGAL::Mpzf> coefficients);
  /// Returns the line from `begin` at t = 0 to `end` at t = 1; both must be finite.
  static Polynomial line(double begin, double end);

  bool is_zero() const { return c.empty(); }
  std::size_t degree() const { return c.size() - 1; }  ///< not defined for the zero polynomial
  CGAL::Mpzf at(const CGAL::Mpzf& t) const;            ///< value at t
};

/// Return sum, difference and product.
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

/// Two doubles around a moment: low ≤ t ≤ high, equal or adjacent.
struct MomentBracket {
  double low = 0, high = 0;  ///< fractions of the motion
};

/// An exact time in [0, 1] at which a polynomial vanishes: a dyadic number, or the only root of `square_free` in the
/// open interval (low, high).
class Moment {
 public:
  /// Makes a moment of a given time.
  explicit Moment(CGAL::Mpzf time);
  /// Makes a moment of the only root of a polynomial in the open interval; the polynomial must not have multiple roots.
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

/// Returns the times in [0, 1] at which a polynomial vanishes, ascending and without repetition. The polynomial must
/// not be 0.
std::vector<Moment> moments(const Polynomial& p);

}  // namespace ogc::compare
