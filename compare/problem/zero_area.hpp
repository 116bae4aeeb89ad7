// The one geometric question that validation asks: do three points lie on a line? Decided without rounding.
#pragma once

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Whether the triangle has exactly zero area. Coordinates are zero or within 2⁻⁴⁵⁰ … 2⁴⁵⁰ m, which those of single
/// precision and those of meshes without dust are: no product overflows, and its rounding error, a multiple of 2⁻¹⁰⁰⁴,
/// underflows not.
bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ogc::compare
