#include "reference/ipc/stopping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "reference/geometry/box_tree.hpp"
#include "reference/ipc/settings.hpp"

namespace ogc::reference {
namespace {

double diagonal_of(std::span<const compare::Vec3> positions) {
  Box box;
  for (const compare::Vec3& p : positions)
    include(box, compare::Vec3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

}  // namespace

double rest_diagonal(const compare::Scene& scene) { return diagonal_of(scene.rest_positions); }

double moving_diagonal(const compare::Scene& scene) {
  const std::vector<compare::Index> groups = rigid_groups(scene);
  double smallest = std::numeric_limits<double>::infinity();
  for (const compare::Body& body : scene.bodies) {
    const auto first = static_cast<std::size_t>(body.first_vertex), count = static_cast<std::size_t>(body.vertex_count);
    if (std::ranges::all_of(std::span(groups).subspan(first, count), [](compare::Index g) { return g >= 0; })) continue;
    smallest = std::min(smallest, diagonal_of(std::span(scene.rest_positions).subspan(first, count)));
  }
  return std::isfinite(smallest) ? smallest : rest_diagonal(scene);
}

double ipc_end_speed(const compare::Scene& scene) {
  const IpcSettings settings = ipc_settings(scene.settings);
  switch (settings.stopping) {
    case IpcStopping::displacement: return settings.tolerance * moving_diagonal(scene);
    case IpcStopping::velocity: break;
  }
  return settings.velocity_tolerance;
}

}  // namespace ogc::reference
