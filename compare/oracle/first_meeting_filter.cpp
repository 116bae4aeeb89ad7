// Proves that two faces do not meet, by one direction: along it every vertex of one face is above every vertex of the
// other, at the beginning and at the end of a span of time. Heights are linear in time, so this also holds in between,
// and the hulls never meet. The proof holds for any direction, so rounded guesses suffice. Only the error of the
// heights matters.
//
// Let h = d·(p − q) be the height of vertex p over vertex q along d, M = Σ|d_k||p_k − q_k| as computed, and u = 2⁻⁵³. A
// computed height must exceed 8 u max(M₀, M₁) + 2⁻¹⁰⁰⁰, which is more than the sum of these errors:
//
// - h at time 0 or 1 (one rounding of the difference, one of the product, two of the sums): less than 4.001 u M
// - the height (1 − s) h₀ + s h₁ at time s, which is dyadic with few bits (two products and a sum): less than
//   2.001 u max(|h₀|, |h₁|), where |h| ≤ M (1 + 4u)
// - the rounding of M
// - underflow of products: at most five times 2⁻¹⁰⁷⁴
//
// Contraction to fused operations only reduces rounding errors. Infinity and NaN prove nothing, since each comparison
// with them fails.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/oracle/first_meeting.hpp"
#include "compare/oracle/squared_distance.hpp"

namespace ogc::compare {
namespace {

using Vector = DistanceVector<double>;
using Points = std::array<Vector, 4>;

constexpr double height_error = 0x1p-50, underflow_error = 0x1p-1000;
constexpr int most_halvings = 5;  // with more halvings the exact answer is as cheap

Vector along(const Vector& a, const Vector& b, double s) {
  return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
}

double share(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0; }

/// Returns p minus the point of the segment ab that is nearest to p.
Vector from_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector e = minus(b, a), w = minus(p, a);
  return minus(p, along(a, b, share(dot(w, e), dot(e, e))));
}

const Vector& shorter(const Vector& a, const Vector& b) { return dot(b, b) < dot(a, a) ? b : a; }

Vector toward(const Vector& normal, const Vector& side) {
  return dot(normal, side) < 0 ? Vector{-normal.x, -normal.y, -normal.z} : normal;
}

/// Returns two guesses of a direction from the second face to the first: the triangle's normal or the common normal of
/// both edges, and the vector between two near points of the faces.
std::array<Vector, 2> guesses(MeetingKind kind, const Points& x) {
  if (kind == MeetingKind::vertex_triangle) {
    const Vector n = cross(minus(x[2], x[1]), minus(x[3], x[1]));
    return {toward(n, minus(x[0], x[1])),
            shorter(shorter(from_segment(x[0], x[1], x[2]), from_segment(x[0], x[2], x[3])),
                    from_segment(x[0], x[3], x[1]))};
  }
  const auto reversed = [](const Vector& v) { return Vector{-v.x, -v.y, -v.z}; };
  const Vector n = cross(minus(x[1], x[0]), minus(x[3], x[2]));
  const Vector first = shorter(from_segment(x[0], x[2], x[3]), from_segment(x[1], x[2], x[3]));
  const Vector second = reversed(shorter(from_segment(x[2], x[0], x[1]), from_segment(x[3], x[0], x[1])));
  return {toward(n, minus(x[0], x[2])), shorter(first, second)};
}

class Filter {
 public:
  explicit Filter(const MovingPair& pair)
      : kind_(pair.kind),
        split_(kind_ == MeetingKind::edge_edge ? 2 : 1),
        from_(widen<double>(pair.from)),
        to_(widen<double>(pair.to)) {}

  bool apart(double begin, double end, int halvings) const {
    const double middle = (begin + end) / 2;
    Points x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = along(from_[k], to_[k], middle);
    for (const Vector& guess : guesses(kind_, x)) {
      const double size = std::max({std::abs(guess.x), std::abs(guess.y), std::abs(guess.z)});
      if (above({guess.x / size, guess.y / size, guess.z / size}, begin, end)) return true;
    }
    return halvings > 0 && apart(begin, middle, halvings - 1) && apart(middle, end, halvings - 1);
  }

 private:
  struct Height {
    double value, size;
  };
  static Height height(const Vector& d, const Vector& p, const Vector& q) {
    const Vector w = minus(p, q);
    return {dot(d, w), std::abs(d.x * w.x) + std::abs(d.y * w.y) + std::abs(d.z * w.z)};
  }

  /// Returns whether at all times from `begin` to `end` every vertex of the first face is higher along d than every
  /// vertex of the second face.
  bool above(const Vector& d, double begin, double end) const {
    for (std::size_t i = 0; i < split_; ++i)
      for (std::size_t j = split_; j < 4; ++j) {
        const Height h0 = height(d, from_[i], from_[j]), h1 = height(d, to_[i], to_[j]);
        const double error = height_error * std::max(h0.size, h1.size) + underflow_error;
        for (const double s : {begin, end})
          if (!((1 - s) * h0.value + s * h1.value > error)) return false;
      }
    return true;
  }

  MeetingKind kind_;
  std::size_t split_;  ///< number of vertices of the first face
  Points from_, to_;
};

}  // namespace

bool certainly_apart(const MovingPair& pair) { return Filter(pair).apart(0, 1, most_halvings); }

}  // namespace ogc::compare
