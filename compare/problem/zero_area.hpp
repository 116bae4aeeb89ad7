// Decides without rounding whether three points lie on a line, which validation needs.
#pragma once

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Returns whether the triangle has exactly zero area. Coordinates must be zero or within 2⁻⁴⁵⁰ … 2⁴⁵⁰ m; numbers of
/// single precision and meshes without dust satisfy this. Then no product overflows. Rounding errors are multiples of
/// 2⁻¹⁰⁰⁴, so that none underflows.
bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ogc::compare
