// Measures scenes with stitches, for their tests: gaps, intersections and strains at the start, and the steps of
// prescribed vertices.
#pragma once

#include <algorithm>
#include <cmath>

#include "compare/oracle/audit.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::tests {

inline const compare::Vec3& start_of(const compare::Scene& scene, compare::Index v) {
  return scene.mesh.positions[static_cast<std::size_t>(v)];
}

inline double distance_of(const compare::Vec3& a, const compare::Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Returns the largest distance at the start between a spring's vertex and the point to which it is stitched [m].
inline double largest_gap(const compare::Scene& scene) {
  double largest = 0;
  for (const compare::Spring& s : scene.springs) {
    const compare::Vec3 &a = start_of(scene, s.second), &b = start_of(scene, s.third < 0 ? s.second : s.third);
    const double t = s.ratio;
    largest = std::max(largest, distance_of(start_of(scene, s.first),
                                            {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)}));
  }
  return largest;
}

/// Counts the intersections at the start: between partners (stitched or excluded vertices), and others. Intersections
/// inside a rigid group do not count.
struct StitchedStart {
  std::size_t between_partners = 0, others = 0;
};

inline StitchedStart stitched_start(const compare::Scene& scene) {
  const compare::Topology topology = build_topology(scene);
  const std::size_t all = compare::audit(topology, scene.mesh.positions, rigid_groups(scene)).count;
  const std::size_t others = compare::audit(topology, scene.mesh.positions, exclusions(scene)).count;
  return {all - others, others};
}

/// Returns the largest strain of the body's edges at the start [1].
inline double largest_edge_strain(const compare::Scene& scene, const compare::Body& body) {
  double largest = 0;
  for (compare::Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const compare::Triangle& corners = scene.mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const compare::Index a = corners[k], b = corners[(k + 1) % 3];
      const double rest = distance_of(scene.rest_positions[static_cast<std::size_t>(a)],
                                      scene.rest_positions[static_cast<std::size_t>(b)]);
      largest = std::max(largest, std::abs(distance_of(start_of(scene, a), start_of(scene, b)) / rest - 1));
    }
  }
  return largest;
}

/// Returns the largest distance that a prescribed vertex moves in one step [m].
inline double largest_step(const compare::Scene& scene) {
  double largest = 0;
  for (const compare::PrescribedMotion& motion : scene.motions) {
    std::vector<compare::Vec3> before = compare::to_double(prescribed_targets(scene, motion, 0));
    for (std::int64_t step = 1; step <= scene.settings.steps; ++step) {
      const std::vector<compare::Vec3> now = compare::to_double(
          prescribed_targets(scene, motion, scene.settings.time_step * static_cast<double>(step)));
      for (std::size_t v = 0; v < now.size(); ++v) largest = std::max(largest, distance_of(before[v], now[v]));
      before = now;
    }
  }
  return largest;
}

}  // namespace ogc::tests
