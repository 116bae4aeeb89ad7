// Generates a stand-in for a character: overlapping capsules that walk on the spot.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes of the mannequin. The pelvis is a ball at y = 0.86 m.
struct MannequinSizes {
  /// heights of the shoulders' centre and of the torso's lower end, radii of torso and pelvis [m]
  double shoulders = 1.30, waist = 0.98, torso_radius = 0.142, pelvis_radius = 0.188;
  double spacing = 0.01487;  ///< approximate edge length of the surface [m]
  double seconds = 4.84;     ///< duration of the walk [s]
};

/// Appends the mannequin as a body without energies. All of its vertices have one motion, so that overlapping capsules
/// are not in contact. It stands upright on the y axis and faces +z. Keyframes are 0.04 s apart, as in Codimensional
/// IPC's data set. Thighs swing by ±0.4 rad, arms swing in the opposite direction, and the body rotates by ±0.15 rad,
/// with a footstep every 0.8 s. The motion starts from rest within 0.8 s. These numbers are our choice; no vertex is
/// faster than 2 m/s (tests/experiments/scenes/dress.cpp).
void append_mannequin(compare::Scene& scene, const MannequinSizes& sizes, const compare::Material& surface);

}  // namespace ogc::experiments
