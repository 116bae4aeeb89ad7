// What lengths IPC's distances and tolerances are shares of, and at which speed a step ends by them.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::reference {

/// Diagonal of the box around the rest positions of all vertices [m]: IPC's scale of distances.
double rest_diagonal(const compare::Scene& scene);

/// Of the bodies with a free vertex the smallest diagonal of a box around one's rest positions [m], that of the scene
/// where no vertex is free: what a step's tolerance is a share of (reference/README.md).
double moving_diagonal(const compare::Scene& scene);

/// The speed below which an IPC step of the scene ends by its rule of stopping, as all motion that is left to do
/// [m/s]; 0 where all iterations are done.
double ipc_end_speed(const compare::Scene& scene);

}  // namespace ogc::reference
