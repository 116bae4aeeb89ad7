// Dust: what is left of a sine that should be 0, like 6e-17. It stands in nearly every mesh that a program made, means
// nothing, and makes the numbers of exact arithmetic as long as their exponents are apart; so it becomes 0 when a
// scene's meshes are read (method.md §2.4), and never later.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Coordinates that were not zero and below 2⁻⁴⁰ of the largest one.
struct Dust {
  std::size_t count = 0;  ///< of coordinates
  double largest = 0;     ///< [m]
};

/// Sets the dust of a mesh to 0. The largest coordinate is that of the mesh; positions that are not finite count for
/// nothing and stay. Rounding to single precision afterwards makes no dust: x ≥ 2⁻⁴⁰ M stays so, as rounding is
/// monotonic and a power of two does not change it.
Dust clear_dust(Mesh& mesh);

/// The same for start and rest positions of a scene, with the scene's largest coordinate; of a coordinate that is the
/// same in both one is counted.
Dust clear_dust(Scene& scene);

/// "7 coordinates are dust (…): taken as 0", or what else became of them; empty where there is none.
std::string describe(const Dust& dust, const std::string& treatment = "taken as 0");

}  // namespace ogc::compare
