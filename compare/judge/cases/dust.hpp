// Makes small coordinates, as rotations leave them of a zero and runs leave them of a vertex near a plane of symmetry
// (method.md §2.4: they are legal everywhere).
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Makes some coordinates of the case small, down to 2⁻⁶⁰ (10⁻¹⁸), each by itself, as long as the case stays legal.
/// With still smaller ones, products of two would be lost beside 1 in double-double, and decisions with them.
/// Connectivity, radii, materials and rest data stay. Scenes stay as they are, except for the positions of a sweep.
void add_dust(Random& random, TestCase& test);

/// Returns pointers to the coordinates of points, one array after another.
inline std::vector<float*> coordinates_of(std::initializer_list<std::span<Vec3f>> arrays) {
  std::vector<float*> all;
  for (const std::span<Vec3f> points : arrays)
    for (Vec3f& p : points) all.insert(all.end(), {&p.x, &p.y, &p.z});
  return all;
}

}  // namespace ogc::compare
