// Rounds a distance down to single precision; its product with γ_p is then exact in double. A b_v that is not above
// this product is safe. Exact numbers are needed only for the others.
#include "reference/definitions/bound_check.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "compare/problem/error.hpp"
#include "reference/definitions/nearest.hpp"

namespace ogc::reference {
namespace {

/// Returns whether b > γ d, or b is not finite.
bool is_above(float b, const Margin& distance, float relaxation) {
  if (static_cast<double>(b) <= static_cast<double>(relaxation) * distance_below(distance)) return false;
  return !std::isfinite(b) || scaled_distance_less(distance, relaxation, b);
}

}  // namespace

std::vector<compare::Index> bounds_above_exact(const compare::DetectIn& in, float bounds_relaxation,
                                               std::span<const float> bounds) {
  if (bounds.size() != in.positions.size()) {
    throw compare::InputError("bounds_above_exact: " + std::to_string(bounds.size()) + " bounds for " +
                              std::to_string(in.positions.size()) + " vertices; give one for each");
  }
  const std::vector<Margin> limits = limiting_distances(*in.topology, nearest_primitives(in));
  std::vector<char> above(bounds.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bounds.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t v = range.begin(); v < range.end(); ++v)
                        above[v] = in.topology->on_surface(static_cast<compare::Index>(v)) &&
                                   is_above(bounds[v], limits[v], bounds_relaxation);
                    });
  std::vector<compare::Index> result;
  for (std::size_t v = 0; v < above.size(); ++v) {
    if (above[v]) result.push_back(static_cast<compare::Index>(v));
  }
  return result;
}

}  // namespace ogc::reference
