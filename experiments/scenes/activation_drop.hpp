// Fig. 21: a square cloth falls onto a sphere and the ground below, to compare contact energies.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's. The contact radius is proportional to the spacing: 5 mm for a cloth
/// of 70 × 70 vertices.
struct ActivationDropSizes {
  compare::Index vertices_a_side = 70;  ///< along each side of the cloth
  int sphere_subdivisions = 3;          ///< divisions of an icosahedron's triangles into four
  std::int64_t steps = 40;              ///< steps of the run
  std::int64_t iterations = 500;        ///< largest number of iterations of a step (solver vbd)
};

/// Returns cloth_on_sphere with a ground. The ground is a fixed mesh of 4 m × 4 m at y = −0.272 m; its triangles are at
/// most a hundred times as large as the cloth's. Steps are solved to convergence, so one cut vertex triggers a
/// detection.
compare::Scene activation_drop(const ActivationDropSizes& sizes = {});

}  // namespace ogc::experiments
