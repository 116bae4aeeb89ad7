// This host code is not in the header, so that only g++ compiles it (fast/stages/surface.cpp explains why).
#include "fast/stages/rods.hpp"

#include "compare/problem/rods.hpp"

namespace ogc::fast {

std::vector<Quat> motion_turns(const compare::Scene& scene, std::int64_t first, int steps) {
  std::vector<Quat> turns;
  const double h = scene.settings.time_step;
  for (std::int64_t k = first; k < first + steps; ++k)
    for (const compare::PrescribedMotion& motion : scene.motions)
      turns.push_back(compare::says_turn(motion) ? quat(compare::prescribed_turn(motion, static_cast<double>(k) * h,
                                                                                 static_cast<double>(k + 1) * h))
                                                 : Quat{0, 0, 0, 2});
  return turns;
}

std::vector<Quat> start_orientations(const compare::Scene& scene, const RodsAtRest& rods) {
  if (!scene.orientations.empty()) return quats(scene.orientations);
  std::vector<Quat> orientations;
  const auto apart = [](const std::vector<compare::Vec3>& x, const SegmentRest& segment) {
    const compare::Vec3 &a = x[static_cast<std::size_t>(segment.end[0])],
                        &b = x[static_cast<std::size_t>(segment.end[1])];
    return Vec{static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y), static_cast<float>(b.z - a.z)};
  };
  for (std::size_t e = 0; e < rods.segments.size(); ++e) {
    const SegmentRest& segment = rods.segments[e];
    const Vec rest = apart(scene.rest_positions, segment), now = apart(scene.mesh.positions, segment);
    const bool is_same = rest.x == now.x && rest.y == now.y && rest.z == now.z;
    orientations.push_back(is_same ? rods.orientations[e] : turned_along(rest, now, rods.orientations[e]));
  }
  return orientations;
}

}  // namespace ogc::fast
