// Clears dust: tiny numbers like 6e-17 in place of a 0, for example from a rounded sine. Nearly every generated mesh
// has some. Dust has no meaning, but it widens the range of exponents, and numbers of exact arithmetic grow with that
// range. So dust is set to 0 when a scene's meshes are read (method.md §2.4), and never later.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Counts the cleared coordinates: those that are not zero but below 2⁻⁴⁰ of the largest coordinate.
struct Dust {
  std::size_t count = 0;  ///< number of cleared coordinates
  double largest = 0;     ///< largest modulus of a cleared coordinate [m]
};

/// Sets the dust of a mesh to 0 and returns what it cleared. The limit is 2⁻⁴⁰ of the mesh's largest finite coordinate
/// M; coordinates that are not finite stay. Later rounding to single precision makes no dust, because it is monotonic
/// and keeps powers of two: x ≥ 2⁻⁴⁰ M stays true.
Dust clear_dust(Mesh& mesh);

/// Sets the dust of start and rest positions to 0 and returns what it cleared. The limit is 2⁻⁴⁰ of the largest finite
/// coordinate of both. If a vertex has the same cleared coordinate at the start and at rest, it is counted once.
Dust clear_dust(Scene& scene);

/// Returns "7 coordinates are dust (…): taken as 0" with the given treatment; empty without dust.
std::string describe(const Dust& dust, const std::string& treatment = "taken as 0");

}  // namespace ogc::compare
