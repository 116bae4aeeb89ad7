#include "reference/ipc/stiffness.hpp"

#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::reference;
using reference::IpcAdaptation;

TEST_CASE("stiffness: at 1e-8 diagonals the barrier's curvature is 1e11 mean inertias", "[unit]") {
  for (const double thickness : {0.0, 1e-3}) {
    const BarrierShape shape{2e-3, thickness};
    const StiffnessScale scale{1.5, 0.4};
    const StiffnessBounds bounds = stiffness_bounds(shape, scale, IpcAdaptation::gap);
    CHECK(bounds.upper == Approx(100 * bounds.lower));
    // The official code uses b'' (2 d)², without the term of b'.
    const double d = thickness + 1e-8 * 1.5, gap = shape.gap(d * d), step = 1e-4 * gap;
    const double curvature = (barrier_slopes(gap + step, shape.support()).slope[0] -
                              barrier_slopes(gap - step, shape.support()).slope[0]) /
                             (2 * step);
    CHECK(bounds.lower * curvature * 4 * d * d == Approx(1e11 * 0.4).epsilon(1e-6));
  }
}

TEST_CASE("stiffness: the start makes the gradient smallest, within its bounds", "[property]") {
  const State energy{{1, -2, 0.5}, {0, 3, 0}}, barrier{{-0.1, 0.3, 0}, {0, -0.2, 0.1}};
  const auto left = [&](double k) {
    double sum = 0;
    for (std::size_t v = 0; v < 2; ++v) {
      const Triple<double> g = energy[v] + k * barrier[v];
      sum += dot(g, g);
    }
    return sum;
  };
  const double best = initial_stiffness(energy, barrier, {0.01, 1000});
  for (double k = 0.5; k < 50; k += 0.5) CHECK(left(best) <= left(k));
  CHECK(initial_stiffness(energy, barrier, {100, 1000}) == 100);
  CHECK(initial_stiffness(energy, barrier, {0.01, 1}) == 1);
  CHECK(initial_stiffness(energy, {{0, 0, 0}, {0, 0, 0}}, {2, 200}) == 2);
}

TEST_CASE("stiffness: only a pair that was close and comes closer counts", "[unit]") {
  StiffnessGuard guard({1, 1}, {1e-3, 0}, IpcAdaptation::distance);
  const PrimitivePair a{compare::ContactSides::edge_edge, 1, 2}, b{compare::ContactSides::point_triangle, 3, 4};
  const auto at = [&](double da, double db) {
    BarrierSet set;
    set.active = {a, b};
    set.squared = {da * da, db * db};
    return guard.came_closer(set);
  };
  CHECK_FALSE(at(1e-5, 1e-5));
  CHECK_FALSE(at(0.9e-9, 1e-6));  // has just come close
  CHECK_FALSE(at(0.95e-9, 0.8e-9));
  CHECK(at(0.99e-9, 0.7e-9) == b);
  CHECK(at(0.98e-9, 1e-5) == a);
  guard.forget();
  CHECK_FALSE(at(0.1e-9, 1e-5));
}
