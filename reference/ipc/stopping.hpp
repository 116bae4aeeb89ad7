// The lengths in which IPC's distances and tolerances are measured, and the speed at which they end a step.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::reference {

/// Returns the diagonal of the box around the rest positions of all vertices [m], IPC's scale of distances.
double rest_diagonal(const compare::Scene& scene);

/// Returns the smallest diagonal of a box around the rest positions of a body with a free vertex [m], or that of the
/// scene where no vertex is free: a step's tolerance is a share of it (reference/README.md).
double moving_diagonal(const compare::Scene& scene);

/// Returns the speed below which an IPC step of the scene ends by its stopping rule, with all remaining motion [m/s]; 0
/// where all iterations are done.
double ipc_end_speed(const compare::Scene& scene);

}  // namespace ogc::reference
