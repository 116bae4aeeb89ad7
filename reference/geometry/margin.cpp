// Tries double with an error bound first, then intervals, then exact numbers. About one in ten thousand random cases
// needs exact numbers. Regular meshes whose coordinates have few digits need none, because interval arithmetic rounds
// nothing there.
#include "reference/geometry/margin.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "compare/stages/numbers.hpp"
#include "reference/geometry/filter_counts.hpp"
#include "reference/geometry/formulas.hpp"
#include "reference/geometry/sensitivity.hpp"

namespace ogc::reference {
namespace {

using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// Sets the rounding mode that intervals need; the destructor restores the old mode.
using UpwardRounding = CGAL::Protect_FPU_rounding<true>;

// Filtered begins with the kinds of margins, in the order of MarginKind.
static_assert(static_cast<int>(Filtered::along) == static_cast<int>(MarginKind::along) &&
              static_cast<int>(Filtered::gap_lines) == static_cast<int>(MarginKind::gap_lines));

template <class T>
using Points = std::array<Point<T>, 4>;

template <class T>
Points<T> widen(const Margin& margin) {
  Points<T> points;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3f& p = margin.at[i];
    points[i] = {T(static_cast<double>(p.x)), T(static_cast<double>(p.y)), T(static_cast<double>(p.z))};
  }
  return points;
}

/// Returns the degree of the margin in the coordinates.
int degree(MarginKind kind) {
  switch (kind) {
    case MarginKind::along:
    case MarginKind::gap_points: return 2;
    case MarginKind::side:
    case MarginKind::turn:
    case MarginKind::parallel:
    case MarginKind::gap_line: return 4;
    case MarginKind::gap_plane:
    case MarginKind::gap_lines: break;
  }
  return 6;
}

template <class T>
Quotient<T> squared_distance(MarginKind kind, const Points<T>& at) {
  switch (kind) {
    case MarginKind::gap_points: return squared_distance_points(at[0], at[1]);
    case MarginKind::gap_line: return squared_distance_line(at[0], at[1], at[2]);
    case MarginKind::gap_plane: return squared_distance_plane(at[0], at[1], at[2], at[3]);
    case MarginKind::gap_lines: return squared_distance_lines(at[0], at[1], at[2], at[3]);
    case MarginKind::along:
    case MarginKind::side:
    case MarginKind::turn:
    case MarginKind::parallel: break;
  }
  throw std::logic_error("squared_distance: this margin is no gap");
}

template <class T>
T evaluate(MarginKind kind, const Points<T>& at, const T& radius) {
  switch (kind) {
    case MarginKind::along: return along(at[0], at[1], at[2]);
    case MarginKind::side: return side(at[0], at[1], at[2], at[3]);
    case MarginKind::turn: return turn(at[0], at[1], at[2], at[3]);
    case MarginKind::parallel: return parallel(at[0], at[1], at[2], at[3]);
    case MarginKind::gap_points:
    case MarginKind::gap_line:
    case MarginKind::gap_plane:
    case MarginKind::gap_lines: break;
  }
  const Quotient<T> d = squared_distance(kind, at);
  return d.numerator - radius * radius * d.denominator;
}

template <class T>
T evaluate(const Margin& margin) {
  return evaluate(margin.kind, widen<T>(margin), T(static_cast<double>(margin.radius)));
}

/// Returns the sign if the interval has only one.
std::optional<int> sign_of(const Interval& value) {
  if (value.inf() > 0) return 1;
  if (value.sup() < 0) return -1;
  if (value.inf() == 0 && value.sup() == 0) return 0;
  return std::nullopt;
}

std::optional<int> interval_sign(const Margin& margin) {
  const UpwardRounding rounding;
  return sign_of(evaluate<Interval>(margin));
}

/// Returns the difference of two squared distances, times the product of their (positive) denominators.
template <class T>
T difference(const Margin& a, const Margin& b) {
  const Quotient<T> p = squared_distance(a.kind, widen<T>(a)), q = squared_distance(b.kind, widen<T>(b));
  return p.numerator * q.denominator - q.numerator * p.denominator;
}

std::optional<int> interval_order(const Margin& a, const Margin& b) {
  const UpwardRounding rounding;
  return sign_of(difference<Interval>(a, b));
}

int exact_sign(const Margin& margin) { return static_cast<int>(evaluate<Exact>(margin).sign()); }

/// Returns the points relative to the first one in double: the coordinates δ of the grey zone.
std::array<std::array<double, 3>, 4> relative(const Margin& margin) {
  std::array<std::array<double, 3>, 4> delta{};
  const Vec3f& o = margin.at[0];
  for (std::size_t i = 1; i < 4; ++i) {
    const Vec3f& p = margin.at[i];
    delta[i] = {static_cast<double>(p.x) - o.x, static_cast<double>(p.y) - o.y, static_cast<double>(p.z) - o.z};
  }
  return delta;
}

template <class T>
Points<T> constants(const std::array<std::array<double, 3>, 4>& delta) {
  Points<T> points;
  for (std::size_t i = 0; i < 4; ++i) points[i] = {T(delta[i][0]), T(delta[i][1]), T(delta[i][2])};
  return points;
}

/// Returns Σ|sᵢxᵢ|.
double spread(const Point<double>& slope, const Point<double>& x) {
  return std::abs(slope.x * x.x) + std::abs(slope.y * x.y) + std::abs(slope.z * x.z);
}

Point<double> operator*(double s, const Point<double>& a) { return {s * a.x, s * a.y, s * a.z}; }
Point<double> operator+(const Point<double>& a, const Point<double>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// Returns Σ|∂m/∂δᵢ||δᵢ| for `side`. m = (e × p)·(e × c): ∂m/∂p = (e × c) × e, ∂m/∂c = (e × p) × e, ∂m/∂e = p × (e × c)
/// + c × (e × p).
double side_sensitivity(const Points<double>& at) {
  const Point<double>&e = at[1], &c = at[2], &p = at[3], to_c = cross(e, c), to_p = cross(e, p);
  return spread(cross(to_c, e), p) + spread(cross(to_p, e), c) + spread(cross(p, to_c) + cross(c, to_p), e);
}

/// Returns Σ|∂m/∂δᵢ||δᵢ| for `turn`. m = (q × v)·(x × v) with v = q₁ − q and the points x, q, q₁: ∂m/∂x = v × (q × v),
/// at constant v ∂m/∂q = v × (x × v), and ∂m/∂v = (x × v) × q + (q × v) × x. ∂m/∂v is added for q₁ and subtracted for
/// q.
double turn_sensitivity(const Points<double>& at) {
  const Point<double>&x = at[1], &q = at[2], v = at[3] - q, of_q = cross(q, v), of_x = cross(x, v),
        by_v = cross(of_x, q) + cross(of_q, x);
  return spread(cross(v, of_q), x) + spread(cross(v, of_x) - by_v, q) + spread(by_v, at[3]);
}

/// Returns Σ|∂m/∂δᵢ||δᵢ| for `parallel`. m = 10⁶ c·c − (u·u)(v·v) with c = u × v: ∂m/∂u = 2·10⁶ v × c − 2 (v·v) u,
/// ∂m/∂v = 2·10⁶ c × u − 2 (u·u) v.
double parallel_sensitivity(const Points<double>& at) {
  const Point<double>&u = at[1], v = at[3] - at[2], c = cross(u, v);
  const Point<double> by_u = 2e6 * cross(v, c) - 2 * dot(v, v) * u, by_v = 2e6 * cross(c, u) - 2 * dot(u, u) * v;
  return spread(by_u, u) + spread(by_v, at[2]) + spread(by_v, at[3]);
}

/// Returns Σ|∂m/∂δᵢ||δᵢ| for a point's gap from a line. m = c·c − r² e·e with c = e × p: ∂m/∂p = 2 c × e, ∂m/∂e = 2 (p
/// × c − r² e).
double line_sensitivity(const Points<double>& at, double radius) {
  const Point<double>&e = at[1], &p = at[2], c = cross(e, p);
  return 2 * (spread(cross(c, e), p) + spread(cross(p, c) - radius * radius * e, e));
}

/// Returns Σ|∂m/∂δᵢ||δᵢ| for the gap between two lines, or of a point from a plane. m = (w·n)² − r² n·n with n = u × v,
/// s = 2 w·n and g = ∂m/∂n = s w − 2 r² n: ∂m/∂w = s n, ∂m/∂u = v × g, ∂m/∂v = g × u. The points are u, v, w for a
/// plane, u, w, w + v for two lines.
double gap_sensitivity(const Points<double>& at, double radius, bool is_plane) {
  const Point<double>&u = at[1], w = is_plane ? at[3] : at[2], v = is_plane ? at[2] : at[3] - at[2], n = cross(u, v);
  const double s = 2 * dot(w, n);
  const Point<double> g = s * w - 2 * radius * radius * n, by_u = cross(v, g), by_v = cross(g, u), by_w = s * n;
  if (is_plane) return spread(by_u, u) + spread(by_v, v) + spread(by_w, w);
  return spread(by_u, u) + spread(by_w - by_v, w) + spread(by_v, at[3]);
}

/// Returns Σ|∂m/∂δᵢ||δᵢ|. Uses explicit derivatives for speed, because every doubtful decision needs this sum. `delta`
/// is the result of `relative`.
double sensitivity_at(const Margin& margin, const std::array<std::array<double, 3>, 4>& delta) {
  const Points<double> at = constants<double>(delta);
  switch (margin.kind) {
    case MarginKind::along:
      return 2 * (std::abs(at[1].x * at[2].x) + std::abs(at[1].y * at[2].y) + std::abs(at[1].z * at[2].z));
    case MarginKind::side: return side_sensitivity(at);
    case MarginKind::turn: return turn_sensitivity(at);
    case MarginKind::parallel: return parallel_sensitivity(at);
    case MarginKind::gap_points: return 2 * dot(at[1], at[1]);
    case MarginKind::gap_line: return line_sensitivity(at, margin.radius);
    case MarginKind::gap_plane:
    case MarginKind::gap_lines: break;
  }
  return gap_sensitivity(at, margin.radius, margin.kind == MarginKind::gap_plane);
}

/// Largest error of a value in double, relative to its modulus. At most 18 roundings lie between a coordinate and a
/// margin. The gap from a plane has the most:
///   its normal n                    4: two differences, a product, a difference
///   its height n·(p − a)        4 + 4: a difference, a product, two sums
///   the square of the height    2 · 8 + 1
///   minus r² n²                     1
/// The modulus may be too small by the same error. Nothing overflows or underflows: terms lie between 2⁻¹⁴⁹ˣ⁶ and
/// 2¹²⁹ˣ⁶.
constexpr double rounding = 0x1p-48;

/// Returns the margin in double, with the sum of the moduli of its terms.
Measured measured(const Margin& margin, const std::array<std::array<double, 3>, 4>& delta) {
  return evaluate(margin.kind, constants<Measured>(delta), Measured(margin.radius));
}

/// Returns x rounded to long double from two doubles, which hold at least the leading 106 bits of x.
long double to_long_double(const Exact& x) {
  const double high = x.to_double();
  const Exact rest = x - Exact(high);
  return static_cast<long double>(high) + static_cast<long double>(rest.to_double());
}

/// Returns the largest single-precision number that is not above x ≥ 0.
float round_down(double x) {
  if (x > static_cast<double>(std::numeric_limits<float>::max())) return std::numeric_limits<float>::max();
  const float f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, 0.0f) : f;
}

/// Returns an interval that holds the distance. It is [0, ∞) if the interval of the denominator holds 0.
std::pair<double, double> distance_interval(const Margin& gap) {
  const UpwardRounding upwards;
  const Quotient<Interval> squared = squared_distance(gap.kind, widen<Interval>(gap));
  if (!(squared.denominator.inf() > 0)) return {0, std::numeric_limits<double>::infinity()};
  const Interval ratio = squared.numerator / squared.denominator;
  const Interval root = CGAL::sqrt(Interval(std::max(0.0, ratio.inf()), ratio.sup()));
  return {root.inf(), root.sup()};
}

/// Returns m / √q, both exact; returns 0 for q = 0.
double over_root(const Exact& m, const Exact& q) {
  if (q.is_zero()) return 0;
  return static_cast<double>(to_long_double(m) / std::sqrt(to_long_double(q)));
}

/// Returns the distance rounded down; f must be close to it. The distance is at least f if the gap with radius f is not
/// negative.
float settle_below(const Margin& gap, float f) {
  while (f > 0 && exact_sign(with_radius(gap, f)) < 0) f = std::nextafter(f, 0.0f);
  for (;;) {
    const float next = std::nextafter(f, std::numeric_limits<float>::infinity());
    if (!std::isfinite(next) || exact_sign(with_radius(gap, next)) < 0) return f;
    f = next;
  }
}

int filtered_sign(const Margin& margin, const Measured& m) {
  const auto predicate = static_cast<Filtered>(margin.kind);
  if (std::abs(m.value) > rounding * m.modulus || m.modulus == 0) {
    count_filter(predicate, false);
    return m.value > 0 ? 1 : m.value < 0 ? -1 : 0;
  }
  const std::optional<int> decided = interval_sign(margin);
  count_filter(predicate, !decided);
  return decided ? *decided : exact_sign(margin);
}

/// Returns an interval that holds the distance; (1, 0) if nothing is known. The numerator is the square of a number or
/// of a vector. Each component has an error of at most `rounding` times its modulus. So the numerator's root has an
/// error of at most `rounding` times the root of the numerator's modulus.
std::pair<double, double> filtered_distance(const Margin& gap) {
  const Quotient<Measured> squared = squared_distance(gap.kind, constants<Measured>(relative(gap)));
  const Measured& d = squared.denominator;
  const double least = d.value - rounding * d.modulus;
  if (!(least > 0)) return {1, 0};
  // The factors of `low` and of the result cover six roundings: two roots, their quotient, the slack and the sums.
  const double root = std::sqrt(squared.numerator.value), slack = rounding * std::sqrt(squared.numerator.modulus);
  const double low = std::max(0.0, root - slack) / std::sqrt(d.value + rounding * d.modulus) * (1 - 0x1p-50);
  return {low, (root + slack) / std::sqrt(least) * (1 + 0x1p-50)};
}

/// Returns Σ|δᵢ|.
double size(const Margin& margin) {
  double sum = 0;
  for (const auto& point : relative(margin))
    for (const double x : point) sum += std::abs(x);
  return sum;
}

}  // namespace

