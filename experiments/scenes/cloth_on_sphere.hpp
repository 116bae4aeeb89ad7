// Fig. 18: a square cloth falls off-centre onto a fixed sphere.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's. The contact radius is proportional to the spacing: 5 mm for a cloth
/// of 70 × 70 vertices.
struct ClothOnSphereSizes {
  compare::Index vertices_a_side = 70;  ///< along each side of the cloth
  int sphere_subdivisions = 3;          ///< divisions of an icosahedron's triangles into four
  std::int64_t steps = 100;             ///< steps of the run
  double sphere_radius = 0.262;         ///< [m]
};

/// Returns the material of cloth, sphere and ground in the scenes with a sphere.
compare::Material sphere_scene_material();
/// Appends a fixed sphere of this radius [m] about (−0.15, 0, 0) as the next body of the scene.
void append_sphere(compare::Scene& scene, int subdivisions, double radius = 0.262);

/// Returns the scene: a cloth of 1 m × 1 m at y = 0.30 m above a sphere about (−0.15, 0, 0). The solver IPC runs it
/// with a barrier distance of r/5 (1 mm at 70 × 70 vertices) and the tolerance of Codimensional IPC's scripts.
compare::Scene cloth_on_sphere(const ClothOnSphereSizes& sizes = {});

}  // namespace ogc::experiments
