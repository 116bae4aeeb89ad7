// Makes coordinates tiny. Runs produce tiny coordinates, for example by rotating a zero, or at vertices near a plane of
// symmetry. They are legal everywhere (method.md §2.4).
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

/// Sets some coordinates, chosen at random, to 0 or to tiny numbers. If the case is illegal then, undoes all changes.
/// Tiny numbers are at least 2⁻⁶⁰ (10⁻¹⁸), because double-double numbers cannot hold 1 plus the product of two smaller
/// coordinates. Connectivity, radii, materials and rest data stay. In cases with a scene only the positions of a sweep
/// change.
void add_dust(Random& random, TestCase& test);

/// Returns pointers to the coordinates of points, one array after another.
inline std::vector<float*> coordinates_of(std::initializer_list<std::span<Vec3f>> arrays) {
  std::vector<float*> all;
  for (const std::span<Vec3f> points : arrays)
    for (Vec3f& p : points) all.insert(all.end(), {&p.x, &p.y, &p.z});
  return all;
}

}  // namespace ogc::compare
