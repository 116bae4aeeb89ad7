// Separates roots by Descartes' rule in Bernstein form: the coefficients on an open interval have as many changes of
// sign as the polynomial has roots there, or an even number more. So 0 or 1 changes of sign mean exactly 0 or 1 roots.
// Repeated halving of an interval ends if no root is multiple (Obreshkoff; Mourrain, Rouillier, Roy 2005). The greatest
// common divisor of two polynomials decides whether they share a root, so a sign of 0 is found exactly. Coefficients
// are dyadic numbers, and only ring operations are used.
#include "compare/oracle/moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ogc::compare {
namespace {

using Exact = CGAL::Mpzf;

int sign_of(const Exact& x) { return static_cast<int>(x.sign()); }

Polynomial derivative(const Polynomial& p) {
  std::vector<Exact> c;
  for (std::size_t k = 1; k < p.c.size(); ++k) c.push_back(p.c[k] * Exact(static_cast<double>(k)));
  return Polynomial(std::move(c));
}

/// Returns the largest double ≤ x, for x ≥ 0. CGAL's interval may begin one double lower.
double double_below(const Exact& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double below = x.to_interval().first;
  for (double next = std::nextafter(below, infinity); !(x < Exact(next)); next = std::nextafter(below, infinity))
    below = next;
  return below;
}

double double_above(const Exact& x) {
  const double below = double_below(x);
  return Exact(below) < x ? std::nextafter(below, std::numeric_limits<double>::infinity()) : below;
}

struct Division {
  Polynomial quotient, remainder;
};

/// Divides with a remainder: factor · a = quotient · b + remainder, where factor is not 0. b must not be 0.
Division divide(Polynomial a, const Polynomial& b) {
  std::vector<Exact> quotient;
  while (!a.is_zero() && a.c.size() >= b.c.size()) {
    const std::size_t shift = a.c.size() - b.c.size();
    const Exact lead = a.c.back(), scale = b.c.back();
    for (Exact& q : quotient) q = q * scale;
    quotient.resize(std::max(quotient.size(), shift + 1), Exact(0));
    quotient[shift] = quotient[shift] + lead;
    for (Exact& x : a.c) x = x * scale;
    for (std::size_t k = 0; k < b.c.size(); ++k) a.c[shift + k] = a.c[shift + k] - lead * b.c[k];
    a = Polynomial(std::move(a.c));
  }
  return {Polynomial(std::move(quotient)), std::move(a)};
}

/// Returns the greatest common divisor up to a factor; a and b must not both be 0.
Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.is_zero()) {
    Polynomial rest = divide(std::move(a), b).remainder;
    a = std::exchange(b, std::move(rest));
  }
  return a;
}

/// Returns Bernstein coefficients on [low, high], each up to a positive factor.
std::vector<Exact> bernstein(const Polynomial& p, const Exact& low, const Exact& high) {
  const std::size_t n = p.degree();
  const Exact width = high - low;
  std::vector<Exact> a{p.c[n]};  // coefficients of p(low + width u), by Horner's rule
  for (std::size_t i = n; i-- > 0;) {
    std::vector<Exact> next(a.size() + 1, Exact(0));
    for (std::size_t k = 0; k < a.size(); ++k) {
      next[k] = next[k] + a[k] * low;
      next[k + 1] = next[k + 1] + a[k] * width;
    }
    next[0] = next[0] + p.c[i];
    a = std::move(next);
  }
  // b_k = Σ_i (k over i)/(n over i) a_i = k!/n! Σ_i (n − i)!/(k − i)! a_i
  std::vector<Exact> b;
  for (std::size_t k = 0; k <= n; ++k) {
    Exact sum(0);
    for (std::size_t i = 0; i <= k; ++i) {
      double factor = 1;
      for (std::size_t f = k - i + 1; f <= n - i; ++f) factor *= static_cast<double>(f);
      sum = sum + a[i] * Exact(factor);
    }
    b.push_back(std::move(sum));
  }
  return b;
}