double sensitivity(const Margin& margin) { return sensitivity_at(margin, relative(margin)); }

int sign(const Margin& margin) { return filtered_sign(margin, measured(margin, relative(margin))); }

int compare_distances(const Margin& a, const Margin& b) {
  const std::optional<int> decided = interval_order(a, b);
  count_filter(Filtered::nearer, !decided);
  return decided ? *decided : static_cast<int>(difference<Exact>(a, b).sign());
}

std::string squared_distance(const Margin& gap, float scale) {
  const Quotient<Exact> d = squared_distance(gap.kind, widen<Exact>(gap));
  const Exact s(static_cast<double>(scale));
  std::ostringstream text;
  text << CGAL::Gmpq(s * s * d.numerator) / CGAL::Gmpq(d.denominator);
  return text.str();
}

MarginAnswer examine(const Margin& margin) {
  const auto delta = relative(margin);
  const Measured m = measured(margin, delta);
  MarginAnswer answer{filtered_sign(margin, m), false, false, m.value, rounding * m.modulus};
  const double modulus = std::abs(m.value);
  // The sum `reach` is at most degree · m.modulus. It is not computed if this limit shows that the margin is neither
  // grey nor near. The factor 2 covers the roundings of m.
  if (modulus > 2 * compare::near_factor * degree(margin.kind) * m.modulus) return answer;
  const double reach = sensitivity_at(margin, delta);
  answer.grey = reach > 0 && modulus <= compare::grey_factor * reach;
  answer.near = modulus <= compare::near_factor * reach;
  return answer;
}

