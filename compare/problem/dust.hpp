// Clears dust: tiny numbers like 6e-17, which are left of a sine that should be 0. Nearly every generated mesh has
// some. Dust means nothing, but it spreads the exponents, and numbers of exact arithmetic are as long as this spread.
// So it becomes 0 when a scene's meshes are read (method.md §2.4), and never later.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Counts coordinates that were not zero and below 2⁻⁴⁰ of the largest one.
struct Dust {
  std::size_t count = 0;  ///< how many there were
  double largest = 0;     ///< largest modulus among them [m]
};

/// Sets the dust of a mesh to 0 and returns what it cleared. The limit is 2⁻⁴⁰ of the mesh's largest finite coordinate;
/// coordinates that are not finite stay. Rounding to single precision afterwards makes no dust: x ≥ 2⁻⁴⁰ M stays so, as
/// rounding is monotonic and a power of two does not change it.
Dust clear_dust(Mesh& mesh);

/// Sets the dust of start and rest positions to 0, with the scene's largest coordinate. A coordinate that is the same
/// in both counts once.
Dust clear_dust(Scene& scene);

/// Returns "7 coordinates are dust (…): taken as 0", with another treatment if one is given; empty without dust.
std::string describe(const Dust& dust, const std::string& treatment = "taken as 0");

}  // namespace ogc::compare