std::size_t changes_of_sign(const std::vector<Exact>& b) {
  std::size_t changes = 0;
  int last = 0;
  for (const Exact& x : b) {
    const int sign = sign_of(x);
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

void separate(const Polynomial& p, const Exact& low, const Exact& high, std::vector<Moment>& found) {
  const std::size_t changes = changes_of_sign(bernstein(p, low, high));
  if (changes == 0) return;
  if (changes == 1) {
    found.emplace_back(p, low, high);
    return;
  }
  const Exact middle = (low + high) * Exact(0.5);
  separate(p, low, middle, found);
  if (sign_of(p.at(middle)) == 0) found.emplace_back(middle);
  separate(p, middle, high, found);
}

}  // namespace

Polynomial::Polynomial(std::vector<Exact> coefficients) : c(std::move(coefficients)) {
  while (!c.empty() && c.back().is_zero()) c.pop_back();
}

Polynomial Polynomial::line(double begin, double end) { return Polynomial({Exact(begin), Exact(end) - Exact(begin)}); }

Exact Polynomial::at(const Exact& t) const {
  Exact value(0);
  for (std::size_t k = c.size(); k-- > 0;) value = value * t + c[k];
  return value;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  std::vector<Exact> c = a.c;
  c.resize(std::max(a.c.size(), b.c.size()), Exact(0));
  for (std::size_t k = 0; k < b.c.size(); ++k) c[k] = c[k] + b.c[k];
  return Polynomial(std::move(c));
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  std::vector<Exact> c = a.c;
  c.resize(std::max(a.c.size(), b.c.size()), Exact(0));
  for (std::size_t k = 0; k < b.c.size(); ++k) c[k] = c[k] - b.c[k];
  return Polynomial(std::move(c));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Exact> c(a.c.size() + b.c.size() - 1, Exact(0));
  for (std::size_t i = 0; i < a.c.size(); ++i)
    for (std::size_t k = 0; k < b.c.size(); ++k) c[i + k] = c[i + k] + a.c[i] * b.c[k];
  return Polynomial(std::move(c));
}

Moment::Moment(Exact time) : is_dyadic_(true), low_(time), high_(std::move(time)) {}

Moment::Moment(Polynomial square_free, Exact low, Exact high)
    : square_free_(std::move(square_free)), low_(std::move(low)), high_(std::move(high)) {
  // Just below `high` the polynomial has the sign of its last Bernstein coefficient that is not 0.
  const std::vector<Exact> b = bernstein(square_free_, low_, high_);
  for (std::size_t k = b.size(); k-- > 0 && sign_after_ == 0;) sign_after_ = sign_of(b[k]);
}

void Moment::halve() {
  const Exact middle = (low_ + high_) * Exact(0.5);
  const int sign = sign_of(square_free_.at(middle));
  if (sign == 0) {
    *this = Moment(middle);
  } else {
    (sign == sign_after_ ? high_ : low_) = middle;
  }
}

int Moment::sign(const Polynomial& p) {
  if (p.is_zero()) return 0;
  if (is_dyadic_) return sign_of(p.at(low_));
  if (p.degree() == 0) return sign_of(p.c[0]);
  // The only root that a common divisor can have in the interval is this time, and it is simple.
  const Polynomial common = common_divisor(square_free_, p);
  if (common.degree() > 0 && changes_of_sign(bernstein(common, low_, high_)) % 2 == 1) return 0;
  while (!is_dyadic_) {
    const std::vector<Exact> b = bernstein(p, low_, high_);
    if (changes_of_sign(b) == 0)
      for (const Exact& x : b)
        if (const int sign = sign_of(x); sign != 0) return sign;
    halve();
  }
  return sign_of(p.at(low_));
}

MomentBracket Moment::bracket() {
  while (true) {
    const MomentBracket found{double_below(low_), double_above(high_)};
    if (is_dyadic_ || !(std::nextafter(found.low, std::numeric_limits<double>::infinity()) < found.high)) return found;
    halve();
  }
}

std::vector<Moment> moments(const Polynomial& p) {
  std::vector<Moment> found;
  if (p.is_zero() || p.degree() == 0) return found;
  const Polynomial simple = divide(p, common_divisor(p, derivative(p))).quotient;
  const Exact zero(0), one(1);
  if (sign_of(simple.at(zero)) == 0) found.emplace_back(zero);
  separate(simple, zero, one, found);
  if (sign_of(simple.at(one)) == 0) found.emplace_back(one);
  return found;
}

}  // namespace ogc::compare