bool grey(const Margin& margin) {
  const auto delta = relative(margin);
  const Measured m = measured(margin, delta);
  if (std::abs(m.value) > 2 * compare::grey_factor * degree(margin.kind) * m.modulus) return false;
  const double reach = compare::grey_factor * sensitivity_at(margin, delta);
  return reach > 0 && std::abs(m.value) <= reach;
}

double distance(const Margin& gap) {
  const Quotient<Exact> squared = squared_distance(gap.kind, widen<Exact>(gap));
  return static_cast<double>(std::sqrt(to_long_double(squared.numerator) / to_long_double(squared.denominator)));
}

GapDistance measure(const Margin& gap) {
  auto [low, high] = filtered_distance(gap);
  if (!(low <= high) || round_down(low) != round_down(high)) std::tie(low, high) = distance_interval(gap);
  GapDistance answer{low + (high - low) / 2, round_down(low)};
  const float last = round_down(high), next = std::nextafter(answer.below, last);
  const bool known = answer.below == last, one_left = !known && next == last;
  if (!known || !(high - low <= 0x1p-40 * std::max(low, size(gap)))) answer.distance = distance(gap);
  if (known || !one_left) count_filter(Filtered::distance_below, !known);
  if (!known && !one_left) answer.below = settle_below(gap, round_down(answer.distance));
  if (!one_left) return answer;
  // The distance rounded down is `below` or `next`. In most of these cases the exact distance equals `next`.
  const Margin about_next = with_radius(gap, next);
  const std::optional<int> decided = interval_sign(about_next);
  count_filter(Filtered::distance_below, !decided);
  if ((decided ? *decided : exact_sign(about_next)) >= 0) answer.below = next;
  return answer;
}

