#include "reference/ipc/stiffness.hpp"

#include <algorithm>

namespace ogc::reference {
namespace {

/// least curvature of the barrier at curvature_distance, divided by the mean inertia
constexpr double least_curvature = 1e11;
constexpr double curvature_distance = 1e-8;  ///< divided by the diagonal of the rest box
constexpr double close_distance = 1e-9;      ///< divided by the diagonal of the rest box
constexpr double upper_over_lower = 100;

double squared(double x) { return x * x; }

}  // namespace

StiffnessBounds stiffness_bounds(const BarrierShape& shape, const StiffnessScale& scale, IpcAdaptation adaptation) {
  const double distance = curvature_distance * scale.diagonal;
  const double offset = adaptation == IpcAdaptation::gap ? shape.thickness : 0;
  double gap = distance * (distance + 2 * offset);
  if (gap >= shape.support()) gap = shape.support() / 2;
  const double curvature = 4 * squared(distance + offset) * barrier_slopes(gap, shape.support()).bend(0);
  const double lower = least_curvature * scale.inertia / curvature;
  return {lower, upper_over_lower * lower};
}

double initial_stiffness(const State& energy_gradient, const State& barrier_gradient, const StiffnessBounds& bounds) {
  double along = 0, size = 0;
  for (std::size_t v = 0; v < barrier_gradient.size(); ++v) {
    along += dot(energy_gradient[v], barrier_gradient[v]);
    size += dot(barrier_gradient[v], barrier_gradient[v]);
  }
  return size > 0 ? std::clamp(-along / size, bounds.lower, bounds.upper) : bounds.lower;
}

StiffnessGuard::StiffnessGuard(const StiffnessScale& scale, const BarrierShape& shape, IpcAdaptation adaptation)
    : near_squared_(
          squared(close_distance * scale.diagonal + (adaptation == IpcAdaptation::gap ? shape.thickness : 0))) {}

std::optional<PrimitivePair> StiffnessGuard::came_closer(const BarrierSet& set) {
  std::vector<Close> now;
  for (std::size_t i = 0; i < set.active.size(); ++i)
    if (set.squared[i] < near_squared_) now.push_back({set.active[i], set.squared[i]});
  std::optional<PrimitivePair> closer;
  for (const Close& before : close_)
    for (const Close& after : now)
      if (!closer && after.pair == before.pair && after.squared < before.squared) closer = after.pair;
  close_ = std::move(now);
  return closer;
}

}  // namespace ogc::reference
