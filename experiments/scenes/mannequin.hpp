// Stands in for a character: overlapping capsules that walk on the spot.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Heights of the shoulders' centre and of the torso's lower end, radii of torso and pelvis (a ball at 0.86 m) [m];
/// `spacing`: about the length of the surface's edges [m].
struct MannequinSizes {
  /// see above [m]
  double shoulders = 1.30, waist = 0.98, torso_radius = 0.142, pelvis_radius = 0.188;
  double spacing = 0.01487;  ///< see above [m]
  double seconds = 4.84;     ///< how long it walks
};

/// Appends it as a body without energies and all of its vertices as one motion, so that capsules that overlap are no
/// contacts: upright on the y axis, looking along +z. A keyframe every 0.04 s, as in Codimensional IPC's data set:
/// thighs swing by ±0.4 rad and arms against them, a step every 0.8 s, the body turns by ±0.15 rad; from rest within
/// 0.8 s. Decided here; no vertex is faster than 2 m/s (tests/experiments/scenes/dress.cpp).
void append_mannequin(compare::Scene& scene, const MannequinSizes& sizes, const compare::Material& surface);

}  // namespace ogc::experiments
