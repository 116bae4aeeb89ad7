// Makes motions of a vertex and a triangle, or of two edges, that approach difficult cases: vanishing gaps and angles,
// needles, near misses, slides, high speeds.
#pragma once

#include <cmath>
#include <random>

#include "tests/reference/ipc/exact_meeting.hpp"

namespace ogc::tests {

struct PairMotion {
  bool edges = false;
  Points4 x{}, delta{};
};

class MotionLadder {
 public:
  explicit MotionLadder(unsigned seed) : engine_(seed) {}

  /// Returns case i. Odd cases are edges; the rungs repeat in cycles.
  PairMotion next(int i) {
    PairMotion m;
    m.edges = i % 2 == 1;
    shape(m, i);
    const double gap = rung(i / 2, 15);
    lift(m, gap);
    move(m, i, gap);
    place(m);
    return m;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  static double rung(int i, int bottom) { return std::pow(10.0, -(i % (bottom + 1))); }

  /// Places touching primitives in the plane z = 0. A vertex lies inside the triangle, on its boundary or outside. Two
  /// edges cross, meet at an end or miss each other.
  void shape(PairMotion& m, int i) {
    const double slender = i % 5 == 0 ? rung(i / 10, 12) : 1,
                 miss = (i % 3 == 0 ? rung(i / 6, 14) : 0) * (i % 4 < 2 ? 1 : -1);
    if (m.edges) {
      const double s = i % 3 == 0 ? miss : between(0, 1), t = i % 7 == 0 ? miss : between(0, 1),
                   angle = slender * between(0.1, 1.5);
      m.x[0] = {-s, 0, 0}, m.x[1] = {1 - s, 0, 0};
      m.x[2] = {-t * std::cos(angle), -t * std::sin(angle), 0},
      m.x[3] = {(1 - t) * std::cos(angle), (1 - t) * std::sin(angle), 0};
      return;
    }
    m.x[1] = {0, 0, 0}, m.x[2] = {between(0.5, 1), 0, 0}, m.x[3] = {between(-0.5, 1), slender * between(0.3, 1), 0};
    const double a = i % 3 == 0 ? miss : between(0, 0.5), b = between(0, 0.5);
    for (std::size_t k = 0; k < 2; ++k)
      m.x[0][k] = m.x[1][k] + a * (m.x[2][k] - m.x[1][k]) + b * (m.x[3][k] - m.x[1][k]);
  }

  void lift(PairMotion& m, double gap) {
    for (std::size_t k = 0; k < (m.edges ? 2u : 1u); ++k) m.x[k][2] += gap;
  }

  /// Moves the first primitive down by 0.4 to 2.5 gaps and along the plane. In half of the cases every vertex also has
  /// a motion of its own.
  void move(PairMotion& m, int i, double gap) {
    const double down = gap * std::pow(10.0, between(-0.4, 0.4)), slide = i % 4 == 3   ? between(0, 1)
                                                                          : i % 4 == 2 ? gap
                                                                                       : 0;
    const double own = i % 8 < 4 ? 0 : gap * between(0, 2);
    const double turn = between(0, 6.283);
    for (std::size_t k = 0; k < 4; ++k) {
      const bool upper = m.edges ? k < 2 : k < 1;
      m.delta[k] = {upper ? slide * std::cos(turn) : 0, upper ? slide * std::sin(turn) : 0, upper ? -down : 0};
      for (double& d : m.delta[k]) d += own * between(-1, 1);
    }
  }

  /// Rotates the case, scales it to the size of a cloth's triangles, shifts it from the origin and adds a common
  /// velocity. Rounds coordinates so that the exact decision can represent them.
  void place(PairMotion& m) {
    std::array<std::array<double, 3>, 3> q{};
    const double a = between(0, 6.283), b = between(0, 6.283), size = std::pow(10.0, between(-3, 0));
    q[0] = {std::cos(a), -std::sin(a) * std::cos(b), std::sin(a) * std::sin(b)};
    q[1] = {std::sin(a), std::cos(a) * std::cos(b), -std::cos(a) * std::sin(b)};
    q[2] = {0, std::sin(b), std::cos(b)};
    const reference::Triple<double> shift{between(-1, 1), between(-1, 1), between(-1, 1)},
        common{between(-1, 1), between(-1, 1), 0};
    const auto turned = [&](const reference::Triple<double>& p, const reference::Triple<double>& offset) {
      reference::Triple<double> r;
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = offset[k] + size * (q[k][0] * p[0] + q[k][1] * p[1] + q[k][2] * p[2]);
        r[k] = std::ldexp(std::nearbyint(std::ldexp(c, exact_bits / 2)), -exact_bits / 2);
      }
      return r;
    };
    for (std::size_t k = 0; k < 4; ++k) m.x[k] = turned(m.x[k], shift), m.delta[k] = turned(m.delta[k], common);
  }

  std::mt19937 engine_;
};

}  // namespace ogc::tests
