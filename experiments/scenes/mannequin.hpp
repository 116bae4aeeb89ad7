// Generates a stand-in for a character: overlapping capsules that walk on the spot.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes: heights of the shoulders' centre and of the torso's lower end, radii of torso and pelvis (a ball at
/// 0.86 m) [m].
struct MannequinSizes {
  /// heights and radii [m]
  double shoulders = 1.30, waist = 0.98, torso_radius = 0.142, pelvis_radius = 0.188;
  double spacing = 0.01487;  ///< approximate edge length of the surface [m]
  double seconds = 4.84;     ///< duration of the walk
};

/// Appends the mannequin as a body without energies. All of its vertices belong to one motion, so that overlapping
/// capsules are not in contact. It stands upright on the y axis and looks along +z. A keyframe every 0.04 s, as in
/// Codimensional IPC's data set: thighs swing by ±0.4 rad and arms against them, a step every 0.8 s, the body turns by
/// ±0.15 rad; from rest within 0.8 s. These numbers are decided here; no vertex is faster than 2 m/s
/// (tests/experiments/scenes/dress.cpp).
void append_mannequin(compare::Scene& scene, const MannequinSizes& sizes, const compare::Material& surface);

}  // namespace ogc::experiments
