// Fig. 17: three square cloths, one above the other, fall off-centre onto a fixed sphere.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's. The contact radius is proportional to the spacing: 2 mm for cloths of
/// 70 × 70 vertices.
struct ThreeClothsSizes {
  compare::Index vertices_a_side = 70;  ///< along each side of each cloth
  int sphere_subdivisions = 3;          ///< divisions of an icosahedron's triangles into four
  std::int64_t steps = 50;              ///< steps of the run
  std::int64_t iterations = 500;        ///< sweeps in each step
};

/// Returns the scene: the sphere of cloth_on_sphere and three of its cloths, which lie 0, 2 r and 4 r above y = 0.30 m.
compare::Scene three_cloths_on_sphere(const ThreeClothsSizes& sizes = {});

}  // namespace ogc::experiments
