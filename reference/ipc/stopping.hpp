// Computes the lengths to which IPC's distances and tolerances are relative, and the speed below which a step ends.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::reference {

/// Returns the diagonal of the rest positions' bounding box [m], IPC's unit of distances.
double rest_diagonal(const compare::Scene& scene);

/// Returns the smallest diagonal of the rest boxes of bodies with a free vertex [m]; the diagonal of the whole scene if
/// no vertex is free. A step's tolerance is a share of this diagonal (reference/README.md).
double moving_diagonal(const compare::Scene& scene);

/// Returns the speed below which the stopping rule ends an IPC step [m/s]; 0 if all iterations run. At the end of a
/// step vertices may still have this speed.
double ipc_end_speed(const compare::Scene& scene);

}  // namespace ogc::reference
