// Defines plain coordinates. compare/problem contains facts and no algorithms, so the types have no operators: each
// contestant brings its own arithmetic, and none can use the other's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ogc::compare {

/// A point or vector of the problem, in double. The unit is given at each use.
struct Vec3 {
  double x = 0, y = 0, z = 0;  ///< coordinates
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// A point or vector of a stage, in single precision, so that both contestants get the same input.
struct Vec3f {
  float x = 0, y = 0, z = 0;  ///< coordinates
  friend bool operator==(const Vec3f&, const Vec3f&) = default;
};

/// A quaternion of a stage: the factors of i, j, k, then the real part.
using Quaternion = std::array<float, 4>;
/// Largest accepted deviation of ‖q‖² from 1 for a unit quaternion. A quaternion normalised in single precision is
/// within 2⁻²² of unit length (orientation_length_tolerance in compare/stages/orientation.hpp).
inline constexpr double unit_quaternion_slack = 0x1p-21;

using Index = std::int32_t;
/// Returns the subscript of element i, which is not negative.
constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Vertex indices of an edge, smaller first.
using Edge = std::array<Index, 2>;
/// Vertex indices of a triangle, in the order of the mesh file.
using Triangle = std::array<Index, 3>;
/// Vertex indices of a tetrahedron; at rest det(x₁ − x₀, x₂ − x₀, x₃ − x₀) > 0.
using Tetrahedron = std::array<Index, 4>;

/// A face of the complex (method.md §2.1): a vertex, the interior of an edge, or the interior of a triangle.
enum class FaceKind : std::uint8_t { vertex = 0, edge = 1, triangle = 2 };

/// Names one face by kind and number within its kind; ordered by kind, then number.
struct Face {
  FaceKind kind = FaceKind::vertex;  ///< whether `index` numbers a vertex, an edge or a triangle
  Index index = -1;                  ///< −1: none
  friend auto operator<=>(const Face&, const Face&) = default;
};

}  // namespace ogc::compare