float distance_below(const Margin& gap) { return measure(gap).below; }

bool scaled_distance_less(const Margin& gap, float scale, float b) {
  const Quotient<Exact> d = squared_distance(gap.kind, widen<Exact>(gap));
  const Exact s(static_cast<double>(scale)), limit(static_cast<double>(b));
  return static_cast<int>((s * s * d.numerator - limit * limit * d.denominator).sign()) < 0;
}

double signed_length(const Margin& margin) {
  const auto at = widen<Exact>(margin);
  const Exact radius(static_cast<double>(margin.radius));
  const auto e = at[1] - at[0];
  switch (margin.kind) {
    case MarginKind::along: return over_root(evaluate<Exact>(margin), dot(e, e));
    case MarginKind::side: {
      const auto n = cross(e, at[2] - at[0]);
      return over_root(evaluate<Exact>(margin), dot(e, e) * dot(n, n));
    }
    case MarginKind::turn:
    case MarginKind::parallel: throw std::logic_error("signed_length: this margin is no length");
    case MarginKind::gap_points:
    case MarginKind::gap_line:
    case MarginKind::gap_plane:
    case MarginKind::gap_lines: break;
  }
  const Quotient<Exact> d = squared_distance(margin.kind, at);  // d − r = (d² − r²) / (d + r)
  if (d.denominator.is_zero()) return 0;
  const long double length = std::sqrt(to_long_double(d.numerator) / to_long_double(d.denominator));
  const long double sum = length + to_long_double(radius);
  return sum > 0 ? static_cast<double>(to_long_double(evaluate<Exact>(margin)) / to_long_double(d.denominator) / sum)
                 : 0;
}

std::vector<double> shares(std::span<const Margin> margins) {
  std::vector<Exact> values;
  Exact sum(0);
  for (const Margin& margin : margins) {
    values.push_back(evaluate<Exact>(margin));
    sum = sum + values.back();
  }
  const long double whole = to_long_double(sum);
  std::vector<double> result;
  for (const Exact& value : values) result.push_back(static_cast<double>(to_long_double(value) / whole));
  return result;
}

}  // namespace ogc::reference
