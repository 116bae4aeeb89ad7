// Computes values from exact margins, because quotients of margins in double can lose digits by cancellation. Computes
// derivatives from the same formulas with dual numbers.
#include "reference/geometry/edge_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/geometry/formulas.hpp"
#include "reference/geometry/sensitivity.hpp"

namespace ogc::reference {
namespace {

using Number = Dual<9>;

/// Returns the four end points relative to end_0 of the first edge. `make(value, input)` converts a coordinate to a T;
/// `input` is its index among the nine coordinates.
template <class T, class Make>
std::array<Point<T>, 4> relative_ends(const EdgePair& pair, Make make) {
  const Vec3f& o = pair.first[0];
  const std::array<Vec3f, 3> moving{pair.first[1], pair.second[0], pair.second[1]};
  std::array<Point<T>, 4> ends{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& q = moving[k];
    ends[k + 1] = {make(static_cast<double>(q.x) - o.x, 3 * k), make(static_cast<double>(q.y) - o.y, 3 * k + 1),
                   make(static_cast<double>(q.z) - o.z, 3 * k + 2)};
  }
  return ends;
}

std::array<Point<Number>, 4> seeded_ends(const EdgePair& pair) {
  return relative_ends<Number>(pair, [](double value, std::size_t input) { return Number(value, input); });
}

std::array<Point<long double>, 4> plain_ends(const EdgePair& pair) {
  return relative_ends<long double>(pair, [](double value, std::size_t) { return static_cast<long double>(value); });
}

double spread(const Number& parameter, const std::array<Point<Number>, 4>& ends) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<Number>& q = ends[k + 1];
    sum += std::abs(parameter.slope[3 * k] * q.x.value) + std::abs(parameter.slope[3 * k + 1] * q.y.value) +
           std::abs(parameter.slope[3 * k + 2] * q.z.value);
  }
  return sum;
}

double condition_of(const std::array<Number, 2>& parameters, const std::array<Point<Number>, 4>& ends) {
  const double worst = std::max({1.0, spread(parameters[0], ends), spread(parameters[1], ends)});
  return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
}

/// Returns the parameter of a point on an edge. `margin` and `other` are the point's margins from end_0 and from end_1.
Number share(const Number& margin, const Number& other) { return margin / (margin + other); }

/// Returns the parameter of the closest point on edge e. The features of both closest points are given.
double parameter_value(const std::array<Vec3f, 2>& e, EdgeFeature feature, const std::array<Vec3f, 2>& other,
                       EdgeFeature other_feature) {
  if (feature != EdgeFeature::interior) return feature == EdgeFeature::end_1 ? 1 : 0;
  if (other_feature == EdgeFeature::interior) {
    const std::array<Margin, 2> margins{turn(e[0], e[1], other[0], other[1]), turn(e[1], e[0], other[0], other[1])};
    return shares(margins)[0];
  }
  const Vec3f& end = other[static_cast<std::size_t>(other_feature)];
  const std::array<Margin, 2> margins{along(e[0], e[1], end), along(e[1], e[0], end)};
  return shares(margins)[0];
}

Number parameter_number(const Point<Number>& e0, const Point<Number>& e1, EdgeFeature feature, const Point<Number>& f0,
                        const Point<Number>& f1, EdgeFeature other_feature) {
  if (feature != EdgeFeature::interior) return Number(feature == EdgeFeature::end_1 ? 1 : 0);
  if (other_feature == EdgeFeature::interior) return share(turn(e0, e1, f0, f1), turn(e1, e0, f0, f1));
  const Point<Number>& end = other_feature == EdgeFeature::end_1 ? f1 : f0;
  return share(along(e0, e1, end), along(e1, e0, end));
}

double value_of(const Number& x) { return x.value; }
long double value_of(long double x) { return x; }

template <class T>
T clamped(const T& x) {
  return value_of(x) < 0 ? T(0) : value_of(x) > 1 ? T(1) : x;
}

/// Returns the parameters of the overlap's middle on the first edge, and of its projection on the second edge.
template <class T>
std::array<T, 2> middle_of_overlap(const std::array<Point<T>, 4>& ends) {
  const Point<T> u = ends[1] - ends[0], v = ends[3] - ends[2];
  const T s0 = clamped(T(dot(ends[2] - ends[0], u) / dot(u, u))),
          s1 = clamped(T(dot(ends[3] - ends[0], u) / dot(u, u)));
  const T s = (s0 + s1) * T(0.5);
  const Point<T> at{ends[0].x + s * u.x, ends[0].y + s * u.y, ends[0].z + s * u.z};
  return {s, clamped(T(dot(at - ends[2], v) / dot(v, v)))};
}

}  // namespace

EdgeParameters closest_parameters(const EdgePair& pair, EdgeFeatures features) {
  EdgeParameters result;
  result.values = {parameter_value(pair.first, features.first, pair.second, features.second),
                   parameter_value(pair.second, features.second, pair.first, features.first)};
  const auto ends = seeded_ends(pair);
  result.condition = condition_of(
      {parameter_number(ends[0], ends[1], features.first, ends[2], ends[3], features.second),
       parameter_number(ends[2], ends[3], features.second, ends[0], ends[1], features.first)},
      ends);
  return result;
}

EdgeParameters parallel_parameters(const EdgePair& pair) {
  EdgeParameters result;
  const auto ends = plain_ends(pair);
  const auto [s, t] = middle_of_overlap(ends);
  const Point<long double> u = ends[1] - ends[0], v = ends[3] - ends[2];
  const Point<long double> apart{ends[2].x + t * v.x - ends[0].x - s * u.x, ends[2].y + t * v.y - ends[0].y - s * u.y,
                                 ends[2].z + t * v.z - ends[0].z - s * u.z};
  result.values = {static_cast<double>(s), static_cast<double>(t)};
  result.distance = static_cast<double>(std::sqrt(dot(apart, apart)));
  const auto seeded = seeded_ends(pair);
  result.condition = condition_of(middle_of_overlap(seeded), seeded);
  return result;
}

}  // namespace ogc::reference
